#pragma once

#include <dalembert/constraints/joints/equations.h>
#include <dalembert/constraints/joints/frames.h>

namespace dalembert {

/// A sleeve on a shaft: b slides along an axis of a and turns about it.
///
///   g = (x_a . d,  y_a . d,  -y_a . z_b,  x_a . z_b),   d = c_b - c_a      [length, rad]
///
/// for unit vectors x_a, y_a across the axis z. Multipliers: the forces on b along x_a and y_a, at c_b, and
/// the torques on b about them.
template <class A, class B>
struct Cylindrical {
  static_assert(A::dimension == 3, "Cylindrical is spatial; in the plane a slide is a Prismatic");
  static constexpr std::string_view kind = "Cylindrical";
  static constexpr std::string_view meaning =
      "forces on the second body across the shaft, then torques about these directions";
  static constexpr bool slides = true;
  static constexpr bool turns = true;
  JointFrames<A, B> frames;

  /// Point and axis are where they are in space when the bodies are added.
  Cylindrical(const A& a, const B& b, const Vec<3>& point, const Vec<3>& axis)
      : frames(a, b, point, detail::joint_axes(axis)) {}

  auto points() const { return frames.axis(); }
  [[nodiscard]] Sketch sketch() const { return {"slider"}; }
  auto operator()(const auto& c_a, const auto& x_a, const auto& y_a, const auto& c_b, const auto& z_b) const {
    const auto d = c_b - c_a;
    const double l = frames.length, l2 = l * l;
    return vec(x_a.dot(d) / l, y_a.dot(d) / l, -y_a.dot(z_b) / l2, x_a.dot(z_b) / l2);
  }
  [[nodiscard]] std::string fault() const { return frames.fault("its axis must be finite and not zero"); }
};

// Compiled once, in the library.
extern template struct BatchOf<ConstraintBatch, Cylindrical<Ground<3>, RigidBody<3>>>;
extern template struct BatchOf<ConstraintBatch, Cylindrical<RigidBody<3>, RigidBody<3>>>;

}  // namespace dalembert
