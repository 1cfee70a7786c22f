#pragma once

#include <dalembert/core/equations/constraint.h>

namespace dalembert::detail {

/// A constraint itself is what is called.
template <class C>
using ConstraintEquation =
    Equation<C, const C&, takes_time<C>, VelocityLevel<C>, is_timed<C>, rows_of_constraint<C>>;

template <class C>
[[nodiscard]] double compliance_of(const void* constraint) {
  return static_cast<const C*>(constraint)->compliance;
}

template <class C>
[[nodiscard]] constexpr ConstraintType make_constraint_type() {
  ConstraintType its{.equation = equation_type_of<ConstraintEquation<C>>(singular_hint_of<C>()),
                     .kind = kind_of<C>(VelocityLevel<C> ? "Nonholonomic" : "Holonomic"),
                     .internal = is_internal<C>,
                     .timed = is_timed<C>,
                     .conditional = OneSided<C> || Rough<C>,
                     .compliance = nullptr};
  if constexpr (HasCompliance<C>) its.compliance = &compliance_of<C>;
  return its;
}

template <AnyConstraint C>
inline constexpr ConstraintType constraint_type = make_constraint_type<C>();

}  // namespace dalembert::detail
