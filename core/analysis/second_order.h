#pragma once

#include <dalembert/core/analysis/rank.h>

#include <cstddef>
#include <span>

namespace dalembert {

/// How many of the velocities that the holonomic rows in use leave free the others hold to second order.
///
/// Where rows depend on each other there are numbers s with W^T s = 0, and along a motion from there
///
///   s^T g = v^T Q v t^2/2 + ...,     Q = sum s_r d^2 g_r/dq^2.
///
/// If Q has one sign on the free velocities, those with v^T Q v != 0 violate the constraints: three atoms in
/// a line that are held by rods cannot bend (Connelly, Whiteley, SIAM J. Discrete Math. 9 (1996) 453). Where
/// rows are redundant Q is 0, where branches of the motion meet it has both signs: neither holds anything.
[[nodiscard]] std::size_t held_to_second_order(const System& system, double t, std::span<const double> q,
                                               const ActiveRows& independent);

}  // namespace dalembert
