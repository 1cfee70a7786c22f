#pragma once

#include <dalembert/dalembert.h>
#include <dalembert/tests/outcome.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

/// Stiff, extreme and hostile scenes, each swept over one parameter and compared with its physics.
namespace dalembert::extremes {

/// One run of a case. The case gives `error`, `statistics` and, where a refusal is what is due, `outcome`:
/// its error is then how far the refusal is from the time, distance or number that it ought to name.
/// `judge` adds the rest.
struct Run {
  double error = std::numeric_limits<double>::quiet_NaN();
  Statistics statistics{};
  Outcome outcome{};  ///< "missed" if the run ended with more than the limit
  double parameter = 0.0;
  Stepper stepper = Stepper::ida;
  double limit = 0.0;

  /// Within the limit, be it a run or the refusal that is due.
  [[nodiscard]] bool right() const { return error <= limit; }
};

/// A run that an exception of the library ended.
[[nodiscard]] inline Run ended_by(const Error& exception,
                                  double error = std::numeric_limits<double>::quiet_NaN()) {
  return {.error = error, .statistics = statistics_of(exception), .outcome = outcome_of(exception)};
}

/// A scene swept over one parameter.
struct Case {
  std::string name;
  std::string parameter;      ///< what is swept, with its unit
  std::vector<double> sweep;  ///< all of it
  std::vector<double> brief;  ///< what of it is done within seconds, for tests
  /// Runs it and compares with the reference. Throws what the library throws where none is due.
  std::function<Run(double parameter, Stepper)> run;
  /// The largest error that is right, derived beside each case.
  std::function<double(const Run&)> limit;
  std::vector<Stepper> steppers = {Stepper::ida, Stepper::erk};
};

[[nodiscard]] std::vector<Case> stiffness();
[[nodiscard]] std::vector<Case> ratios();
[[nodiscard]] std::vector<Case> near_singular();
[[nodiscard]] std::vector<Case> linkages();
[[nodiscard]] std::vector<Case> driving();
[[nodiscard]] std::vector<Case> length();
[[nodiscard]] std::vector<Case> paths();
[[nodiscard]] std::vector<Case> units();
[[nodiscard]] std::vector<Case> starts();
[[nodiscard]] std::vector<Case> redundancy();
[[nodiscard]] std::vector<Case> at_round_off();
[[nodiscard]] std::vector<Case> failures();
[[nodiscard]] std::vector<Case> discontinuities();
[[nodiscard]] std::vector<Case> sticking();
[[nodiscard]] std::vector<Case> contacts();

/// All of them.
[[nodiscard]] std::vector<Case> all_cases();

/// Runs a case at one value; nothing thrown by the library leaves it.
[[nodiscard]] Run judge(const Case& extreme, double parameter, Stepper stepper);

}  // namespace dalembert::extremes
