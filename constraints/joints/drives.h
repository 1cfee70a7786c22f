#pragma once

#include <dalembert/constraints/joints/equations.h>
#include <dalembert/constraints/joints/frames.h>

/// Joints driven in time: `add_joint(scene, AngleDrive{hinge, [](auto t) { return 2.0 * t; }}, "motor")`.
namespace dalembert {

/// The angle of a joint about its axis follows a function of time, over as many turns as it likes.
///
///   g = phi - angle(t)   mod 2 pi      [rad]
///
/// with phi the angle by which b has turned against a since they were added. The multiplier is the torque of
/// the motor, on b about the axis; the opposite is on a.
template <class A, class B, class Angle>
struct AngleDrive {
  static constexpr std::string_view kind = "AngleDrive";
  JointFrames<A, B> frames;
  Angle angle;  ///< of time [rad]; the bodies start where it does

  /// Of a joint that turns about its axis, or what add_joint returned for it.
  template <class J>
  AngleDrive(const J& of, Angle law) : frames(detail::frames_of(of)), angle(std::move(law)) {
    static_assert(detail::turns<J>,
                  "its joint must turn about its axis: Revolute, Cylindrical, Planar, Screw");
  }

  auto points() const { return std::tie(frames.a.axes[0], frames.a.axes[1], frames.b.axes[0]); }
  auto operator()(const auto& t, const auto& x_a, const auto& y_a, const auto& x_b) const {
    return detail::out_of_mesh(detail::angle_between(x_a, y_a, x_b) - angle(t));
  }
  [[nodiscard]] std::string fault() const { return frames.fault("the axis of its joint must be one"); }
};
template <class J, class Angle>
AngleDrive(const J&, Angle) -> AngleDrive<detail::BodyA<J>, detail::BodyB<J>, Angle>;

/// The travel of a joint along its axis follows a function of time.
///
///   g = z_a . (c_b - c_a) - path(t)      [length]; in the plane along x_a
///
/// The multiplier is the force of the drive, on b along the axis, at c_b; the opposite is on a.
template <class A, class B, class Path>
struct PathDrive {
  static constexpr std::string_view kind = "PathDrive";
  JointFrames<A, B> frames;
  Path path;  ///< of time [length]

  /// Of a joint that slides along its axis, or what add_joint returned for it.
  template <class J>
  PathDrive(const J& of, Path law) : frames(detail::frames_of(of)), path(std::move(law)) {
    static_assert(detail::slides<J>, "its joint must slide along its axis: Prismatic, Cylindrical, Screw");
  }

  auto points() const {
    return std::tie(frames.a.origin, frames.a.axes[detail::along<A::dimension>], frames.b.origin);
  }
  auto operator()(const auto& t, const auto& c_a, const auto& z_a, const auto& c_b) const {
    return z_a.dot(c_b - c_a) / frames.length - path(t);
  }
  [[nodiscard]] std::string fault() const { return frames.fault("the axis of its joint must be one"); }
};
template <class J, class Path>
PathDrive(const J&, Path) -> PathDrive<detail::BodyA<J>, detail::BodyB<J>, Path>;

}  // namespace dalembert
