#pragma once

#include <dalembert/core/forces/force.h>

#include <string>

namespace dalembert {

namespace detail {
[[nodiscard]] inline std::string not_negative(double value, const char* name) {
  if (std::isfinite(value) && value >= 0.0) return {};
  return std::string(name) + " = " + detail::text(value) + ", must be finite and >= 0";
}
}  // namespace detail

/// Gravity of one point: V = -mass g . r. For a scene in which not everything falls; otherwise use
/// UniformGravity.
template <Point P>
struct PointGravity {
  static constexpr std::string_view kind = "PointGravity";
  P point;
  double mass;                     ///< finite and >= 0
  Vec<P::dimension> acceleration;  ///< [length / time^2]

  auto points() const { return std::tie(point); }
  auto energy(const auto& r) const { return -mass * acceleration.dot(r); }
  [[nodiscard]] std::string fault() const {
    return acceleration.allFinite() ? detail::not_negative(mass, "mass") : "acceleration must be finite";
  }
};
template <class P>
PointGravity(P, double, Vec<P::dimension>) -> PointGravity<P>;

/// Drag in proportion to the speed: F = -coefficient v.
template <Point P>
struct LinearDrag {
  static constexpr std::string_view kind = "LinearDrag";
  P point;
  double coefficient;  ///< [force / speed], finite and >= 0

  auto points() const { return std::tie(point); }
  auto force(const auto& /*r*/, const auto& v) const { return -coefficient * v; }
  [[nodiscard]] std::string fault() const { return detail::not_negative(coefficient, "coefficient"); }
};
template <class P>
LinearDrag(P, double) -> LinearDrag<P>;

/// Drag in proportion to the square of the speed: F = -coefficient |v| v.
template <Point P>
struct QuadraticDrag {
  static constexpr std::string_view kind = "QuadraticDrag";
  P point;
  double coefficient;  ///< [force / speed^2], finite and >= 0

  auto points() const { return std::tie(point); }
  auto force(const auto& /*r*/, const auto& v) const {
    using V = std::remove_cvref_t<decltype(v)>;
    const auto square = v.squaredNorm();
    if (square == 0.0) return V(V::Zero());  // |v| has no derivative at rest; the force's is zero there
    using std::sqrt;
    return V((-coefficient * sqrt(square)) * v);
  }
  [[nodiscard]] std::string fault() const { return detail::not_negative(coefficient, "coefficient"); }
};
template <class P>
QuadraticDrag(P, double) -> QuadraticDrag<P>;

/// A constant torque on a rotor: V = -torque phi.
struct Torque {
  static constexpr std::string_view kind = "Torque";
  Rotor rotor;    ///< that it turns
  double torque;  ///< [force length], finite

  auto points() const { return std::tie(rotor); }
  auto energy(const auto& phi) const { return -torque * phi[0]; }
  [[nodiscard]] std::string fault() const { return std::isfinite(torque) ? "" : "torque must be finite"; }
};

/// A constant torque on a planar body, counter-clockwise, as a couple of forces on two of its points:
/// with d = r_b - r_a and d turned left by a right angle as n,
///
///   F_b = torque n/|d|^2,   F_a = -F_b.
///
/// On a body that turns about a fixed point, that point may be one of the two. The torque has no
/// single-valued potential: the energy of a run does not contain its work, torque times the angle.
template <Point A, Point B>
struct Couple {
  static_assert(A::dimension == 2, "Couple is planar");
  static constexpr std::string_view kind = "Couple";
  A a;
  B b;
  double torque;  ///< [force length], finite

  auto points() const { return std::tie(a, b); }
  auto force(const auto& r_a, const auto& r_b, const auto& /*v_a*/, const auto& /*v_b*/) const {
    using V = std::remove_cvref_t<decltype(r_a)>;
    const V d = r_b - r_a;
    const V on_b = (torque / d.squaredNorm()) * V(-d.y(), d.x());
    return std::tuple<V, V>{-on_b, on_b};
  }
  [[nodiscard]] std::string fault() const { return std::isfinite(torque) ? "" : "torque must be finite"; }
};
template <class A, class B>
Couple(A, B, double) -> Couple<A, B>;

/// An elastic string between two points, which only pulls (notes, mex251):
/// V = stiffness max(0, |r_b - r_a| - relaxed_length)^2 / 2. Slack, it exerts no force. The force is
/// continuous where it becomes taut; its stiffness jumps there.
template <Point A, Point B>
struct ElasticString {
  static constexpr std::string_view kind = "ElasticString";
  A a;
  B b;
  double stiffness;       ///< [force / length], finite and >= 0
  double relaxed_length;  ///< [length], finite and > 0

  auto points() const { return std::tie(a, b); }
  [[nodiscard]] Sketch sketch() const { return {"string", {relaxed_length}}; }
  auto energy(const auto& r_a, const auto& r_b) const {
    using S = typename std::remove_cvref_t<decltype(r_a)>::Scalar;
    const S square = (r_b - r_a).squaredNorm();
    if (square <= relaxed_length * relaxed_length) return S(0.0);
    using std::sqrt;
    const S stretch = sqrt(square) - relaxed_length;
    return S(0.5 * stiffness * stretch * stretch);
  }
  [[nodiscard]] std::string fault() const {
    if (!(std::isfinite(relaxed_length) && relaxed_length > 0.0)) {
      return "relaxed_length = " + detail::text(relaxed_length) + ", must be finite and > 0";
    }
    return detail::not_negative(stiffness, "stiffness");
  }
};
template <class A, class B>
ElasticString(A, B, double, double) -> ElasticString<A, B>;

// Compiled once, in the library.
extern template struct BatchOf<ForceBatch, LinearDrag<Particle<2>>>;
extern template struct BatchOf<ForceBatch, LinearDrag<Particle<3>>>;
extern template struct BatchOf<ForceBatch, QuadraticDrag<Particle<2>>>;
extern template struct BatchOf<ForceBatch, QuadraticDrag<Particle<3>>>;
extern template struct BatchOf<ForceBatch, Torque>;

}  // namespace dalembert
