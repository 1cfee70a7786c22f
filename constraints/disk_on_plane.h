#pragma once

#include <dalembert/constraints/geometry/surfaces.h>
#include <dalembert/core/equations/constraint.h>

#include <string>

/// A thin disk whose rim touches a plane and rolls on it, leaning as it likes (notes, mln37 beyond
/// the upright disk): DiskContact keeps it on the plane, DiskRolling from slipping. The disk is
/// given by its centre and two points of the body, `a` and `b`, at right angles as seen from the
/// centre, in the plane of the disk: points of a Lamina or of a RigidBody.
///
///   n = axis of the disk = (a - c) x (b - c) made a unit vector,   N = unit normal of the plane
///   u = N - (N . n) n      up the disk, |u| = sine of the angle between the two axes
///   contact: c - radius u/|u|
///
/// Singular when the disk lies flat.
namespace dalembert {

namespace detail {

/// What both constraints need of a disk with its centre at c, on a plane of unit normal N.
template <class V>
struct LeaningDisk {
  using S = typename V::Scalar;
  V arm_a, arm_b;  ///< from the centre
  V n;             ///< axis
  V normal;        ///< N
  V u;
  S sine;  ///< |u|

  LeaningDisk(const Vec<3>& N, const V& c, const V& a, const V& b);
  /// DiskRolling's equation.
  [[nodiscard]] VecOf<S, 2> slip(double radius, const V& v, const V& v_a, const V& v_b) const;
};

template <class V>
LeaningDisk<V>::LeaningDisk(const Vec<3>& N, const V& c, const V& a, const V& b)
    : arm_a(a - c), arm_b(b - c), n(arm_a.cross(arm_b).normalized()), normal(N.cast<S>()) {
  u = normal - normal.dot(n) * n;
  sine = u.norm();
}

template <class V>
VecOf<typename V::Scalar, 2> LeaningDisk<V>::slip(double radius, const V& v, const V& v_a,
                                                  const V& v_b) const {
  const V up = u / sine, heading = normal.cross(n) / sine, across = heading.cross(normal);
  const V d = -radius * up;
  const S share_a = d.dot(arm_a) / arm_a.squaredNorm(), share_b = d.dot(arm_b) / arm_b.squaredNorm();
  const V v_contact = v + share_a * (v_a - v) + share_b * (v_b - v);
  return VecOf<S, 2>(heading.dot(v_contact), across.dot(v_contact));
}

/// Compiled in the library for the scalars of 9 inputs: three points in space, of whatever body.
extern template struct LeaningDisk<VecOf<Dual<9>, 3>>;
extern template struct LeaningDisk<VecOf<Jet<9>, 3>>;
extern template struct LeaningDisk<VecOf<HyperDual<9>, 3>>;

[[nodiscard]] inline std::string disk_fault(double radius, const Plane<3>& plane) {
  const std::string fault = positive_fault(radius, "radius");
  return fault.empty() ? plane.fault() : fault;
}

[[nodiscard]] inline Sketch sketch_of_disk(double radius, const Plane<3>& plane) {
  Sketch drawn{"disk", {radius}};
  append<3>(drawn.sizes, plane.point);
  append<3>(drawn.sizes, plane.normal);
  return drawn;
}

}  // namespace detail

/// The rim touches the plane, from the side its normal points to.
///
///   g = N . (c - plane.point) - radius |u|      [length]
///
/// lambda is the normal force, > 0 away from the plane.
template <Point C, Point A, Point B>
struct DiskContact {
  static_assert(C::dimension == 3, "DiskContact is spatial; in the plane use PointLineDistance");
  static constexpr std::string_view kind = "DiskContact";
  static constexpr std::string_view meaning = "normal force on the disk; > 0 away from the plane";
  static constexpr std::string_view singular = "the disk lies flat";
  C centre;
  A a;
  B b;
  double radius;        ///< [length], finite and > 0
  Plane<3> plane = {};  ///< that it touches

  auto points() const { return std::tie(centre, a, b); }
  [[nodiscard]] Sketch sketch() const { return detail::sketch_of_disk(radius, plane); }
  auto operator()(const auto& c, const auto& r_a, const auto& r_b) const {
    using V = std::remove_cvref_t<decltype(c)>;
    return plane(c) - radius * detail::LeaningDisk<V>(plane.normal.normalized(), c, r_a, r_b).sine;
  }
  [[nodiscard]] std::string fault() const { return detail::disk_fault(radius, plane); }
};
template <class C, class A, class B>
DiskContact(C, A, B, double) -> DiskContact<C, A, B>;
template <class C, class A, class B>
DiskContact(C, A, B, double, Plane<3>) -> DiskContact<C, A, B>;

/// The point of the disk at the contact is at rest along the plane. With d the arm from the centre to
/// the contact, its velocity follows from those of three points of the body,
///
///   v_contact = v_c + d . (a-c)/|a-c|^2 (v_a - v_c) + d . (b-c)/|b-c|^2 (v_b - v_c)
///   a_1 = e . v_contact,   a_2 = (e x N) . v_contact      e = N x n/|N x n|      [speed]
///
/// (across the plane it is at rest by DiskContact). lambda_1 is the friction along the heading e,
/// lambda_2 that across, towards the side that the axis n leans to.
template <Point C, Point A, Point B>
struct DiskRolling {
  static_assert(C::dimension == 3, "DiskRolling is spatial; in the plane use Rolling");
  static constexpr std::string_view kind = "DiskRolling";
  static constexpr std::string_view meaning =
      "friction on the disk along its heading, and across it to the side its axis leans to";
  static constexpr std::string_view singular = "the disk lies flat";
  static constexpr bool velocity_level = true;
  C centre;
  A a;
  B b;
  double radius;        ///< [length], finite and > 0
  Plane<3> plane = {};  ///< that it rolls on

  auto points() const { return std::tie(centre, a, b); }
  [[nodiscard]] Sketch sketch() const { return detail::sketch_of_disk(radius, plane); }
  auto operator()(const auto& c, const auto& r_a, const auto& r_b, const auto& v, const auto& v_a,
                  const auto& v_b) const {
    using V = std::remove_cvref_t<decltype(c)>;
    return detail::LeaningDisk<V>(plane.normal.normalized(), c, r_a, r_b).slip(radius, v, v_a, v_b);
  }
  [[nodiscard]] std::string fault() const { return detail::disk_fault(radius, plane); }
};
template <class C, class A, class B>
DiskRolling(C, A, B, double) -> DiskRolling<C, A, B>;
template <class C, class A, class B>
DiskRolling(C, A, B, double, Plane<3>) -> DiskRolling<C, A, B>;

}  // namespace dalembert
