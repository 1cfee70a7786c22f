#pragma once

#include <dalembert/constraints/joints/equations.h>
#include <dalembert/constraints/joints/frames.h>

namespace dalembert {

/// A hinge: b turns against a about an axis through a point, both fixed in each. In the plane it is a pin.
///
///   scene.add(Revolute{Ground<3>{}, door, {0, 0, 0}, {0, 0, 1}}, "hinge");
///
///   g = (c_b - c_a,  -y_a . z_b,  x_a . z_b)      [length, rad]; in the plane c_b - c_a
///
/// for unit vectors x_a, y_a across the axis z. The first multipliers are the force on b, along the axes of
/// space; the last two the torques on b about x_a and y_a. (Two ball joints on the axis would be redundant in
/// their forces along it.)
template <class A, class B>
struct Revolute {
  static constexpr std::string_view kind = "Revolute";
  static constexpr std::string_view meaning =
      "force on the second body along the axes of space, then torques across the hinge";
  static constexpr bool turns = true;
  JointFrames<A, B> frames;

  /// Point and axis are where they are in space when the bodies are added.
  Revolute(const A& a, const B& b, const Vec<3>& point, const Vec<3>& axis) requires(A::dimension == 3)
      : frames(a, b, point, detail::joint_axes(axis)) {}
  /// The same in the plane, about its normal.
  Revolute(const A& a, const B& b, const Vec<2>& point) requires(A::dimension == 2)
      : frames(a, b, point, Mat<2, 2>::Identity()) {}

  auto points() const {
    if constexpr (A::dimension == 2) {
      return std::tie(frames.a.origin, frames.b.origin);
    } else {
      return frames.axis();
    }
  }
  [[nodiscard]] Sketch sketch() const { return {"hinge"}; }
  auto operator()(const auto& c_a, const auto& c_b) const { return c_b - c_a; }
  auto operator()(const auto& c_a, const auto& x_a, const auto& y_a, const auto& c_b, const auto& z_b) const {
    const auto d = c_b - c_a;
    const double l2 = frames.length * frames.length;
    return vec(d.x(), d.y(), d.z(), -y_a.dot(z_b) / l2, x_a.dot(z_b) / l2);
  }
  [[nodiscard]] std::string fault() const { return frames.fault("its axis must be finite and not zero"); }
};

// Compiled once, in the library.
extern template struct BatchOf<ConstraintBatch, Revolute<Ground<2>, RigidBody<2>>>;
extern template struct BatchOf<ConstraintBatch, Revolute<RigidBody<2>, RigidBody<2>>>;
extern template struct BatchOf<ConstraintBatch, Revolute<Ground<3>, RigidBody<3>>>;
extern template struct BatchOf<ConstraintBatch, Revolute<RigidBody<3>, RigidBody<3>>>;

}  // namespace dalembert
