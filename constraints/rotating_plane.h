#pragma once

#include <dalembert/constraints/geometry/axis.h>
#include <dalembert/core/equations/constraint.h>

namespace dalembert {

/// Keeps a point in a plane that contains an axis and turns about it by a prescribed angle: a hoop
/// turning about its diameter (notes, mex39), the arms of a governor (mex23).
///
///   n(t) = the direction of growing angle, a right angle ahead of the plane
///   g = n(t) . (r - axis.point)      [length]
///
/// lambda is the force that carries the point round, positive ahead.
template <Point P, class Angle>
struct RotatingPlane {
  static_assert(P::dimension == 3,
                "RotatingPlane is spatial; in the plane a turning line is a PointLineDistance");
  static constexpr std::string_view kind = "RotatingPlane";
  static constexpr std::string_view meaning = "force that carries the point round; > 0 ahead";
  P point;
  Axis axis;    ///< in the plane
  Angle angle;  ///< of time [rad]: `[](auto t) { return 2.0 * t; }`

  auto points() const { return std::tie(point); }
  [[nodiscard]] Sketch sketch() const {
    Sketch drawn{"axis"};
    detail::append<3>(drawn.sizes, axis.point);
    detail::append<3>(drawn.sizes, axis.direction);
    return drawn;
  }
  auto operator()(const auto& t, const auto& r) const {
    using std::cos;
    using std::sin;
    const Vec<3> e = axis.direction.normalized();
    const Vec<3> ahead = e.cross(axis.zero).normalized();
    const Vec<3> zero = ahead.cross(e);
    const auto phi = angle(t);
    const auto d = r - axis.point;
    return cos(phi) * ahead.dot(d) - sin(phi) * zero.dot(d);
  }
  [[nodiscard]] std::string fault() const {
    const bool good = axis.point.allFinite() && axis.direction.cross(axis.zero).norm() > 0.0;
    return good ? "" : "axis: direction and zero must be finite and not parallel";
  }
};
template <class P, class Angle>
RotatingPlane(P, Axis, Angle) -> RotatingPlane<P, Angle>;

}  // namespace dalembert
