#pragma once

#include <dalembert/core/equations/constraint.h>

namespace dalembert {

/// A disk that rolls upright on a plane, seen from above (notes, mln37): its centre is a point of a
/// planar scene, its heading alpha and its spin phi are Rotors.
///
///   a_1 = e . v - radius phi'      e = (cos alpha, sin alpha)       [speed]
///   a_2 = n . v                    n = (-sin alpha, cos alpha)
///
/// lambda_1 is the friction along the heading, lambda_2 the lateral one. Not integrable: the disk
/// reaches every place in every attitude.
template <Point P>
struct UprightRolling {
  static_assert(P::dimension == 2, "UprightRolling is seen from above: use it in a planar scene");
  static constexpr std::string_view kind = "UprightRolling";
  static constexpr std::string_view meaning = "friction along the heading, and across it to the left";
  static constexpr bool velocity_level = true;
  P centre;
  Rotor heading;  ///< of the disk, against the first axis of the plane
  Rotor spin;     ///< about its own axis
  double radius;  ///< [length], finite and > 0

  auto points() const { return std::tie(centre, heading, spin); }
  [[nodiscard]] Sketch sketch() const { return {"upright wheel", {radius}}; }
  auto operator()(const auto& /*r*/, const auto& alpha, const auto& /*phi*/, const auto& v,
                  const auto& /*turning*/, const auto& spinning) const {
    using std::cos;
    using std::sin;
    const auto c = cos(alpha[0]);
    const auto s = sin(alpha[0]);
    return vec(c * v.x() + s * v.y() - radius * spinning[0], c * v.y() - s * v.x());
  }
  [[nodiscard]] std::string fault() const {
    if (std::isfinite(radius) && radius > 0.0) return {};
    return "radius = " + detail::text(radius) + ", must be finite and > 0";
  }
};
template <class P>
UprightRolling(P, Rotor, Rotor, double) -> UprightRolling<P>;

// Compiled once, in the library.
extern template struct BatchOf<ConstraintBatch, UprightRolling<Particle<2>>>;

}  // namespace dalembert
