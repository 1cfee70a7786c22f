#pragma once

#include <dalembert/constraints/geometry/axis.h>
#include <dalembert/constraints/geometry/surfaces.h>
#include <dalembert/core/equations/sketch.h>
#include <dalembert/core/vec.h>

#include <cmath>
#include <string>
#include <type_traits>

/// Curves and surfaces carried by a prescribed motion, for OnCurve and OnSurface: whatever g(r) they
/// are at rest, they are g(t, r) = g(r as seen from the moving frame). The multiplier keeps its
/// meaning; its force does work.
namespace dalembert {

namespace detail {
template <class Surface>
[[nodiscard]] std::string fault_of(const Surface& surface) {
  if constexpr (requires { surface.fault(); }) return surface.fault();
  return {};
}
}  // namespace detail

/// Shifted by path(t): `Translating{Sphere<2>{}, [](auto t) { return vec(0.1 * sin(t), 0.0); }}`.
template <class Surface, class Path>
struct Translating {
  static constexpr std::string_view kind = "Translating";
  Surface surface;  ///< at rest
  Path path;        ///< its translation, a function of time [length]

  auto operator()(const auto& t, const auto& r) const { return surface(r - path(t)); }
  [[nodiscard]] Sketch sketch() const {
    constexpr int D = std::remove_cvref_t<decltype(path(0.0))>::RowsAtCompileTime;
    return detail::carried(detail::figure_of<D>(surface), [path = path](double t) {
      const auto shift = detail::place_of<D>(path(t).template cast<double>());
      return Pose{.shift = {shift[0], shift[1], shift[2]}};
    });
  }
  [[nodiscard]] std::string fault() const { return detail::fault_of(surface); }
};
template <class Surface, class Path>
Translating(Surface, Path) -> Translating<Surface, Path>;

/// A plane curve turned by angle(t) about a centre, counter-clockwise.
template <class Curve, class Angle>
struct Rotating {
  static constexpr std::string_view kind = "Rotating";
  Curve curve;    ///< at rest
  Vec<2> centre;  ///< about which it turns [length]
  Angle angle;    ///< of time [rad]

  auto operator()(const auto& t, const auto& r) const {
    using std::cos;
    using std::sin;
    const auto phi = angle(t);
    const auto c = cos(phi);
    const auto s = sin(phi);
    const auto d = r - centre;
    return curve(centre + vec(c * d.x() + s * d.y(), c * d.y() - s * d.x()));
  }
  [[nodiscard]] Sketch sketch() const {
    return detail::carried(detail::figure_of<2>(curve), [centre = centre, angle = angle](double t) {
      return detail::turned_about({centre.x(), centre.y(), 0.0}, Vec<3>::UnitZ(),
                                  static_cast<double>(angle(t)));
    });
  }
  [[nodiscard]] std::string fault() const {
    return detail::first_fault({detail::place_fault(centre, "centre"), detail::fault_of(curve)});
  }
};
template <class Curve, class Angle>
Rotating(Curve, Vec<2>, Angle) -> Rotating<Curve, Angle>;

/// A surface turned by angle(t) about an axis, right-handed.
template <class Surface, class Angle>
struct RotatingAbout {
  static constexpr std::string_view kind = "RotatingAbout";
  Surface surface;  ///< at rest
  Axis axis;        ///< about which it turns
  Angle angle;      ///< of time [rad]

  auto operator()(const auto& t, const auto& r) const {
    using std::cos;
    using std::sin;
    const Vec<3> e = axis.direction.normalized();
    const auto phi = angle(t);
    const auto d = r - axis.point;
    // Rodrigues' rotation by -phi.
    const auto turned = cos(phi) * d - sin(phi) * e.cross(d) + (1.0 - cos(phi)) * e.dot(d) * e;
    return surface(axis.point + turned);
  }
  [[nodiscard]] Sketch sketch() const {
    return detail::carried(detail::figure_of<3>(surface), [axis = axis, angle = angle](double t) {
      return detail::turned_about(axis.point, axis.direction.normalized(), static_cast<double>(angle(t)));
    });
  }
  [[nodiscard]] std::string fault() const {
    return detail::first_fault({detail::place_fault(axis.point, "point"),
                                detail::direction_fault(axis.direction, "axis"), detail::fault_of(surface)});
  }
};
template <class Surface, class Angle>
RotatingAbout(Surface, Axis, Angle) -> RotatingAbout<Surface, Angle>;

}  // namespace dalembert
