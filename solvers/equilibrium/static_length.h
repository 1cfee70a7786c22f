#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/rotating_frame.h>

#include <span>

namespace DALEMBERT_HIDDEN dalembert {

/// The length of a scene that has none, as of a single particle: how far what rests in the frame at q may be
/// displaced until its forces are no longer those of its stiffness there. What is linear, or has no
/// stiffness, has the displacement to where it balances, or its distance from the origin, if that is longer.
[[nodiscard]] double static_length(const System& system, const RotatingFrame& frame, double time,
                                   std::span<const double> q, std::span<const double> lambda);

}  // namespace dalembert
