#pragma once

#include <dalembert/constraints/joints/equations.h>
#include <dalembert/constraints/joints/frames.h>

namespace dalembert {

/// A Rotor that turns with a joint: the armature of a motor, a clock's spring, or a counter of turns of
/// little inertia. The positions of two bodies give the angle between them up to full turns; the rotor's
/// angle is a coordinate and goes on.
///
///   g = phi - angle of the rotor   mod 2 pi      [rad]
///
/// with phi the angle by which b has turned against a since they were added. The multiplier is the torque on
/// b about the axis; the opposite is on a, and minus it on the rotor. The rotor adds its inertia to the
/// joint's angle.
///
///   const Rotor turns = scene.add_rotor({.inertia = 1e-4, .angular_velocity = speed});
///   scene.add(TurnCounter{hinge, turns});
///   scene.add(potential(points(turns), [](auto phi) { return 0.5 * 0.2 * phi[0] * phi[0]; }));
template <class A, class B>
struct TurnCounter {
  static constexpr std::string_view kind = "TurnCounter";
  static constexpr std::string_view meaning =
      "torque on the second body about the axis; the opposite is on the rotor";
  JointFrames<A, B> frames;
  Rotor rotor;  ///< that counts the turns

  /// Of a joint that turns about its axis, or what add_joint returned for it.
  template <class J>
  TurnCounter(const J& of, Rotor turning) : frames(detail::turning_frames(of)), rotor(turning) {}

  auto points() const { return std::tuple_cat(frames.turning(), std::tie(rotor)); }
  [[nodiscard]] Sketch sketch() const { return {"none"}; }
  auto operator()(const auto& x_a, const auto& y_a, const auto& x_b, const auto& angle) const {
    return detail::out_of_mesh(detail::angle_between(x_a, y_a, x_b) - angle[0]);
  }
  [[nodiscard]] std::string fault() const { return frames.fault("its joint needs a finite nonzero axis"); }
};
template <class J>
TurnCounter(const J&, Rotor) -> TurnCounter<detail::BodyA<J>, detail::BodyB<J>>;

}  // namespace dalembert
