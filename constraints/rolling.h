#pragma once

#include <dalembert/core/equations/constraint.h>

namespace dalembert {

/// No slip between a disk and a straight track, in the plane (notes, mln76, mex116). The disk is a
/// centre and a Rotor, turning counter-clockwise; the track is the line through two points, fixed
/// (an incline), driven, or carried by a body. PointLineDistance with offset = radius keeps the two in
/// contact.
///
///   e = (r_b - r_a)/|r_b - r_a|,  n = e turned left,  contact c = r - radius n
///   a = e . (v - v_track(c)) + radius phi'      [speed]
///
/// v_track(c) is the velocity of the track's own point that is at c. lambda is the friction on the
/// disk along e; the disk feels the torque radius lambda, the track's points the opposite force.
template <Point P, Point A, Point B>
struct Rolling {
  static_assert(P::dimension == 2, "Rolling is planar; for a disk upright on a plane use UprightRolling");
  static constexpr std::string_view kind = "Rolling";
  static constexpr std::string_view meaning =
      "friction on the disk along the track; the disk feels the torque radius lambda";
  static constexpr std::string_view singular = "the two points of its track coincide";
  static constexpr bool velocity_level = true;
  P centre;
  Rotor wheel;  ///< its angle, counter-clockwise
  A a;
  B b;
  double radius;  ///< [length], finite and > 0; the disk is on the left of the track

  auto points() const { return std::tie(centre, wheel, a, b); }
  [[nodiscard]] Sketch sketch() const { return {"wheel", {radius}}; }
  auto operator()(const auto& r, const auto& /*phi*/, const auto& r_a, const auto& r_b, const auto& v,
                  const auto& spin, const auto& v_a, const auto& v_b) const {
    const auto track = r_b - r_a;
    const auto e = track.normalized();
    const auto d = r - r_a;
    // The contact is r_a + s track + h (track turned left), and moves with the track at fixed s, h.
    const auto s = e.dot(d) / track.norm();
    const auto h = (e.x() * d.y() - e.y() * d.x() - radius) / track.norm();
    const auto turning = v_b - v_a;
    const auto v_track = v_a + s * turning + h * vec(-turning.y(), turning.x());
    return e.dot(v - v_track) + radius * spin[0];
  }
  [[nodiscard]] std::string fault() const {
    if (std::isfinite(radius) && radius > 0.0) return {};
    return "radius = " + detail::text(radius) + ", must be finite and > 0";
  }
};
template <class P, class A, class B>
Rolling(P, Rotor, A, B, double) -> Rolling<P, A, B>;

}  // namespace dalembert
