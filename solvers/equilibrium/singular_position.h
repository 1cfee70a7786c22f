#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>

namespace DALEMBERT_HIDDEN dalembert {

/// Whether the constraints of a small scene leave no smooth manifold around a state, so that linear equations
/// describe no small motions there: a bead where a line touches a parabola, rods in line.
///
/// Linearly dependent rows, mu^T W = 0, may be redundant, or singular. Along every motion u with W u = 0 the
/// constraints require u . (sum mu g_qq) u = 0 in second order: redundant ones satisfy that identically.
/// (Then the distribution of forces among them does not change K either, elsewhere it does.)
[[nodiscard]] bool is_singular_position(const System& system, const Instant& at);

}  // namespace dalembert
