#pragma once

#include <dalembert/constraints/joints/equations.h>
#include <dalembert/constraints/joints/frames.h>

namespace dalembert {

/// A pinion b that rolls on a rack a, in the plane or in space, without slip at its pitch point; what keeps
/// the two at their distance, a hinge and a slide, say, is stated beside it.
///
///   g = x_a . (c_b - c_a) + r phi   mod 2 pi r      [length]
///
/// with x_a the unit vector along the rack, r the distance of the pinion's centre from the pitch point, phi
/// the angle of the pinion against the rack about x_a x (c_b - pitch point). The rack may be as long as one
/// likes: turns are not counted. The multiplier is the force of the teeth at the pitch point, on the pinion
/// along x_a, on the rack the opposite. (The component across the rack, by the angle of the flanks, is left
/// out.)
template <class A, class B>
struct RackAndPinion {
  static constexpr std::string_view kind = "RackAndPinion";
  static constexpr std::string_view meaning =
      "force of the teeth at the pitch point, on the pinion along the rack";
  JointFrames<A, B> frames;  ///< at the pinion's centre, x along the rack
  double radius;             ///< [length]

  /// Centre, pitch point and the rack's direction, at a right angle to the line between them, are those in
  /// space when the bodies are added.
  RackAndPinion(const A& rack, const B& pinion, const Vec<3>& centre, const Vec<3>& pitch_point,
                const Vec<3>& direction) requires(A::dimension == 3)
      : frames(rack, pinion, centre, detail::axes_of_two(direction, centre - pitch_point)),
        radius((centre - pitch_point).norm()) {}
  /// In the plane the rack's direction is that of the line at a right angle to centre - pitch point.
  RackAndPinion(const A& rack, const B& pinion, const Vec<2>& centre,
                const Vec<2>& pitch_point) requires(A::dimension == 2)
      : frames(rack, pinion, centre,
               detail::joint_axes(Vec<2>(centre.y() - pitch_point.y(), pitch_point.x() - centre.x()))),
        radius((centre - pitch_point).norm()) {}

  auto points() const {
    const auto& a = frames.a;
    const auto& b = frames.b;
    return std::tie(a.origin, a.axes[0], a.axes[1], b.origin, b.axes[0]);
  }
  [[nodiscard]] Sketch sketch() const { return {"none"}; }
  auto operator()(const auto& c_a, const auto& x_a, const auto& y_a, const auto& c_b, const auto& x_b) const {
    const auto phase = x_a.dot(c_b - c_a) / (frames.length * radius) + detail::angle_between(x_a, y_a, x_b);
    return radius * detail::out_of_mesh(phase);
  }
  [[nodiscard]] std::string fault() const {
    return frames.fault(
        "centre, pitch point and direction must be finite, and the rack at a right angle to the line from "
        "its pitch point to the centre");
  }
};

}  // namespace dalembert
