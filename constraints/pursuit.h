#pragma once

#include <dalembert/core/equations/constraint.h>

#include <stdexcept>

namespace dalembert {

/// A pursuer whose velocity always points at its prey, in the plane (notes, mex235). The constraint
/// force is at right angles to the velocity, so the speed is constant.
///
///   e = (r_prey - r)/|r_prey - r|,   n = e turned left
///   a = n . v      [speed],     e . v >= 0
///
/// lambda is the sideways force on the pursuer, towards n. Not integrable. The pursuit ends at
/// capture: the equation then has no direction, and a run stops with IntegrationFailure there
/// instead of letting the pursuer run on through its prey.
template <Point P, Point Prey>
struct Pursuit {
  static_assert(P::dimension == 2, "Pursuit is planar");
  static constexpr std::string_view kind = "Pursuit";
  static constexpr std::string_view meaning = "sideways force on the pursuer; > 0 to the left";
  static constexpr std::string_view singular = "the pursuer has caught its prey";
  static constexpr bool velocity_level = true;
  P pursuer;  ///< whose velocity points at the prey
  Prey prey;  ///< any point

  auto points() const { return std::tie(pursuer, prey); }
  auto operator()(const auto& r, const auto& r_prey, const auto& v, const auto& /*v_prey*/) const {
    const auto e = (r_prey - r).normalized();
    if (e.dot(v) < 0.0) throw std::domain_error(std::string(singular));
    return e.x() * v.y() - e.y() * v.x();
  }
};
template <class P, class Prey>
Pursuit(P, Prey) -> Pursuit<P, Prey>;

}  // namespace dalembert
