#pragma once

#include <dalembert/core/equations/constraint.h>

namespace dalembert {

/// A holonomic constraint that yields, as returned by `compliant`: a stiff spring.
///
///   g + C lambda = 0,   lambda = -g / C = -k g         [C: length / force, k = 1/C]
///
/// The multiplier is the spring's force, with the sign of the rigid constraint's, and
/// `constraint_force` reads it like any other. C = 0 is the rigid constraint itself. The sample's
/// energy holds the spring's own, C lambda^2 / 2.
///
/// The same spring written as a force, F = -k g dg/dr, is right as long as its vibration is slow
/// enough to be followed. A stiff one is not: round-off in the positions times k becomes force. Here
/// lambda is an unknown of the implicit stepper, the equations stay regular down to C = 0, and
/// vibrations too small and fast to matter at the tolerance are stepped over.
///
/// At impacts and changes it acts as a spring: it transmits no impulse and holds no contact closed, and where
/// it is imposed its g may have any value.
template <class Rigid>
struct Compliant {
  static constexpr std::string_view kind = detail::kind_of<Rigid>("Holonomic");
  static constexpr std::string_view singular = detail::singular_hint_of<Rigid>();
  static constexpr std::string_view meaning = detail::meaning_of<Rigid>();
  Rigid rigid;
  double compliance;  ///< C, finite and >= 0

  decltype(auto) points() const { return rigid.points(); }
  [[nodiscard]] Sketch sketch() const { return detail::sketch_of(rigid); }
  auto operator()(const auto&... a) const requires requires { rigid(a...); }
  { return rigid(a...); }

  [[nodiscard]] std::string fault() const {
    if constexpr (requires { rigid.fault(); }) return rigid.fault();
    return {};
  }
};

/// Makes any holonomic constraint a spring of stiffness 1 / compliance:
///
///   auto spring = scene.add(compliant(Distance{pivot, bob, 1.0}, 1.0 / stiffness));
///
/// The stiffness is in newtons per metre where the gradient of g has unit length: that of the library's own
/// constraints has, but for those that are stated by a function of yours.
template <class C>
[[nodiscard]] Compliant<C> compliant(C rigid, double compliance) {
  static_assert(HolonomicConstraint<C>,
                "compliant takes a holonomic constraint, whose points have the same dimension");
  static_assert(!HasCompliance<C> && !OneSided<C>, "a compliant constraint is two-sided, and compliant once");
  return {std::move(rigid), compliance};
}

}  // namespace dalembert
