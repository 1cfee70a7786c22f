#pragma once

#include <dalembert/bench/report.h>
#include <dalembert/solvers/base/options.h>

#include <vector>

namespace dalembert::bench {

struct LeaveOut {
  int size = 100;  ///< beads of the chains, and pendulums of the independent islands
  int repeats = 5;
  std::vector<Stepper> steppers = {Stepper::ida};
  double tolerance = 1e-8;
  ReportOptions report;
};

/// What does a scene save by leaving out what it does not need? Each row is one motion stated twice, in
/// full and without, run in turn; median run times of integration and output. `unknowns` counts those of
/// the implicit stepper's equations, (q, v, lambda, mu). Returns the number of rows that are wrong: two
/// motions further apart than the tolerance allows. A run that was refused has its outcome in the table.
int leave_out(const LeaveOut& options);

}  // namespace dalembert::bench
