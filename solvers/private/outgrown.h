#pragma once

#include <dalembert/solvers/private/start.h>

#include <span>
#include <string>

namespace dalembert {

/// The impulse by which a row gives the masses it moves the scene's speed, speed |W| / (W M^-1 W^T),
/// whatever the scale of the user's equation.
[[nodiscard]] double impulse_of_row(const System& system, const Scales& scales, std::span<const double> w,
                                    std::size_t row);

/// For the message of a run that stopped: the constraint whose force has outgrown all that the scene's
/// masses, speed and time explain, with its multiplier and what it says of itself when singular. Empty if
/// there is none.
[[nodiscard]] std::string outgrown_constraint(const System& system, const Scales& scales,
                                              std::span<const double> w, std::span<const double> lambda);

}  // namespace dalembert
