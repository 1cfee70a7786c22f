#pragma once

#include <dalembert/constraints/joints/equations.h>
#include <dalembert/constraints/joints/frames.h>

#include <numbers>

namespace dalembert {

/// A screw in its nut: b turns about an axis of a and moves along it by `pitch` for each full turn.
///
///   g = (x_a . d,  y_a . d,  -y_a . z_b,  x_a . z_b,  z_a . d - pitch phi/(2 pi)  mod pitch),   d = c_b -
///   c_a
///                                                                                          [length, rad]
///
/// for unit vectors with z along the axis, phi the angle of b against a about it. A thread repeats itself
/// after each turn and so does its equation: turns are not counted, nor need be. (A helix as a relation of
/// velocities would count none either, but drift.) The last multiplier is the force on b along the axis,
/// with a torque of -pitch/(2 pi) times that about it; the others are as of Cylindrical.
template <class A, class B>
struct Screw {
  static_assert(A::dimension == 3, "Screw is spatial");
  static constexpr std::string_view kind = "Screw";
  static constexpr std::string_view meaning =
      "forces on the second body across the axis, torques about these, and force along the axis";
  static constexpr bool slides = true;
  static constexpr bool turns = true;
  JointFrames<A, B> frames;
  double pitch;  ///< [length], finite and not 0; > 0 of a right-handed thread

  /// Point and axis are where they are in space when the bodies are added.
  Screw(const A& a, const B& b, const Vec<3>& point, const Vec<3>& axis, double pitch_of_thread)
      : frames(a, b, point, detail::joint_axes(axis)), pitch(pitch_of_thread) {}

  auto points() const {
    const auto& a = frames.a;
    const auto& b = frames.b;
    return std::tie(a.origin, a.axes[0], a.axes[1], a.axes[2], b.origin, b.axes[0], b.axes[2]);
  }
  [[nodiscard]] Sketch sketch() const { return {"slider"}; }
  auto operator()(const auto& c_a, const auto& x_a, const auto& y_a, const auto& z_a, const auto& c_b,
                  const auto& x_b, const auto& z_b) const {
    const auto d = c_b - c_a;
    const double l = frames.length, l2 = l * l, per_radian = pitch / (2.0 * std::numbers::pi);
    const auto phase = z_a.dot(d) / (l * per_radian) - detail::angle_between(x_a, y_a, x_b);
    return vec(x_a.dot(d) / l, y_a.dot(d) / l, -y_a.dot(z_b) / l2, x_a.dot(z_b) / l2,
               per_radian * detail::out_of_mesh(phase));
  }
  [[nodiscard]] std::string fault() const {
    if (!(std::isfinite(pitch) && pitch != 0.0)) {
      return "pitch = " + detail::text(pitch) + ", must be finite and not 0; without pitch use Revolute";
    }
    return frames.fault("its axis must be finite and not zero");
  }
};

}  // namespace dalembert
