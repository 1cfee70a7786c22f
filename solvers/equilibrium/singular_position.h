#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/carrier.h>

namespace DALEMBERT_HIDDEN dalembert {

/// Whether the constraints of a small scene leave no smooth set of positions around a state, so that there
/// are no small motions that linear equations tell: a bead where a line touches a parabola, rods in line.
///
/// Rows that depend on each other, mu^T W = 0, may repeat each other, or touch. Along every motion u that W u
/// = 0 allows the constraints ask for  u . (sum mu g_qq) u = 0  in second order: where they repeat each other
/// that holds by itself. (Then the split of forces among them makes no difference to K either, elsewhere it
/// does.)
[[nodiscard]] bool is_singular_position(const System& system, const Carrier& carrier, const Instant& at);

}  // namespace dalembert
