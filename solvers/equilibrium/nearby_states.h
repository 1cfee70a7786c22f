#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/linear/problem.h>
#include <dalembert/solvers/manifold/start.h>

#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A state that satisfies all constraints, with its accelerations and multipliers.
struct NearbyState {
  std::vector<double> q, v, a, lambda;
};

/// How far a nearby state may be off its constraints, of the scene's length.
inline constexpr double off_constraints = 1e-10;

/// States near a start in which nothing is special: what holds in some of them of analytic equations holds in
/// all. They are `way` of the scene's length off, or a quarter of it as often as it takes to be brought onto
/// the constraints. The one of number 0 is at rest, if there are forces at rest. Throws
/// NoEquilibrium where there are none.
[[nodiscard]] NearbyState nearby_state(const Problem& problem, const Start& start, double time, int number,
                                       double way);

}  // namespace dalembert
