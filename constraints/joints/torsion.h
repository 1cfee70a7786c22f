#pragma once

#include <dalembert/constraints/joints/equations.h>
#include <dalembert/constraints/joints/frames.h>

#include <numbers>

/// Springs and dampers that turn: `scene.add(TorsionSpring{hinge, 40.0})`.
namespace dalembert {

/// A linear spring in the angle of a joint about its axis: V = stiffness (phi - relaxed_angle)^2/2, with phi
/// the angle by which b has turned against a since they were added. The torque on b is
/// -stiffness (phi - relaxed_angle).
///
/// The positions of two bodies do not determine how often one has turned. So the spring may be turned by up
/// to 150 degrees from where it is relaxed; beyond that the run stops with an error. One that is wound up
/// acts on the Rotor of a TurnCounter.
template <class A, class B>
struct TorsionSpring {
  static constexpr std::string_view kind = "TorsionSpring";
  JointFrames<A, B> frames;
  double stiffness;      ///< [force length / rad], finite and >= 0
  double relaxed_angle;  ///< [rad]

  /// Of a joint that turns about its axis, or what add_joint returned for it.
  template <class J>
  TorsionSpring(const J& of, double its_stiffness, double its_relaxed_angle = 0.0)
      : frames(detail::turning_frames(of)), stiffness(its_stiffness), relaxed_angle(its_relaxed_angle) {}

  auto points() const { return frames.turning(); }
  [[nodiscard]] Sketch sketch() const { return {"none"}; }
  auto energy(const auto& x_a, const auto& y_a, const auto& x_b) const {
    using std::atan2;
    using std::cos;
    using std::sin;
    const auto turn = detail::angle_between(x_a, y_a, x_b) - relaxed_angle;
    const auto c = cos(turn);
    if (c < -0.5 * std::numbers::sqrt3) {
      throw std::domain_error(
          "is turned by more than 150 degrees from where it is relaxed; give it a Rotor that a TurnCounter "
          "turns");
    }
    const auto phi = atan2(sin(turn), c);
    return 0.5 * stiffness * phi * phi;
  }
  [[nodiscard]] std::string fault() const {
    if (!(std::isfinite(stiffness) && stiffness >= 0.0)) {
      return "stiffness = " + detail::text(stiffness) + ", must be finite and >= 0";
    }
    if (!std::isfinite(relaxed_angle)) {
      return "relaxed_angle = " + detail::text(relaxed_angle) + ", must be finite";
    }
    return frames.fault("its joint needs a finite nonzero axis");
  }
};
template <class J>
TorsionSpring(const J&, double) -> TorsionSpring<detail::BodyA<J>, detail::BodyB<J>>;
template <class J>
TorsionSpring(const J&, double, double) -> TorsionSpring<detail::BodyA<J>, detail::BodyB<J>>;

/// A linear damper in a joint: the torque on b about the axis is -coefficient times the rate of the joint's
/// angle, and the opposite on a.
///
/// With s = y_a . x_b, c = x_a . x_b the angle is atan2(s, c), and a torque T in it is the force T dphi/dr on
/// each vector r: (c y_a - s x_a)/(c^2 + s^2) on x_b, -s x_b/(c^2 + s^2) on x_a, c x_b/(c^2 + s^2) on y_a.
template <class A, class B>
struct TorsionDamper {
  static constexpr std::string_view kind = "TorsionDamper";
  JointFrames<A, B> frames;
  double coefficient;  ///< [force length time / rad], finite and >= 0

  /// Of a joint that turns about its axis, or what add_joint returned for it.
  template <class J>
  TorsionDamper(const J& of, double its_coefficient)
      : frames(detail::turning_frames(of)), coefficient(its_coefficient) {}

  auto points() const { return frames.turning(); }
  [[nodiscard]] Sketch sketch() const { return {"none"}; }
  auto force(const auto& x_a, const auto& y_a, const auto& x_b, const auto& x_a_rate, const auto& y_a_rate,
             const auto& x_b_rate) const {
    using V = std::remove_cvref_t<decltype(x_b)>;
    using S = typename V::Scalar;
    const S s = y_a.dot(x_b), c = x_a.dot(x_b);
    const S T = -coefficient * detail::rate_of_angle(x_a, y_a, x_b, x_a_rate, y_a_rate, x_b_rate);
    const S per = T / (c * c + s * s);
    return std::tuple<V, V, V>{V(-per * s * x_b), V(per * c * x_b), V(per * (c * y_a - s * x_a))};
  }
  [[nodiscard]] std::string fault() const {
    if (!(std::isfinite(coefficient) && coefficient >= 0.0)) {
      return "coefficient = " + detail::text(coefficient) + ", must be finite and >= 0";
    }
    return frames.fault("its joint needs a finite nonzero axis");
  }
};
template <class J>
TorsionDamper(const J&, double) -> TorsionDamper<detail::BodyA<J>, detail::BodyB<J>>;

}  // namespace dalembert
