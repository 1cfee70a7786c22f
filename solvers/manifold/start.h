#pragma once

#include <dalembert/solvers/base/accuracy.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/base/options.h>
#include <dalembert/solvers/linear/problem.h>
#include <dalembert/solvers/linear/rows.h>
#include <dalembert/solvers/manifold/scales.h>

#include <limits>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A state that satisfies the constraints at position, velocity and acceleration level.
struct Start {
  std::vector<double> q, v, a, lambda;
  ActiveRows rows;
  Scales scales;
};

/// Checks the given state against the constraints, or with options.assemble moves it onto them,
/// and finds accelerations and multipliers. options.t_end is infinite for a state that no run begins with. A
/// contact that is not among the constraints may be as near as
/// `nearest_contact`. Throws InconsistentStart, naming the constraint.
[[nodiscard]] Start consistent_start(const Problem& problem, std::span<const double> q,
                                     std::span<const double> v, const Options& options,
                                     double nearest_contact = std::numeric_limits<double>::infinity());

/// A start from a state during a run whose constraints have changed since it began with `before`: put
/// onto those that there are now, of which it is right to `known`, a part of the scene's length. Throws
/// StepFailure where they contradict each other.
[[nodiscard]] Start restart_with_constraints(const Problem& problem, const Start& before, double t,
                                             std::span<const double> q, std::span<const double> v,
                                             double known);

/// Projects the velocities onto the constraints of the system that goes on from a given state, in the scales
/// of a run, and the positions, which are right to `known`, a part of the scene's length, onto those `held`:
/// these, and closed contacts; the impulses that this takes, one per row. Throws StepFailure where the
/// positions do not satisfy them, naming the constraint; EquationFault.
[[nodiscard]] std::vector<double> project_impulsively_onto(const Problem& problem, const Problem& held,
                                                           const Scales& scales, double t,
                                                           std::span<double> q, std::span<double> v,
                                                           double known);

/// A start from a state during a run that began with `before`, in its scales: put onto the
/// constraints, with as many rows as before, chosen again. Throws StepFailure where they are dependent.
[[nodiscard]] Start restart_with_rows(const Problem& problem, const Start& before, double t,
                                      std::span<const double> q, std::span<const double> v);

}  // namespace dalembert
