#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/linear/problem.h>
#include <dalembert/solvers/manifold/start.h>

#include <optional>

namespace DALEMBERT_HIDDEN dalembert {

/// The holonomic row that depends on others at the start, but not where the motion leads: a singular
/// position, where branches of the motion meet.
///
/// With W^T u = 0 everywhere on the constraint manifold u_dot^T W + u^T W_dot = 0: u^T W_dot vanishes along
/// all motions that the constraints allow. It is looked at along the one that begins, with its velocities or,
/// from rest, its accelerations.
[[nodiscard]] std::optional<std::size_t> singular_row(const Problem& problem, const Start& start, double t);

}  // namespace dalembert
