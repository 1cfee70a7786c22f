#pragma once

#include <dalembert/core/equations/constraint.h>

#include <string>
#include <utility>

namespace dalembert {

/// A holonomic constraint of one equation that holds one way only, as returned by `unilateral`:
///
///   g >= 0,   lambda >= 0,   g lambda = 0        (Allowed::negative: g <= 0, lambda <= 0)
///
/// While it is closed, g = 0, it exerts a force like any other; where that would change its sign it opens.
/// Where g returns to 0 there is an impact: its impulse ends the speed of approach U-, or reverses it, U+ =
/// -restitution U-. Several at once obey Moreau's law, U+ >= -restitution U-, with an impulse only where
/// equality holds: of equal balls in contact in a row all but the first go off together. Impacts that
/// accumulate end in rest, at their limit.
///
/// A run lists openings, impacts and rests (Trajectory::events), with the states before and after and the
/// impulses of all constraints. At the start a contact is closed if its gap is below 1e-8 of the scene's
/// length. Forces that read a multiplier cannot read that of a one-sided constraint; scenes with one have no
/// equilibria and no small motions here.
///
/// Source: J. J. Moreau, Unilateral contact and dry friction in finite freedom dynamics (1988).
template <class Bilateral>
struct Unilateral {
  static constexpr std::string_view kind = detail::kind_of<Bilateral>("Unilateral");
  static constexpr std::string_view singular = detail::singular_hint_of<Bilateral>();
  static constexpr std::string_view meaning = detail::meaning_of<Bilateral>();
  Bilateral bilateral;
  Contact contact;  ///< its sign and its restitution

  decltype(auto) points() const { return bilateral.points(); }
  [[nodiscard]] Sketch sketch() const { return detail::sketch_of(bilateral); }
  auto operator()(const auto&... a) const requires requires { bilateral(a...); }
  { return bilateral(a...); }

  [[nodiscard]] std::string fault() const {
    if (!(contact.restitution >= 0.0 && contact.restitution <= 1.0))
      return "restitution = " + detail::text(contact.restitution) + ", must be 0 to 1";
    if constexpr (requires { bilateral.fault(); }) return bilateral.fault();
    return {};
  }
};

/// Makes a constraint one-sided:
///
///   auto floor = scene.add(unilateral(OnCurve{ball, Plane<2>{}}, {.restitution = 0.8}));
///   auto string = scene.add(unilateral(Distance{pivot, bob, 1.0}, {.allowed = Allowed::negative}));
///
/// Scene::add throws InvalidScene unless the restitution is 0 to 1.
template <class C>
[[nodiscard]] Unilateral<C> unilateral(C bilateral, Contact contact = {}) {
  static_assert(HolonomicConstraint<C> && rows_of_constraint<C> == 1,
                "unilateral takes a holonomic constraint of one equation");
  static_assert(!HasCompliance<C> && !OneSided<C>, "a one-sided constraint is rigid, and one-sided once");
  return {std::move(bilateral), contact};
}

}  // namespace dalembert
