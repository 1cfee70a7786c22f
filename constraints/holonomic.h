#pragma once

#include <dalembert/core/equations/constraint.h>

namespace dalembert {

/// A user's own holonomic constraint, as returned by `holonomic`.
///
/// The force of constraint does not depend on how the equation is scaled; the multiplier does: it
/// is a force in newtons where the gradient of g has unit length.
template <class Points, class Equation>
struct Holonomic {
  static constexpr std::string_view kind = "Holonomic";
  Points on;          ///< its points
  Equation equation;  ///< as it was stated

  /// Its points.
  const Points& points() const { return on; }
  /// Of one point it is a curve or surface.
  [[nodiscard]] Sketch sketch() const {
    using P = std::tuple_element_t<0, Points>;
    if constexpr (std::tuple_size_v<Points> == 1 && !std::is_same_v<P, Rotor>)
      return detail::figure_of<P::dimension>(equation);
    return {};
  }
  auto operator()(const auto&... a) const requires requires { equation(a...); }
  { return equation(a...); }
};

/// A holonomic constraint g = 0 from a lambda of the points' positions that returns g, a number or
/// a plain fixed-size vector of several equations:
///
///   scene.add(holonomic(points(a, b), [](auto r_a, auto r_b) { return (r_b - r_a).norm() - 1.0; }));
///
/// With time in front, `[](auto t, auto r_a, auto r_b)`, it is rheonomic. The lambda is called with
/// numbers that carry derivatives: write `auto`, and call `sqrt`, `sin`, ... without `std::`.
template <class... P, class Equation>
[[nodiscard]] auto holonomic(std::tuple<P...> on, Equation equation) {
  using Constraint = Holonomic<std::tuple<P...>, Equation>;
  if constexpr (detail::written_for_any_scalar<std::tuple<P...>, Equation>())
    static_assert(
        HolonomicConstraint<Constraint>,
        "the lambda of a holonomic constraint takes the position of each of its points, one argument "
        "each, and time in front of them if it depends on time");
  return Constraint{std::move(on), std::move(equation)};
}

}  // namespace dalembert
