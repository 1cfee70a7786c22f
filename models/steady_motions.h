#pragma once

#include <dalembert/models/small_motions.h>

#include <utility>
#include <vector>

namespace dalembert::models {

/// What appends its rows.
using Appending = std::pair<const char*, void (*)(std::vector<Compared>&)>;

/// Steady motions of bodies that spin or roll, and the small motions about them. WhippleBicycle, SpinningDisk
/// and HeavyTop state their own; those that are stated nowhere else:
///
///   rotor on two elastic bearings, at -+a on its axis x, with stiffness k_x, k_y, k_z each and spin n:
///       it sags by m g/(2 k_z), moves along x, y and z with omega^2 = 2 k/m, and whirls with
///       A^2 omega^4 - (2 a^2 A (k_y + k_z) + C^2 n^2) omega^2 + 4 a^4 k_y k_z = 0
///   gyrostat: a free body that turns at p about the principal axis z, on which it carries a rotor of
///   relative
///       angular momentum h; with J the principal moments of both
///       J_x J_y omega^2 = ((J_z - J_x) p + h) ((J_z - J_y) p + h)                        (Euler's equations)
[[nodiscard]] std::vector<Appending> steady_motions();

}  // namespace dalembert::models
