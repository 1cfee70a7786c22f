#pragma once

#include <dalembert/core/equations/constraint.h>

namespace dalembert {

/// A user's own constraint on velocities, as returned by `nonholonomic` (notes, mln37).
template <class Points, class Equation>
struct Nonholonomic {
  static constexpr std::string_view kind = "Nonholonomic";
  static constexpr bool velocity_level = true;
  Points on;          ///< its points
  Equation equation;  ///< as it was stated

  /// Its points.
  const Points& points() const { return on; }
  auto operator()(const auto&... a) const requires requires { equation(a...); }
  { return equation(a...); }
};

/// A constraint a = 0, linear in the velocities, from a lambda of the points' positions and then
/// their velocities (with time in front, if it depends on time):
///
///   scene.add(nonholonomic(points(p), [](auto r, auto v) { return v.y() - r.x() * v.x(); }));
///
/// The force of constraint is lambda times the gradient of a with respect to the velocities.
template <class... P, class Equation>
[[nodiscard]] auto nonholonomic(std::tuple<P...> on, Equation equation) {
  using Constraint = Nonholonomic<std::tuple<P...>, Equation>;
  if constexpr (detail::written_for_any_scalar<std::tuple<P...>, Equation>())
    static_assert(
        NonholonomicConstraint<Constraint>,
        "the lambda of a nonholonomic constraint takes the position of each of its points, then the "
        "velocity of each, and time in front of them if it depends on time");
  return Constraint{std::move(on), std::move(equation)};
}

}  // namespace dalembert
