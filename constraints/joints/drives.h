#pragma once

#include <dalembert/constraints/joints/equations.h>
#include <dalembert/constraints/joints/frames.h>

/// Joints driven in time.
namespace dalembert {

/// A motor: the angle of a joint about its axis follows a function of time, over as many turns as it likes.
///
///   const Rotor armature = scene.add_rotor({.inertia = 1e-4, .angular_velocity = 2.0});
///   add_joint(scene, AngleDrive{hinge, armature, [](auto t) { return 2.0 * t; }}, "motor");
///
///   g = (phi - phi_r  mod 2 pi,   phi_r - angle(t))      [rad]
///
/// with phi the angle by which b has turned against a since they were added, phi_r that of the rotor. The
/// first multiplier is the torque of the motor's shaft, on b about the axis; the opposite is on a. The second
/// is what drives the armature: besides the shaft's torque its inertia times its angular acceleration. (The
/// bodies' positions alone do not determine how often b has turned: without the rotor, whose angle does, a
/// law that turns fast by whole turns and rests again would be satisfied by not turning.)
template <class A, class B, class Angle>
struct AngleDrive {
  static constexpr std::string_view kind = "AngleDrive";
  static constexpr std::string_view meaning =
      "torque of the shaft on the second body about the axis, and torque that drives the armature";
  JointFrames<A, B> frames;
  Rotor rotor;  ///< the armature
  Angle angle;  ///< of time [rad]; bodies and rotor start where it does

  /// Of a joint that turns about its axis, or what add_joint returned for it.
  template <class J>
  AngleDrive(const J& of, Rotor armature, Angle law)
      : frames(detail::turning_frames(of)), rotor(armature), angle(std::move(law)) {}

  auto points() const { return std::tuple_cat(frames.turning(), std::tie(rotor)); }
  [[nodiscard]] Sketch sketch() const { return {"none"}; }
  auto operator()(const auto& t, const auto& x_a, const auto& y_a, const auto& x_b, const auto& phi_r) const {
    return vec(detail::out_of_mesh(detail::angle_between(x_a, y_a, x_b) - phi_r[0]), phi_r[0] - angle(t));
  }
  [[nodiscard]] std::string fault() const { return frames.fault("its joint needs a finite nonzero axis"); }
};
template <class J, class Angle>
AngleDrive(const J&, Rotor, Angle) -> AngleDrive<detail::BodyA<J>, detail::BodyB<J>, Angle>;

/// The travel of a joint along its axis follows a function of time.
///
///   g = z_a . (c_b - c_a) - path(t)      [length]; in the plane along x_a
///
/// The multiplier is the force of the drive, on b along the axis, at c_b; the opposite is on a.
template <class A, class B, class Path>
struct PathDrive {
  static constexpr std::string_view kind = "PathDrive";
  static constexpr std::string_view meaning = "force of the drive on the second body along the axis";
  JointFrames<A, B> frames;
  Path path;  ///< of time [length]

  /// Of a joint that slides along its axis, or what add_joint returned for it.
  template <class J>
  PathDrive(const J& of, Path law) : frames(detail::sliding_frames(of)), path(std::move(law)) {}

  auto points() const {
    return std::tie(frames.a.origin, frames.a.axes[detail::along<A::dimension>], frames.b.origin);
  }
  [[nodiscard]] Sketch sketch() const { return {"none"}; }
  auto operator()(const auto& t, const auto& c_a, const auto& z_a, const auto& c_b) const {
    return z_a.dot(c_b - c_a) / frames.length - path(t);
  }
  [[nodiscard]] std::string fault() const { return frames.fault("its joint needs a finite nonzero axis"); }
};
template <class J, class Path>
PathDrive(const J&, Path) -> PathDrive<detail::BodyA<J>, detail::BodyB<J>, Path>;

}  // namespace dalembert
