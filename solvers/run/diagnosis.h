#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/manifold/start.h>

#include <span>
#include <string>

namespace DALEMBERT_HIDDEN dalembert {

/// For the message of a run that stopped: the constraint whose force has outgrown all that the scene's
/// masses, speed and time explain, and has grown since the start as much, with its multiplier and what it
/// says of itself when singular. Empty if there is none.
[[nodiscard]] std::string outgrown_constraint(const System& system, const Scales& scales,
                                              std::span<const double> w, std::span<const double> lambda,
                                              std::span<const double> lambda_at_start);

}  // namespace dalembert
