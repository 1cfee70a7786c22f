#pragma once

#include <dalembert/constraints/joints/equations.h>
#include <dalembert/constraints/joints/frames.h>

namespace dalembert {

/// A slide: b moves along a line of a and does not turn against it, in the plane or in space.
///
///   g = (x_a . d,  y_a . d,  -y_a . z_b,  x_a . z_b,  y_a . x_b),   d = c_b - c_a      [length, rad]
///
/// for unit vectors with z along the slide; in the plane x is along it and g = (y_a . d, y_a . x_b).
/// Multipliers: the forces on b along x_a and y_a, at c_b, and the torques on b about x_a, y_a, z_a; in the
/// plane the force along y_a and the torque.
template <class A, class B>
struct Prismatic {
  static constexpr std::string_view kind = "Prismatic";
  static constexpr std::string_view meaning =
      "forces on the second body across the slide, then torques on it";
  static constexpr bool slides = true;
  JointFrames<A, B> frames;

  /// Point and direction are where they are in space when the bodies are added.
  Prismatic(const A& a, const B& b, const Vec<A::dimension>& point, const Vec<A::dimension>& direction)
      : frames(a, b, point, detail::joint_axes(direction)) {}

  auto points() const { return frames.whole(); }
  [[nodiscard]] Sketch sketch() const { return {"slider"}; }
  auto operator()(const auto& c_a, const auto& y_a, const auto& c_b, const auto& x_b) const {
    const double l = frames.length;
    return vec(y_a.dot(c_b - c_a) / l, y_a.dot(x_b) / (l * l));
  }
  auto operator()(const auto& c_a, const auto& x_a, const auto& y_a, const auto& c_b, const auto& x_b,
                  const auto& z_b) const {
    const auto d = c_b - c_a;
    const double l = frames.length, l2 = l * l;
    return vec(x_a.dot(d) / l, y_a.dot(d) / l, -y_a.dot(z_b) / l2, x_a.dot(z_b) / l2, y_a.dot(x_b) / l2);
  }
  [[nodiscard]] std::string fault() const {
    return frames.fault("its direction must be finite and not zero");
  }
};

// Compiled once, in the library.
extern template struct BatchOf<ConstraintBatch, Prismatic<Ground<2>, RigidBody<2>>>;
extern template struct BatchOf<ConstraintBatch, Prismatic<RigidBody<2>, RigidBody<2>>>;
extern template struct BatchOf<ConstraintBatch, Prismatic<Ground<3>, RigidBody<3>>>;
extern template struct BatchOf<ConstraintBatch, Prismatic<RigidBody<3>, RigidBody<3>>>;

}  // namespace dalembert
