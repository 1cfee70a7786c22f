#pragma once

#include <dalembert/core/equations/constraint.h>

#include <cmath>
#include <initializer_list>
#include <string>
#include <type_traits>

/// Surfaces for OnSurface, each as its signed distance: a function of position whose gradient has
/// unit length on the surface, so that the multiplier is the normal force, positive towards g > 0.
/// Their equation is `prepared()`, with all that does not depend on r worked out once; `normal_at(r)` is
/// its gradient.
namespace dalembert {

namespace detail {

/// v/|v|. Not inline, so that it is compiled once and not in every file.
[[nodiscard]] Vec<3> unit_vector(const Vec<3>& v);

template <int D>
[[nodiscard]] std::string direction_fault(const Vec<D>& direction, const char* name);
template <int D>
[[nodiscard]] std::string place_fault(const Vec<D>& place, const char* name);
[[nodiscard]] std::string positive_fault(double value, const char* name);
/// The first of several faults that is one.
[[nodiscard]] std::string first_fault(std::initializer_list<std::string> faults);

}  // namespace detail

/// The plane (in two dimensions the line) through `point`: g = n . (r - point), n = normal/|normal|.
/// g > 0 on the side that the normal points to.
template <int D>
struct Plane {
  static constexpr std::string_view kind = "Plane";
  Vec<D> point = Vec<D>::Zero();        ///< any point of it [length]
  Vec<D> normal = Vec<D>::Unit(D - 1);  ///< towards g > 0; of any length but 0

  [[nodiscard]] auto prepared() const {
    return [point = point, n = Vec<D>(normal.normalized())](const auto& r) { return n.dot(r - point); };
  }
  auto operator()(const auto& r) const { return prepared()(r); }
  [[nodiscard]] Sketch sketch() const {
    Sketch drawn{"plane"};
    detail::append<D>(drawn.sizes, point);
    detail::append<D>(drawn.sizes, normal);
    return drawn;
  }
  [[nodiscard]] auto normal_at(const auto& r) const {
    using T = typename std::remove_cvref_t<decltype(r)>::Scalar;
    return VecOf<T, D>(normal.normalized().template cast<T>());
  }
  [[nodiscard]] std::string fault() const {
    return detail::first_fault(
        {detail::place_fault(point, "point"), detail::direction_fault(normal, "normal")});
  }
};

/// The sphere (in two dimensions the circle): g = |r - centre| - radius, positive outside.
template <int D>
struct Sphere {
  static constexpr std::string_view kind = "Sphere";
  Vec<D> centre = Vec<D>::Zero();  ///< [length]
  double radius = 1.0;             ///< > 0 [length]

  auto operator()(const auto& r) const { return (r - centre).norm() - radius; }
  [[nodiscard]] Sketch sketch() const {
    Sketch drawn{"sphere"};
    detail::append<D>(drawn.sizes, centre);
    drawn.sizes.push_back(radius);
    return drawn;
  }
  [[nodiscard]] auto normal_at(const auto& r) const { return (r - centre).normalized(); }
  [[nodiscard]] std::string fault() const {
    return detail::first_fault(
        {detail::place_fault(centre, "centre"), detail::positive_fault(radius, "radius")});
  }
};

/// The circular cylinder about an axis: g = (distance from the axis) - radius, positive outside.
struct Cylinder {
  static constexpr std::string_view kind = "Cylinder";
  Vec<3> point = Vec<3>::Zero();  ///< any point of the axis
  Vec<3> axis = Vec<3>::UnitZ();  ///< its direction, of any length but 0
  double radius = 1.0;            ///< > 0 [length]

  [[nodiscard]] auto prepared() const {
    return [point = point, e = detail::unit_vector(axis), radius = radius](const auto& r) {
      return e.cross(r - point).norm() - radius;
    };
  }
  auto operator()(const auto& r) const { return prepared()(r); }
  [[nodiscard]] Sketch sketch() const {
    Sketch drawn{"cylinder"};
    detail::append<3>(drawn.sizes, point);
    detail::append<3>(drawn.sizes, axis);
    drawn.sizes.push_back(radius);
    return drawn;
  }
  [[nodiscard]] auto normal_at(const auto& r) const {
    const Vec<3> e = detail::unit_vector(axis);
    const auto d = r - point;
    return (d - e * e.dot(d)).normalized();
  }
  [[nodiscard]] std::string fault() const {
    return detail::first_fault({detail::place_fault(point, "point"), detail::direction_fault(axis, "axis"),
                                detail::positive_fault(radius, "radius")});
  }
};

/// The circular cone that opens from its apex along the axis (notes, mex133). With s the height
/// above the apex along the axis and rho the distance from the axis,
///
///   g = s sin(half_angle) - rho cos(half_angle),
///
/// positive inside: a multiplier > 0 pushes a particle that slides inside away from the wall.
/// Singular at the apex and on the axis.
struct Cone {
  static constexpr std::string_view kind = "Cone";
  Vec<3> apex = Vec<3>::Zero();            ///< [length]
  Vec<3> axis = Vec<3>::UnitZ();           ///< from the apex into the cone, of any length but 0
  double half_angle = 0.7853981633974483;  ///< [rad], between 0 and pi/2

  [[nodiscard]] auto prepared() const {
    return [apex = apex, e = detail::unit_vector(axis), sine = std::sin(half_angle),
            cosine = std::cos(half_angle)](const auto& r) {
      const auto d = r - apex;
      return e.dot(d) * sine - e.cross(d).norm() * cosine;
    };
  }
  auto operator()(const auto& r) const { return prepared()(r); }
  [[nodiscard]] Sketch sketch() const {
    Sketch drawn{"cone"};
    detail::append<3>(drawn.sizes, apex);
    detail::append<3>(drawn.sizes, axis);
    drawn.sizes.push_back(half_angle);
    return drawn;
  }
  [[nodiscard]] auto normal_at(const auto& r) const {
    const Vec<3> e = detail::unit_vector(axis);
    const auto d = r - apex;
    const auto out = (d - e * e.dot(d)).normalized();
    return e * std::sin(half_angle) - out * std::cos(half_angle);
  }
  [[nodiscard]] std::string fault() const {
    if (!(half_angle > 0.0 && half_angle < 1.5707963267948966)) {
      return "half_angle = " + detail::text(half_angle) + " rad, must lie between 0 and pi/2";
    }
    return detail::first_fault({detail::place_fault(apex, "apex"), detail::direction_fault(axis, "axis")});
  }
};

}  // namespace dalembert
