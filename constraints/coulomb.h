#pragma once

#include <dalembert/core/equations/constraint.h>
#include <dalembert/core/points/handles.h>

#include <cmath>
#include <string>
#include <utility>

namespace dalembert {

/// Coulomb friction on a constraint, as returned by `coulomb`. With the slip velocities u, one or two, the
/// friction sigma, which is the multiplier of u = 0, and the normal force lambda of that constraint
///
///   sticks:  u = 0,   |sigma| <= mu_static |lambda|
///   slides:  sigma = -mu |lambda| u/|u|
///
/// whatever sign lambda has. In space two slip velocities along directions at right angles give a circular
/// cone. A multiplier of this constraint is sigma in both cases, and its force W^T sigma, W = du/dv. Which
/// case holds the run finds, and lists when it changes (EventKind::sticks, EventKind::slides).
///
/// Where no motion satisfies the law (Painleve) the run stops and says so, and where two do as something
/// begins to slide, with normal forces of either sign. What slides on keeps its motion where a second one
/// comes up beside it: lambda changes as time goes on, it does not jump. The run also stops at an impact,
/// whose frictional impulse the law does not determine. Of several that stick on the same slip the motion
/// does not determine the shares (`is_unique`): they are those whose largest part of its bound is least, and
/// together they slide; with mu_static > mu, where the shares would decide which does, the run stops. A slip
/// that other constraints prescribe slides. Equilibria and small motions are not for it.
template <class Slip>
struct Coulomb {
  static constexpr std::string_view kind = "Coulomb";
  static constexpr std::string_view singular = detail::singular_hint_of<Slip>();
  static constexpr std::string_view meaning =
      "friction, > 0 as the slip velocity is measured; sticking and sliding alike";
  static constexpr bool velocity_level = true;
  Slip slip;
  Constraint<1> pressing;  ///< gives the normal force
  double mu, mu_static;    ///< of sliding and of sticking friction, 0 <= mu <= mu_static

  decltype(auto) points() const { return slip.points(); }
  [[nodiscard]] Sketch sketch() const { return detail::sketch_of(slip); }
  auto operator()(const auto&... a) const requires requires { slip(a...); }
  { return slip(a...); }

  /// Gives the normal force.
  [[nodiscard]] const Constraint<1>& constraint() const { return pressing; }
  /// Its law, as a System reads it.
  [[nodiscard]] Roughness roughness() const { return {pressing.index, mu, mu_static}; }
  [[nodiscard]] std::string fault() const {
    if (!(std::isfinite(mu) && mu >= 0.0)) return "mu = " + detail::text(mu) + ", must be finite and >= 0";
    if (!(std::isfinite(mu_static) && mu_static >= mu))
      return "mu_static = " + detail::text(mu_static) +
             ", must be finite and at least mu = " + detail::text(mu);
    if constexpr (requires { slip.fault(); }) return slip.fault();
    return {};
  }
};

/// Makes a constraint rough. The slip is stated like any constraint on velocities, a block on a belt that
/// moves at 1
///
///   auto belt = scene.add(OnCurve{block, Plane<2>{}});
///   auto rough = scene.add(coulomb(belt, Slip{block, Plane<2>{}, {1.0, 0.0}}, 0.3, 0.4));
///
/// or as one's own equation, `nonholonomic(points(block), [](auto r, auto v) { return v.x() - 1.0; })`; a
/// wheel that may skid is coulomb(track, Rolling{...}, mu). The slip velocities must be those of the points
/// in contact, and lambda the force there: for a constraint of the user's own whose gradient is not of unit
/// length divide mu by that length.
///
/// Scene::add throws InvalidScene unless 0 <= mu <= mu_static, and InvalidArgument if the constraint that
/// gives the normal force is not one of the scene's.
template <class Slip>
[[nodiscard]] Coulomb<Slip> coulomb(Constraint<1> pressing, Slip slip, double mu, double mu_static) {
  static_assert(NonholonomicConstraint<Slip>,
                "coulomb takes the constraint that presses and one on velocities: that nothing slides");
  static_assert(rows_of_constraint<Slip> <= 2, "there are one or two slip velocities, in space two");
  return {std::move(slip), pressing, mu, mu_static};
}
/// The same with one coefficient.
template <class Slip>
[[nodiscard]] Coulomb<Slip> coulomb(Constraint<1> pressing, Slip slip, double mu) {
  return coulomb(pressing, std::move(slip), mu, mu);
}

}  // namespace dalembert
