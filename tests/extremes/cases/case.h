#pragma once

#include <dalembert/dalembert.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

/// Stiff, extreme and hostile scenes, each swept over one parameter and compared with its physics.
namespace dalembert::extremes {

/// What one run of a case gave. Where a refusal is what is due, `outcome` names it and `error` says how far
/// it is from the time, distance or number that it ought to name.
struct Result {
  double error = std::numeric_limits<double>::quiet_NaN();
  Statistics statistics{};
  std::string outcome = "ok";  ///< or an error type of the library
  std::string said{};          ///< what the error said
};

/// Which run, and what it says of its steps.
struct Run {
  double parameter;
  Stepper stepper;
  Statistics statistics;
};

/// A scene swept over one parameter.
struct Case {
  std::string name;
  std::string parameter;      ///< what is swept, with its unit
  std::vector<double> sweep;  ///< all of it
  std::vector<double> brief;  ///< what of it is done within seconds, for tests
  /// Runs it and compares with the reference. Throws what the library throws where none is due.
  std::function<Result(double parameter, Stepper)> run;
  /// The largest error that is right, derived beside each case.
  std::function<double(const Run&)> limit;
  std::vector<Stepper> steppers = {Stepper::ida, Stepper::erk};
};

/// Cases of one kind.
struct Group {
  std::string name;
  std::vector<Case> cases;
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
[[nodiscard]] std::vector<Group> groups();

/// A result and what became of it. `result.outcome` is "ok", "missed" if it ran but not within the limit, or
/// the type of the error thrown.
struct Verdict {
  Result result;
  double limit;
  bool right;  ///< within the limit, be it a run or the refusal that is due
};

/// Runs a case at one value; nothing thrown by the library leaves it.
[[nodiscard]] Verdict judge(const Case& extreme, double parameter, Stepper stepper);

}  // namespace dalembert::extremes
