#include "dalembert/solvers/base/options.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/constants.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace dalembert {

namespace {

constexpr double largest_tolerance = 1e-1;

/// More could not be held in memory, at some hundred bytes each.
constexpr double most_samples = 1e8;
constexpr const char* too_many = "asks for more than 1e8 samples; use a Simulation and its steps";

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

template <class T>
void require(bool good, const char* option, const T& value, const std::string& rule) {
  if (good) return;
  std::ostringstream what;
  what << "Option " << option << " = " << value << ": " << rule;
  throw InvalidArgument(what.str());
}

std::vector<double> equally_spaced(const Options& o) {
  require(o.samples >= 2, "samples", o.samples, "must be at least 2, one for either end of the run");
  require(o.samples <= most_samples, "samples", o.samples, too_many);
  std::vector<double> times(static_cast<std::size_t>(o.samples));
  for (std::size_t i = 0; i < times.size(); ++i) {
    times[i] =
        o.t_start + (o.t_end - o.t_start) * (static_cast<double>(i) / static_cast<double>(o.samples - 1));
  }
  times.back() = o.t_end;
  return times;
}

std::vector<double> every_interval(const Options& o) {
  require(std::isfinite(o.sample_interval) && o.sample_interval > 0.0, "sample_interval", o.sample_interval,
          "must be finite and > 0");
  // An interval that divides the run up to round-off must not lose its last sample.
  const double count = std::floor((o.t_end - o.t_start) / o.sample_interval * (1.0 + 1e-12));
  require(count >= 1.0, "sample_interval", o.sample_interval,
          "is longer than the run, so that nothing would be integrated; must be at most t_end - t_start = " +
              text(o.t_end - o.t_start));
  require(count < most_samples, "sample_interval", o.sample_interval, too_many);
  std::vector<double> times;
  for (double i = 0.0; i <= count; i += 1.0)
    times.push_back(std::min(o.t_start + i * o.sample_interval, o.t_end));
  return times;
}

}  // namespace

const char* name(Stepper stepper) { return stepper == Stepper::erk ? "erk" : "ida"; }

void validate(const Options& o) {
  require(std::isfinite(o.t_start), "t_start", o.t_start, "must be finite");
  require(std::isfinite(o.t_end) && o.t_end > o.t_start, "t_end", o.t_end,
          "must be finite and later than t_start = " + text(o.t_start));
  require(o.tolerance >= smallest_tolerance && o.tolerance <= largest_tolerance, "tolerance", o.tolerance,
          "must lie between 1e-13, what double precision can deliver, and 0.1");
  require(std::isfinite(o.length) && o.length >= 0.0, "length", o.length,
          "must be finite and > 0, or 0 for the scene's own");
  require(!(o.ledger && o.audit == Audited::off), "ledger", "true",
          "needs an audit; choose Audited::error or Audited::report");
  require(o.max_steps > 0, "max_steps", o.max_steps, "must be > 0");
  require(std::isfinite(o.max_step) && o.max_step >= 0.0, "max_step", o.max_step,
          "must be finite and > 0, or 0 for none");
}

Options starting_at(double time, Options o) {
  require(o.t_start == 0.0 || o.t_start == time, "t_start", o.t_start,
          "leave it out, as the run starts from a sample at " + text(time));
  o.t_start = time;
  return o;
}

double tolerance_of_a_step(Stepper stepper, double tolerance) {
  return stepper == Stepper::ida ? constants.share_of_a_step * tolerance : tolerance;
}

double longest_step(const Options& o) {
  const double run = o.t_end - o.t_start;
  return o.max_step > 0.0 ? std::min(o.max_step, run) : run;
}

std::vector<double> sample_times(const Options& o) {
  validate(o);
  if (!o.times.empty()) {
    require(o.sample_interval == 0.0, "sample_interval", o.sample_interval,
            "give either this or times, not both");
    for (std::size_t i = 0; i < o.times.size(); ++i) {
      const double t = o.times[i];
      require(t >= o.t_start && t <= o.t_end, "times", t, "must lie between t_start and t_end");
      require(i == 0 || t > o.times[i - 1], "times", t, "must increase");
    }
    return o.times;
  }
  return o.sample_interval != 0.0 ? every_interval(o) : equally_spaced(o);
}

}  // namespace dalembert
