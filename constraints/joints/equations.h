#pragma once

#include <dalembert/core/vec.h>

#include <cmath>
#include <stdexcept>

/// The parts that the equations of joints are made of. x, y, z are axes of the joint's frames, of length
/// `length` l; d = c_b - c_a leads from a's point to b's. A turn of b against a by small angles p, q, r about
/// x_a, y_a, z_a changes
///
///   -y_a . z_b/l^2 by p,   x_a . z_b/l^2 by q,   y_a . x_b/l^2 by r,
///
/// so that the multipliers of these are the torques on b about those axes.
namespace dalembert::detail {

/// The angle of x_b from x_a towards y_a, between -pi and pi; in space about z_a.
[[nodiscard]] auto angle_between(const auto& x_a, const auto& y_a, const auto& x_b) {
  using std::atan2;
  return atan2(y_a.dot(x_b), x_a.dot(x_b));
}

/// Its rate: with s = y_a . x_b, c = x_a . x_b it is (c s' - s c')/(c^2 + s^2).
[[nodiscard]] auto rate_of_angle(const auto& x_a, const auto& y_a, const auto& x_b, const auto& x_a_rate,
                                 const auto& y_a_rate, const auto& x_b_rate) {
  const auto s = y_a.dot(x_b), c = x_a.dot(x_b);
  const auto s_rate = y_a_rate.dot(x_b) + y_a.dot(x_b_rate), c_rate = x_a_rate.dot(x_b) + x_a.dot(x_b_rate);
  return (c * s_rate - s * c_rate) / (c * c + s * s);
}

/// Which axis of its frames a joint slides along.
template <int D>
inline constexpr std::size_t along = D == 2 ? 0 : 2;

/// An angle that is a multiple of a full turn wherever the equation holds, less that: its equation needs no
/// history of turns and has no branch cut, as a thread or a gear has none. Half a turn away it would hold for
/// the next tooth; before that it throws, and the stepper takes a shorter step.
template <class S>
[[nodiscard]] S out_of_mesh(const S& phase) {
  using std::atan2;
  using std::cos;
  using std::sin;
  const S c = cos(phase);
  if (c < 0.0) throw std::domain_error("is out of mesh: more than a quarter turn away from where it holds");
  return atan2(S(sin(phase)), c);
}

}  // namespace dalembert::detail
