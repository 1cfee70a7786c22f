#pragma once

#include <dalembert/constraints/joints/equations.h>
#include <dalembert/constraints/joints/frames.h>

namespace dalembert {

/// A universal (Hooke's, Cardan's) joint: a cross whose one pin turns in a and whose other pin, at a right
/// angle to it, turns in b.
///
///   g = (c_b - c_a,  x_a . y_b)      [length, rad]
///
/// for unit vectors along the pin in a and the pin in b. Multipliers: the force on b along the axes of space,
/// and the torque on b about y_b x x_a, across the cross.
template <class A, class B>
struct Universal {
  static_assert(A::dimension == 3, "Universal is spatial; in the plane a hinge is a Revolute");
  static constexpr std::string_view kind = "Universal";
  static constexpr std::string_view meaning =
      "force on the second body along the axes of space, then torque across the cross";
  static constexpr std::string_view singular = "its two pins are parallel";
  JointFrames<A, B> frames;

  /// Point and pins are where they are in space when the bodies are added; the pins at a right angle.
  Universal(const A& a, const B& b, const Vec<3>& point, const Vec<3>& pin_in_a, const Vec<3>& pin_in_b)
      : frames(a, b, point, detail::axes_of_two(pin_in_a, pin_in_b)) {}

  auto points() const {
    return std::tie(frames.a.origin, frames.a.axes[0], frames.b.origin, frames.b.axes[1]);
  }
  [[nodiscard]] Sketch sketch() const { return {"hinge"}; }
  auto operator()(const auto& c_a, const auto& x_a, const auto& c_b, const auto& y_b) const {
    const auto d = c_b - c_a;
    return vec(d.x(), d.y(), d.z(), x_a.dot(y_b) / (frames.length * frames.length));
  }
  [[nodiscard]] std::string fault() const {
    return frames.fault("its pins must be finite, not zero, and at a right angle to each other");
  }
};

// Compiled once, in the library.
extern template struct BatchOf<ConstraintBatch, Universal<Ground<3>, RigidBody<3>>>;
extern template struct BatchOf<ConstraintBatch, Universal<RigidBody<3>, RigidBody<3>>>;

}  // namespace dalembert
