#include "dalembert/bench/work_precision.h"

#include <dalembert/bench/progress.h>
#include <dalembert/models/catalogue.h>
#include <dalembert/models/error.h>

#include <algorithm>
#include <iostream>
#include <limits>

namespace dalembert::bench {

namespace {

using models::AnyModel;
using models::Measurement;
using models::Model;

const std::vector<std::string> columns = {"model",
                                          "stepper",
                                          "tolerance",
                                          "steps",
                                          "evaluations",
                                          "factorisations",
                                          "error_position",
                                          "error_force",
                                          "residual_position",
                                          "residual_velocity",
                                          "energy_drift",
                                          "run_time_s"};

const std::string& name_of(const AnyModel& model) {
  return std::visit([](const auto& m) -> const std::string& { return m.name; }, model);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

Measurement failure(const Statistics& so_far) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return {.error_position = nan, .error_force = nan, .energy_drift = nan, .statistics = so_far};
}

std::vector<std::string> row(const std::string& model, Stepper stepper, double tolerance,
                             const Measurement& m) {
  const Statistics& s = m.statistics;
  return {model,
          name(stepper),
          shortest_power(tolerance),
          std::to_string(s.steps),
          std::to_string(s.evaluations),
          std::to_string(s.factorisations),
          scientific(m.error_position),
          scientific(m.error_force),
          scientific(s.residual_position),
          scientific(s.residual_velocity),
          scientific(m.energy_drift),
          scientific(s.run_time)};
}

/// One tolerance of a ladder.
struct Rung {
  Measurement measured;
  std::vector<double> run_times = {};
  bool failed = false;
};

/// The ladder of one model, added to the table; the reference is computed once.
class Ladder {
 public:
  Ladder(const WorkPrecision& options, Table& table, Progress& progress)
      : options_(options), table_(table), progress_(progress) {}

  template <int D>
  void operator()(const Model<D>& model) {
    const auto reference = model.observations(sample_times({.t_end = model.t_end}));
    for (const Stepper stepper : options_.steppers) {
      std::vector<Rung> rungs(options_.tolerances.size());
      // The whole ladder again and again, so that what disturbs the machine for a while hits each
      // rung once and not one rung always.
      for (int i = 1; i <= options_.repeats; ++i) {
        progress_.next(model.name + ", " + name(stepper) + ", run " + std::to_string(i));
        for (std::size_t k = 0; k < rungs.size(); ++k)
          climb<D>(model, {.t_end = model.t_end, .tolerance = options_.tolerances[k], .stepper = stepper},
                   reference, rungs[k]);
      }
      for (std::size_t k = 0; k < rungs.size(); ++k) {
        if (!rungs[k].failed) rungs[k].measured.statistics.run_time = median(rungs[k].run_times);
        table_.rows.push_back(row(model.name, stepper, options_.tolerances[k], rungs[k].measured));
      }
    }
  }
  [[nodiscard]] int failures() const { return failures_; }

 private:
  template <int D>
  void climb(const Model<D>& model, const Options& run, std::span<const models::Observation<D>> reference,
             Rung& rung) try {
    if (rung.failed) return;
    rung.measured = measure<D>(model, run, reference);
    rung.run_times.push_back(rung.measured.statistics.run_time);
  } catch (const IntegrationFailure& failed) {
    ++failures_;
    std::cerr << model.name << " at tolerance " << shortest_power(run.tolerance) << ": " << failed.what()
              << '\n';
    rung.measured = failure(failed.trajectory<D>().statistics());
    rung.failed = true;
  }

  const WorkPrecision& options_;
  Table& table_;
  Progress& progress_;
  int failures_ = 0;
};

}  // namespace

std::vector<AnyModel> select_models(const std::vector<std::string>& names) {
  std::vector<AnyModel> all = models::catalogue();
  if (std::find(names.begin(), names.end(), "all") != names.end()) return all;
  for (const std::string& name : names) {
    if (std::any_of(all.begin(), all.end(), [&](const AnyModel& m) { return name_of(m) == name; })) continue;
    std::string known;
    for (const AnyModel& m : all) known += ' ' + name_of(m);
    throw Error("no model \"" + name + "\"; there are: all" + known);
  }
  std::erase_if(all, [&](const AnyModel& m) {
    return std::find(names.begin(), names.end(), name_of(m)) == names.end();
  });
  return all;
}

int work_precision(const WorkPrecision& options) {
  const std::vector<AnyModel> selected = select_models(options.models);
  for (const double tolerance : options.tolerances) validate({.t_end = 1.0, .tolerance = tolerance});
  require_writable(options.report);

  Table table{.columns = columns, .rows = {}};
  int failures = 0;
  {
    Progress progress(selected.size() * options.steppers.size() * static_cast<std::size_t>(options.repeats));
    Ladder ladder(options, table, progress);
    for (const AnyModel& model : selected) std::visit(ladder, model);
    failures = ladder.failures();
  }
  report("Error against run time: largest errors of 101 samples, run time the median of " +
             std::to_string(options.repeats),
         table, options.report);
  return failures;
}

}  // namespace dalembert::bench
