#pragma once

#include <dalembert/core/equations/constraint.h>

namespace dalembert {

/// A point moves only along the direction from one point to another, forwards or backwards, in the
/// plane: a knife edge or a sleigh's blade along two points of its body
/// (`KnifeEdge{blade, rear, front}`). For a pursuer use Pursuit.
///
///   e = (r_to - r_from)/|r_to - r_from|,   n = e turned left
///   a = n . v      [speed]
///
/// lambda is the sideways force on the point, towards n. It does no work.
template <Point P, Point From, Point To>
struct KnifeEdge {
  static_assert(P::dimension == 2, "KnifeEdge is planar");
  static constexpr std::string_view kind = "KnifeEdge";
  static constexpr std::string_view meaning = "sideways force on the point; > 0 to the left";
  static constexpr std::string_view singular = "the two points of its direction coincide";
  static constexpr bool velocity_level = true;
  P point;
  From from;  ///< the blade's rear
  To to;      ///< its front: the direction is from the one to the other

  auto points() const { return std::tie(point, from, to); }
  auto operator()(const auto& /*r*/, const auto& r_from, const auto& r_to, const auto& v,
                  const auto& /*v_from*/, const auto& /*v_to*/) const {
    const auto e = (r_to - r_from).normalized();
    return e.x() * v.y() - e.y() * v.x();
  }
};
template <class P, class From, class To>
KnifeEdge(P, From, To) -> KnifeEdge<P, From, To>;

}  // namespace dalembert
