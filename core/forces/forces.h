#pragma once

#include <dalembert/core/forces/force.h>

#include <string>

namespace dalembert {

/// The same acceleration g for every particle: F = m g, V = -m g . r.
template <int D>
struct UniformGravity {
  Vec<D> acceleration = Vec<D>::Zero();  ///< [length / time^2]
};

/// A linear spring between two points: V = stiffness (|r_b - r_a| - relaxed_length)^2 / 2.
///
/// It pulls when stretched and pushes when compressed. With relaxed_length 0 the energy is smooth
/// even where the points meet.
template <Point A, Point B>
struct Spring {
  static constexpr std::string_view kind = "Spring";
  A a;
  B b;
  double stiffness;             ///< [force / length], finite and >= 0
  double relaxed_length = 0.0;  ///< [length], finite and >= 0

  auto points() const { return std::tie(a, b); }
  [[nodiscard]] Sketch sketch() const { return {"spring", {relaxed_length}}; }
  auto energy(const auto& r_a, const auto& r_b) const {
    using S = typename std::remove_cvref_t<decltype(r_a)>::Scalar;
    if (relaxed_length == 0.0) return S(0.5 * stiffness * (r_b - r_a).squaredNorm());
    const S stretch = (r_b - r_a).norm() - relaxed_length;
    return S(0.5 * stiffness * stretch * stretch);
  }
  [[nodiscard]] std::string fault() const {
    if (!(std::isfinite(stiffness) && stiffness >= 0.0)) {
      return "stiffness = " + detail::text(stiffness) + ", must be finite and >= 0";
    }
    if (!(std::isfinite(relaxed_length) && relaxed_length >= 0.0)) {
      return "relaxed_length = " + detail::text(relaxed_length) + ", must be finite and >= 0";
    }
    return {};
  }
};
template <class A, class B>
Spring(A, B, double) -> Spring<A, B>;
template <class A, class B>
Spring(A, B, double, double) -> Spring<A, B>;

/// A linear damper between two points: with e the unit vector from a to b, the force on b is
/// -coefficient (e . (v_b - v_a)) e, and the opposite on a.
template <Point A, Point B>
struct Damper {
  static constexpr std::string_view kind = "Damper";
  A a;
  B b;
  double coefficient;  ///< [force / speed], finite and >= 0

  auto points() const { return std::tie(a, b); }
  [[nodiscard]] Sketch sketch() const { return {"damper"}; }
  auto force(const auto& r_a, const auto& r_b, const auto& v_a, const auto& v_b) const {
    using V = std::remove_cvref_t<decltype(r_a)>;
    const V e = (r_b - r_a).normalized();
    const V on_a = (coefficient * e.dot(v_b - v_a)) * e;
    return std::tuple<V, V>{on_a, -on_a};
  }
  [[nodiscard]] std::string fault() const {
    if (!(std::isfinite(coefficient) && coefficient >= 0.0)) {
      return "coefficient = " + detail::text(coefficient) + ", must be finite and >= 0";
    }
    return {};
  }
};
template <class A, class B>
Damper(A, B, double) -> Damper<A, B>;

/// A user's own force from its potential energy; made by `potential`.
template <class Points, class Energy>
struct Potential {
  static constexpr std::string_view kind = "Potential";
  Points on;        ///< its points
  Energy function;  ///< as it was stated

  /// Its points.
  const Points& points() const { return on; }
  auto energy(const auto&... a) const requires requires { function(a...); }
  { return function(a...); }
};

/// A force from its potential: `potential(points(a, b), [](auto r_a, auto r_b) { return ...; })`, or
/// with time: `[](auto t, auto r_a, auto r_b)`.
template <class... P, class Energy>
[[nodiscard]] auto potential(std::tuple<P...> on, Energy energy) {
  using Force = Potential<std::tuple<P...>, Energy>;
  if constexpr (detail::written_for_any_scalar<std::tuple<P...>, Energy>())
    static_assert(
        PotentialForce<Force>,
        "the lambda of a potential takes the position of each of its points, one argument each, and "
        "time in front of them if it depends on time");
  return Force{std::move(on), std::move(energy)};
}

/// A user's own force from its law; made by `force_law`.
template <class Points, class Law>
struct ForceFromLaw {
  static constexpr std::string_view kind = "ForceLaw";
  Points on;     ///< its points
  Law function;  ///< as it was stated

  /// Its points.
  const Points& points() const { return on; }
  auto force(const auto&... a) const requires requires { function(a...); }
  { return function(a...); }
};

/// A force from its law: `force_law(points(a), [](auto r, auto v) { return -0.1 * v; })`,
/// with time in front if it depends on time. For several points return std::tuple{f_a, f_b}.
template <class... P, class Law>
[[nodiscard]] auto force_law(std::tuple<P...> on, Law law) {
  using Force = ForceFromLaw<std::tuple<P...>, Law>;
  if constexpr (detail::written_for_any_scalar<std::tuple<P...>, Law>())
    static_assert(LawForce<Force>,
                  "the lambda of a force law takes the position of each of its points, then the velocity of "
                  "each, and time in front of them if it depends on time");
  return Force{std::move(on), std::move(law)};
}

// Compiled once, in the library.
extern template struct BatchOf<ForceBatch, Spring<Fixed<2>, Particle<2>>>;
extern template struct BatchOf<ForceBatch, Spring<Particle<2>, Particle<2>>>;
extern template struct BatchOf<ForceBatch, Spring<Fixed<3>, Particle<3>>>;
extern template struct BatchOf<ForceBatch, Spring<Particle<3>, Particle<3>>>;
extern template struct BatchOf<ForceBatch, Damper<Fixed<2>, Particle<2>>>;
extern template struct BatchOf<ForceBatch, Damper<Particle<2>, Particle<2>>>;
extern template struct BatchOf<ForceBatch, Damper<Fixed<3>, Particle<3>>>;
extern template struct BatchOf<ForceBatch, Damper<Particle<3>, Particle<3>>>;

}  // namespace dalembert
