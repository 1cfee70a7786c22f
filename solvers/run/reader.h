#pragma once

#include <dalembert/core/results/statistics.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/manifold/manifold.h>
#include <dalembert/solvers/manifold/recovery.h>
#include <dalembert/solvers/manifold/springs.h>
#include <dalembert/solvers/manifold/start.h>

#include <optional>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Reads what a run shows out of the states of a stepper: puts them onto the constraints and finds the forces
/// there, by the rows in use or, where these have come to depend on each other, by others.
class Reader {
 public:
  /// For the states of a run that begins, or begins anew, with `start` at time t.
  Reader(const Problem& problem, const Start& start, double t, double tolerance);

  /// Of the rows in use.
  [[nodiscard]] Manifold& manifold() { return manifold_; }
  /// Rows that make much larger angles at a state than those in use. They are looked for where the angle of
  /// these is much less than the best was when last looked for.
  [[nodiscard]] std::optional<ActiveRows> better_rows(const Instant& at);

  /// Everything at m.t, from the stepper's m.q and m.v after so many steps, and from the multipliers of
  /// compliant rows if they are part of its state. Throws StepFailure, EquationFault.
  void read(Moment& m, const Springs* springs, long steps);

  /// Adds its counts.
  void count(Statistics& statistics) const;

 private:
  Problem problem_;
  ActiveRows rows_;
  std::vector<double> lengths_;  // see Scales
  Manifold manifold_;
  Recovery recovery_;
  bool redundant_;
  double best_sine_ = 1.0;  // of any rows, where they were compared last
  Statistics others_;       // of other rows
};

}  // namespace dalembert
