#pragma once

#include <dalembert/core/results/statistics.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/manifold/compliant_multipliers.h>
#include <dalembert/solvers/manifold/manifold.h>
#include <dalembert/solvers/manifold/recovery.h>
#include <dalembert/solvers/manifold/start.h>

namespace DALEMBERT_HIDDEN dalembert {

/// Reads what a run shows out of the states of a stepper: puts them onto the constraints and finds the forces
/// there.
class OutputProjection {
 public:
  /// For the states of a segment that starts with `start`.
  OutputProjection(const Problem& problem, const Start& start, double tolerance);

  [[nodiscard]] Manifold& manifold() { return manifold_; }

  /// Everything at m.t, from the stepper's m.q and m.v after so many steps, and from the multipliers of
  /// compliant rows if they are part of its state. Throws StepFailure, EquationFault.
  void read(OutputState& m, const CompliantMultipliers* compliant, long steps);

  /// Adds its counts.
  void count(Statistics& statistics) const;

 private:
  Manifold manifold_;
  Recovery recovery_;
};

}  // namespace dalembert
