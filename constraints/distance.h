#pragma once

#include <dalembert/core/equations/constraint.h>

#include <string>

namespace dalembert {

/// Keeps two points a fixed distance apart: a massless rigid rod (notes, mex132, mln36).
///
///   g = |r_b - r_a| - length      [length]
///
/// The gradient is a unit vector along the rod, so the multiplier is the force in it:
/// lambda < 0 pulls the points together (tension = -lambda), lambda > 0 pushes them apart.
/// The polynomial (r^2 - length^2)/2 would be cheaper but measures lambda in force per length
/// and couples the tolerance to the size of the rod.
///
/// Singular for coincident points: to hold two points together use Coincident.
template <Point A, Point B>
struct Distance {
  static constexpr std::string_view kind = "Distance";
  static constexpr std::string_view meaning =
      "force in the rod: < 0 pulls its ends together, tension is -lambda";
  static constexpr std::string_view singular =
      "its two points coincide; to hold two points together use Coincident";
  A a;
  B b;
  double length;  ///< [length], finite and > 0

  auto points() const { return std::tie(a, b); }
  [[nodiscard]] Sketch sketch() const { return {"rod", {length}}; }
  auto operator()(const auto& r_a, const auto& r_b) const { return (r_b - r_a).norm() - length; }

  [[nodiscard]] std::string fault() const {
    if (std::isfinite(length) && length > 0.0) return {};
    return "length = " + detail::text(length) +
           ", must be finite and > 0; to hold two points together use Coincident";
  }
};
template <class A, class B>
Distance(A, B, double) -> Distance<A, B>;

// Compiled once, in the library.
extern template struct BatchOf<ConstraintBatch, Distance<Fixed<2>, Particle<2>>>;
extern template struct BatchOf<ConstraintBatch, Distance<Particle<2>, Fixed<2>>>;
extern template struct BatchOf<ConstraintBatch, Distance<Particle<2>, Particle<2>>>;
extern template struct BatchOf<ConstraintBatch, Distance<Fixed<3>, Particle<3>>>;
extern template struct BatchOf<ConstraintBatch, Distance<Particle<3>, Fixed<3>>>;
extern template struct BatchOf<ConstraintBatch, Distance<Particle<3>, Particle<3>>>;

}  // namespace dalembert
