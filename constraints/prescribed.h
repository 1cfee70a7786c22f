#pragma once

#include <dalembert/core/equations/constraint.h>

namespace dalembert {

/// A point or a rotor follows a prescribed function of time, and the force or torque that this takes
/// is its multiplier:
///
///   g = r - motion(t)      [length], one equation per dimension; an angle for a Rotor
///
///   scene.add(Prescribed{crank, [](auto t) { return vec(2.0 * t); }});
///
/// A point that need not be a particle is better stated as a Driven point: it adds no unknowns.
template <Point P, class Motion>
struct Prescribed {
  static constexpr std::string_view kind = "Prescribed";
  static constexpr std::string_view meaning = "force, of a rotor torque, that drives it, by components";
  P point;
  Motion motion;  ///< a function of time

  auto points() const { return std::tie(point); }
  [[nodiscard]] Sketch sketch() const { return {"none"}; }
  auto operator()(const auto& t, const auto& r) const { return r - motion(t); }
};
template <class P, class Motion>
Prescribed(P, Motion) -> Prescribed<P, Motion>;

}  // namespace dalembert
