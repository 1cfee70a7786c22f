#pragma once

#include <dalembert/core/equations/constraint.h>

namespace dalembert {

/// Holds two points together: a frictionless ball joint, or in the plane a pin.
///
///   g = r_b - r_a      [length], one equation per dimension
///
/// The multipliers are the force on b, component by component; a gets the opposite.
template <Point A, Point B>
struct Coincident {
  static constexpr std::string_view kind = "Coincident";
  static constexpr std::string_view meaning =
      "force on the second point, by components; the first feels the opposite";
  A a;
  B b;

  auto points() const { return std::tie(a, b); }
  [[nodiscard]] Sketch sketch() const { return {"ball"}; }
  auto operator()(const auto& r_a, const auto& r_b) const { return r_b - r_a; }
};
template <class A, class B>
Coincident(A, B) -> Coincident<A, B>;

// Compiled once, in the library.
extern template struct BatchOf<ConstraintBatch, Coincident<Particle<2>, Particle<2>>>;
extern template struct BatchOf<ConstraintBatch, Coincident<Particle<3>, Particle<3>>>;

}  // namespace dalembert
