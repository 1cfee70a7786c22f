#pragma once

#include <dalembert/constraints/joints/equations.h>
#include <dalembert/constraints/joints/frames.h>

namespace dalembert {

/// Two bodies made one, in the plane or in space. Its point does not matter to the motion; the reaction is
/// that across a cut there.
///
///   g = (c_b - c_a,  -y_a . z_b,  x_a . z_b,  y_a . x_b)      [length, rad]; in the plane (c_b - c_a, y_a .
///   x_b)
///
/// Multipliers: the force on b along the axes of space, then the torques on b about those of space as a
/// carries them.
template <class A, class B>
struct Weld {
  static constexpr std::string_view kind = "Weld";
  static constexpr std::string_view meaning =
      "force on the second body along the axes of space, then torques on it";
  JointFrames<A, B> frames;

  /// The point is where it is in space when the bodies are added.
  Weld(const A& a, const B& b, const Vec<A::dimension>& point)
      : frames(a, b, point, JointFrames<A, B>::Axes::Identity()) {}

  auto points() const { return frames.whole(); }
  [[nodiscard]] Sketch sketch() const { return {"weld"}; }
  auto operator()(const auto& c_a, const auto& y_a, const auto& c_b, const auto& x_b) const {
    const auto d = c_b - c_a;
    return vec(d.x(), d.y(), y_a.dot(x_b) / (frames.length * frames.length));
  }
  auto operator()(const auto& c_a, const auto& x_a, const auto& y_a, const auto& c_b, const auto& x_b,
                  const auto& z_b) const {
    const auto d = c_b - c_a;
    const double l2 = frames.length * frames.length;
    return vec(d.x(), d.y(), d.z(), -y_a.dot(z_b) / l2, x_a.dot(z_b) / l2, y_a.dot(x_b) / l2);
  }
  [[nodiscard]] std::string fault() const { return frames.fault("its axes must be finite"); }
};

// Compiled once, in the library.
extern template struct BatchOf<ConstraintBatch, Weld<Ground<3>, RigidBody<3>>>;
extern template struct BatchOf<ConstraintBatch, Weld<RigidBody<3>, RigidBody<3>>>;

}  // namespace dalembert
