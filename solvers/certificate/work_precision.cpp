#include "dalembert/solvers/certificate/work_precision.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/certificate/better_run.h>
#include <dalembert/solvers/certificate/largest_errors.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <locale>
#include <ostream>
#include <sstream>

namespace dalembert {

namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

double median_of(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

void require_sensible(const WorkPrecisionOptions& which) {
  if (which.steppers.empty() || which.tolerances.empty() || which.repeats < 1)
    throw InvalidArgument("work_precision: needs a stepper, a tolerance and at least one repeat");
  for (const double tolerance : which.tolerances) validate({.t_end = 1.0, .tolerance = tolerance});
}

/// More accurate than all: explicit if that takes no more steps than an implicit run.
std::shared_ptr<const Record> most_accurate(const Run& run, Options options,
                                            const WorkPrecisionOptions& which) {
  options.tolerance = std::ranges::min(which.tolerances);
  options.stepper = Stepper::ida;
  options.max_steps = Options{}.max_steps;
  const TwoRuns runs = run_twice(run, options);
  return runs.reference();
}

WorkPrecisionPoint measured(const std::shared_ptr<const Record>& record,
                            const std::shared_ptr<const Record>& reference, const Options& options) {
  const LargestErrors errors = largest_errors(TwoRuns(record, reference));
  const auto known = [&](double error) { return errors.beyond > 0 ? not_known : error; };
  return {name(options.stepper),
          options.tolerance,
          known(errors.position.error),
          known(errors.force.error),
          known(errors.event_time.error),
          record->statistics,
          {}};
}

std::ofstream opened(const std::string& path) {
  std::ofstream file(path);
  if (!file) throw Error("cannot write " + path + ": does its folder exist?");
  return file;
}

/// Throws unless all that was written has arrived.
void close(std::ofstream& file, const std::string& path) {
  file.close();
  if (!file) throw Error("cannot write " + path + ": is there no room left where it is?");
}

/// As gnuplot quotes text in one line, of which it takes nothing for a command.
std::string quoted(const std::string& text) {
  std::string all = "'";
  for (const char c : text) {
    const bool control = static_cast<unsigned char>(c) < 0x20;
    all += c == '\'' ? std::string("''") : std::string(1, control ? ' ' : c);
  }
  return all + '\'';
}

void write_curves(std::ostream& out, const std::vector<WorkPrecisionPoint>& points) {
  std::string last;
  for (const WorkPrecisionPoint& point : points) {
    if (point.stepper != last) out << (last.empty() ? "" : "EOD\n") << '$' << point.stepper << " << EOD\n";
    last = point.stepper;
    out << point.statistics.run_time << ' ' << point.position_error << ' ' << point.force_error << '\n';
  }
  if (!last.empty()) out << "EOD\n";
}

std::vector<std::string> steppers_in(const std::vector<WorkPrecisionPoint>& points) {
  std::vector<std::string> all;
  for (const WorkPrecisionPoint& point : points)
    if (all.empty() || all.back() != point.stepper) all.push_back(point.stepper);
  return all;
}

}  // namespace

std::vector<WorkPrecisionPoint> detail::work_precision_curve(
    std::span<const double> tolerances, int repeats,
    const std::function<WorkPrecisionPoint(double tolerance)>& measure) {
  std::vector<WorkPrecisionPoint> points(tolerances.size());
  std::vector<std::vector<double>> times(tolerances.size());
  for (int i = 0; i < repeats; ++i) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (!points[k].refused.empty()) continue;
      points[k] = measure(tolerances[k]);
      times[k].push_back(points[k].statistics.run_time);
    }
  }
  for (std::size_t k = 0; k < points.size(); ++k) points[k].statistics.run_time = median_of(times[k]);
  return points;
}

void WorkPrecision::write_csv(std::ostream& to) const {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << "stepper,tolerance,steps,evaluations,error_position,error_force,error_event,run_time_s\n";
  for (const WorkPrecisionPoint& p : points) {
    out << p.stepper << ',' << p.tolerance << ',' << p.statistics.steps << ',' << p.statistics.evaluations
        << ',' << p.position_error << ',' << p.force_error << ',' << p.event_error << ','
        << p.statistics.run_time << '\n';
  }
  to << out.str();
}

void WorkPrecision::write_plot(std::ostream& out) const {
  write_curves(out, points);
  out << "set title " << quoted(scene)
      << " noenhanced\nset logscale xy\nset xlabel \"run time / s\"\nset ylabel \"error\"\n"
      << "set format y \"%.0e\"\nset key left bottom\n";
  std::string command = "plot ";
  for (const std::string& stepper : steppers_in(points)) {
    for (const char* what : {"2 title \"position, ", "3 title \"force, "}) {
      command += (command.size() > 5 ? ", " : "") + ("$" + stepper) + " using 1:" + what + stepper +
                 "\" with linespoints";
    }
  }
  out << command << '\n';
}

void WorkPrecision::write_csv(const std::string& path) const {
  auto file = opened(path);
  write_csv(file);
  close(file, path);
}

void WorkPrecision::write_plot(const std::string& path) const {
  auto file = opened(path);
  write_plot(file);
  close(file, path);
}

template <int D>
WorkPrecision work_precision(const Scene<D>& scene, const Options& options, const WorkPrecisionOptions& which,
                             const std::vector<Event<D>>& events) {
  require_sensible(which);
  const Run run = [&](const Options& own) { return simulate(scene, own, events).record(); };
  const auto reference = most_accurate(run, options, which);
  WorkPrecision all{scene.name(), {}};
  for (const Stepper stepper : which.steppers) {
    const auto curve = detail::work_precision_curve(which.tolerances, which.repeats, [&](double tolerance) {
      Options own = options;
      own.stepper = stepper;
      own.tolerance = tolerance;
      try {
        return measured(run(own), reference, own);
      } catch (const Error& error) {
        return WorkPrecisionPoint{name(stepper), tolerance, not_known,   not_known,
                                  not_known,     {},        error.what()};
      }
    });
    all.points.insert(all.points.end(), curve.begin(), curve.end());
  }
  return all;
}

template WorkPrecision work_precision(const Scene<2>&, const Options&, const WorkPrecisionOptions&,
                                      const std::vector<Event<2>>&);
template WorkPrecision work_precision(const Scene<3>&, const Options&, const WorkPrecisionOptions&,
                                      const std::vector<Event<3>>&);

}  // namespace dalembert
