#pragma once

#include <dalembert/constraints/geometry/surfaces.h>
#include <dalembert/core/equations/constraint.h>

namespace dalembert {

/// Keeps a point on a plane curve given by an implicit function g(r) = 0 (with time in front if the
/// curve moves): Plane<2> for a line, Sphere<2> for a circle, or a lambda,
///
///   scene.add(OnCurve{bead, [](auto r) { return r.y() - r.x() * r.x(); }});      (notes, mex131)
///
/// Z = lambda grad g, towards g > 0 for lambda > 0; lambda is the normal force divided by |grad g|.
template <Point P, class Curve>
struct OnCurve {
  static_assert(P::dimension == 2,
                "OnCurve is planar; in space a curve is the intersection of two OnSurface");
  static_assert(detail::written_for_any_scalar<std::tuple<P>, Curve>());
  static constexpr std::string_view kind = "OnCurve";
  static constexpr std::string_view meaning =
      "normal force on the point, over |grad g|; > 0 pushes towards g > 0";
  static constexpr std::string_view singular = "the curve has no normal there";
  P point;
  Curve curve;  ///< an equation g([t,] r)

  auto points() const { return std::tie(point); }
  [[nodiscard]] Sketch sketch() const { return detail::figure_of<2>(curve); }
  auto operator()(const auto&... a) const requires requires { curve(a...); }
  { return curve(a...); }
  [[nodiscard]] std::string fault() const {
    if constexpr (requires { curve.fault(); }) return curve.fault();
    return {};
  }
};
template <class P, class Curve>
OnCurve(P, Curve) -> OnCurve<P, Curve>;

// Compiled once, in the library.
extern template struct BatchOf<ConstraintBatch, OnCurve<Particle<2>, Plane<2>>>;
extern template struct BatchOf<ConstraintBatch, OnCurve<Particle<2>, Sphere<2>>>;

}  // namespace dalembert
