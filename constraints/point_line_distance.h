#pragma once

#include <dalembert/core/equations/constraint.h>

namespace dalembert {

/// Keeps a point at a fixed signed distance from the straight line through two points, in the plane:
/// a bead on a straight wire (offset 0), the centre of a disk on a track (offset its radius). The
/// line may be fixed, driven or carried by a body.
///
///   e = (r_b - r_a)/|r_b - r_a|,   n = e turned left by a right angle
///   g = n . (r - r_a) - offset      [length]
///
/// The gradient with respect to r is n: lambda > 0 pushes the point away to the left of the line,
/// and the line's two points get the opposite force between them. Singular where a meets b.
template <Point P, Point A, Point B>
struct PointLineDistance {
  static_assert(P::dimension == 2, "PointLineDistance is planar; in space use OnSurface with a Plane");
  static constexpr std::string_view kind = "PointLineDistance";
  static constexpr std::string_view meaning = "force on the point across the line; > 0 pushes to its left";
  static constexpr std::string_view singular = "the two points of its line coincide";
  P point;
  A a;
  B b;
  double offset = 0.0;  ///< [length], finite

  auto points() const { return std::tie(point, a, b); }
  [[nodiscard]] Sketch sketch() const { return {"track"}; }
  auto operator()(const auto& r, const auto& r_a, const auto& r_b) const {
    const auto e = (r_b - r_a).normalized();
    const auto d = r - r_a;
    return e.x() * d.y() - e.y() * d.x() - offset;
  }
  [[nodiscard]] std::string fault() const {
    return std::isfinite(offset) ? "" : "offset = " + detail::text(offset) + ", must be finite";
  }
};
template <class P, class A, class B>
PointLineDistance(P, A, B, double) -> PointLineDistance<P, A, B>;

}  // namespace dalembert
