#pragma once

#include <dalembert/core/scene/scene.h>
#include <dalembert/core/scene/system.h>

#include <span>
#include <string>

namespace dalembert {

/// Which laws of mechanics the equations of a scene break, in words; empty if none. A test of a constraint or
/// of a force is one line:
///
///   EXPECT_EQ(broken_laws(scene), "");
///
/// At the positions where the scene starts, and at velocities and multipliers of no special kind, all that a
/// run derives from the equations is held against central differences of what it is the derivative of:
///
///   W = dg/dq = dpsi/dv,   psi = dg/dt,   gamma = dpsi/dt at constant v,   d(F + W^T lambda)/dq,   dF/dv,
///   dF/dlambda
///
/// each to round-off in the terms that are met, in whatever units and wherever the scene is. And a second
/// evaluation gives the same bits. An equation breaks them that is not smooth there, that hides a number from
/// its derivatives (as by a cast to double), or that has a memory.
template <int D>
[[nodiscard]] std::string broken_laws(const Scene<D>& scene);

/// The same at any state, with any multipliers.
[[nodiscard]] std::string broken_laws(const System& system, const Instant& at,
                                      std::span<const double> lambda);

}  // namespace dalembert
