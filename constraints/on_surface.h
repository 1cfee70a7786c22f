#pragma once

#include <dalembert/constraints/geometry/surfaces.h>
#include <dalembert/core/equations/constraint.h>

namespace dalembert {

namespace detail {
/// The equation of a surface, prepared if it can be.
template <class Surface>
[[nodiscard]] auto prepared(const Surface& surface) {
  if constexpr (requires { surface.prepared(); }) {
    return surface.prepared();
  } else {
    return surface;
  }
}
}  // namespace detail

/// Keeps a point on a surface g(r) = 0 in space, given as Plane, Sphere, Cylinder, Cone or any
/// function of position (with time in front if the surface moves).
///
///   Z = lambda grad g
///
/// The library's surfaces are signed distances, so lambda is the normal force, pushing towards
/// g > 0. For a user's own function lambda is the normal force divided by |grad g|.
template <Point P, class Surface>
struct OnSurface {
  static_assert(detail::written_for_any_scalar<std::tuple<P>, Surface>());
  static constexpr std::string_view kind = "OnSurface";
  static constexpr std::string_view meaning = "normal force on the point; > 0 pushes towards g > 0";
  static constexpr std::string_view singular =
      "the surface has no normal there (an apex, a centre or an axis)";
  P point;
  Surface surface;  ///< an equation g([t,] r)
  /// The same, prepared.
  decltype(detail::prepared(std::declval<const Surface&>())) equation = detail::prepared(surface);

  auto points() const { return std::tie(point); }
  [[nodiscard]] Sketch sketch() const { return detail::figure_of<3>(surface); }
  auto operator()(const auto&... a) const requires requires { equation(a...); }
  { return equation(a...); }
  [[nodiscard]] std::string fault() const {
    if constexpr (requires { surface.fault(); }) return surface.fault();
    return {};
  }
};
template <class P, class Surface>
OnSurface(P, Surface) -> OnSurface<P, Surface>;

// Compiled once, in the library.
extern template struct BatchOf<ConstraintBatch, OnSurface<Particle<3>, Plane<3>>>;
extern template struct BatchOf<ConstraintBatch, OnSurface<Particle<3>, Sphere<3>>>;
extern template struct BatchOf<ConstraintBatch, OnSurface<Particle<3>, Cylinder>>;
extern template struct BatchOf<ConstraintBatch, OnSurface<Particle<3>, Cone>>;

}  // namespace dalembert
