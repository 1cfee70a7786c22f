#pragma once

#include <dalembert/constraints/geometry/surfaces.h>
#include <dalembert/core/equations/constraint.h>

#include <tuple>

namespace dalembert {

namespace detail {

/// The directions along a surface with normal n: in the plane n turned right, in space two at right angles to
/// it and to each other (T. Duff et al., J. Comp. Graphics Tech. 6 (2017) 1).
template <class T>
[[nodiscard]] auto tangents(const VecOf<T, 2>& n) {
  return std::tuple{vec(n.y(), -n.x())};
}
template <class T>
[[nodiscard]] auto tangents(const VecOf<T, 3>& n) {
  double height = 0.0;  // without its derivatives: on which side of the equator is no switch
  if constexpr (requires { n.z().value; }) {
    height = n.z().value;
  } else {
    height = n.z();
  }
  const double side = height < 0.0 ? -1.0 : 1.0;
  const T a = -1.0 / (side + n.z()), b = n.x() * n.y() * a;
  return std::tuple{vec(1.0 + side * n.x() * n.x() * a, side * b, -side * n.x()),
                    vec(b, side + n.y() * n.y() * a, -n.y())};
}

}  // namespace detail

/// The velocity of a particle along a surface (in the plane a line or circle), which may itself move along
/// with a constant velocity, as a belt does: one number in the plane, two in space. Stated by itself
/// it forbids slip; in `coulomb` it does so up to the limit of friction.
///
///   a = e_k . (v - belt),   e_k along the surface;  in the plane e is its normal turned right
///
/// Plane, Sphere, Cylinder, Cone, or a type with `normal_at(r)`, of length 1. Along a surface that turns or
/// is driven state the slip velocity as one's own equation, `nonholonomic`.
template <Point P, class Surface>
struct Slip {
  static_assert(
      requires(const Surface& its, const Vec<P::dimension>& r) { its.normal_at(r); },
      "Slip takes a surface with normal_at(r), moved by `belt` alone; for others write nonholonomic(...)");
  static constexpr std::string_view kind = "Slip";
  static constexpr std::string_view meaning = "force on the particle along the surface";
  static constexpr std::string_view singular = "the surface has no normal there";
  static constexpr bool velocity_level = true;
  P point;
  Surface surface;                                     ///< that gives the directions
  Vec<P::dimension> belt = Vec<P::dimension>::Zero();  ///< [speed]

  auto points() const { return std::tie(point); }
  [[nodiscard]] Sketch sketch() const { return {"none"}; }
  auto operator()(const auto& r, const auto& v) const {
    using T = typename std::remove_cvref_t<decltype(v)>::Scalar;
    const VecOf<T, P::dimension> n = surface.normal_at(r), relative = v - belt;
    return std::apply(
        [&](const auto&... e) {
          if constexpr (sizeof...(e) == 1) {
            return (e.dot(relative), ...);
          } else {
            return vec(e.dot(relative)...);
          }
        },
        detail::tangents<T>(n));
  }
  [[nodiscard]] std::string fault() const {
    if (!belt.allFinite()) return "belt must be finite";
    if constexpr (requires { surface.fault(); }) return surface.fault();
    return {};
  }
};
template <class P, class Surface>
Slip(P, Surface) -> Slip<P, Surface>;
template <class P, class Surface>
Slip(P, Surface, Vec<P::dimension>) -> Slip<P, Surface>;

}  // namespace dalembert
