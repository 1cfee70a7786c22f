#pragma once

#include <dalembert/bench/report.h>
#include <dalembert/solvers/base/options.h>

#include <vector>

namespace dalembert::bench {

struct OwnConstraint {
  int beads = 100;
  int repeats = 5;
  std::vector<Stepper> steppers = {Stepper::ida, Stepper::erk};
  ReportOptions report;
};

/// What does a user's own constraint cost? A chain whose rods are lambdas against the same chain of
/// Distances, run in turn; the median of the ratios of their run times, and the largest difference of
/// their positions.
void own_constraint(const OwnConstraint& options);

}  // namespace dalembert::bench
