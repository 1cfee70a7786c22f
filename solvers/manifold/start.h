#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/base/options.h>
#include <dalembert/solvers/linear/rows.h>
#include <dalembert/solvers/manifold/scales.h>

#include <limits>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A start that violates a constraint by less than this, relative to the scene's length or speed,
/// is taken for one that obeys it in rounded numbers, and projected without a word.
inline constexpr double rounding_of_the_user = 1e-8;

/// A state that obeys the constraints at position, velocity and acceleration level.
struct Start {
  std::vector<double> q, v, a, lambda;
  ActiveRows rows;
  Scales scales;
};

/// Checks the given state against the constraints, or with options.assemble moves it onto them,
/// and finds accelerations and multipliers. A contact that is not among the constraints may be as near as
/// `nearest_contact`. Throws InconsistentStart, naming the constraint.
[[nodiscard]] Start consistent_start(const System& system, std::span<const double> q,
                                     std::span<const double> v, const Options& options,
                                     double nearest_contact = std::numeric_limits<double>::infinity());

/// A start from a state on the way of a run whose constraints have changed since it began with `before`: put
/// onto those that there are now, of which it is right to `known`, a part of the scene's length. Throws
/// StepFailure where they contradict each other.
[[nodiscard]] Start begin_changed(const System& system, const Start& before, double t,
                                  std::span<const double> q, std::span<const double> v, double known);

/// Puts the velocities onto the constraints of a system that takes over at a state that is given, in the
/// scales of a run; the impulses that this takes, one per row. Throws StepFailure where the positions do not
/// obey them, naming the constraint; EquationFault.
[[nodiscard]] std::vector<double> take_over(const System& system, const Scales& scales, double t,
                                            std::span<const double> q, std::span<double> v, double known);

/// A start from a state on the way of a run that began with `before`, in its scales: put onto the
/// constraints, with as many rows as before, chosen anew. Throws StepFailure where they are dependent.
[[nodiscard]] Start begin_anew(const System& system, const Start& before, double t, std::span<const double> q,
                               std::span<const double> v);

}  // namespace dalembert
