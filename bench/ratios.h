#pragma once

#include <dalembert/bench/method.h>
#include <dalembert/bench/report.h>

#include <string>
#include <vector>

namespace dalembert::bench {

struct Ratios {
  std::vector<std::string> scenes = {"all"};
  std::vector<Method> steppers = all_methods();
  std::vector<double> errors = {1e-6, 1e-8};  ///< of position, relative to the model's length
  int repeats = 3;                            ///< rounds
  double limit = 2.0;  ///< a run that took longer is the last of its stepper's curve [s]
  ReportOptions report;
};

/// How far is the library from code derived by hand, and how far ahead of its peers? The processor time of
/// the integration alone that each takes to reach an error of position at the end of a run.
///
/// Each runs at falling tolerances, half a decade apart, until two runs in turn meet the error: one
/// may do so by a lucky sign. The two runs about the error are then run by all in turn, round after
/// round; between their median times the time at the error is interpolated, both on logarithmic scales,
/// unless a tighter run took less.
///
/// Where error_reached is above the error the curve ended before, at the limit or at a tolerance that the
/// stepper refused: run_time_s is what its last run took, a lower bound.
void ratios(const Ratios& options);

/// The names of the scenes, for a help text.
[[nodiscard]] std::string known_scenes();

}  // namespace dalembert::bench
