#pragma once

#include <dalembert/core/autodiff/mistakes.h>
#include <dalembert/core/equations/batch.h>
#include <dalembert/core/equations/contact.h>
#include <dalembert/core/equations/sketch.h>

#include <cmath>
#include <concepts>
#include <optional>
#include <sstream>

namespace dalembert {

template <class E>
concept HasPoints = requires(const E& e) {
  e.points();
};

template <class E>
concept ActsOnPoints = HasPoints<E> &&(PointFacts<E>::inputs > 0) && PointFacts<E>::one_space;

/// Marks a constraint type as one on velocities: `static constexpr bool velocity_level = true;`.
template <class C>
concept VelocityLevel = requires {
  requires C::velocity_level;
};

/// Whether a constraint type holds a body together rather than being stated by a user, see BodyRod.
template <class C>
inline constexpr bool is_internal = [] {
  if constexpr (requires { C::internal; }) {
    return C::internal;
  } else {
    return false;
  }
}();

/// A compliant holonomic constraint: `double compliance`, see Compliant.
template <class C>
concept HasCompliance = requires(const C& c) {
  { c.compliance } -> std::convertible_to<double>;
};

/// A unilateral holonomic constraint: `Contact contact`, see Unilateral.
template <class C>
concept OneSided = requires(const C& c) {
  { c.contact } -> std::convertible_to<Contact>;
};

/// A no-slip constraint as far as friction can hold it: `Roughness roughness()`, see Coulomb.
template <class C>
concept Rough = requires(const C& c) {
  { c.roughness() } -> std::convertible_to<Roughness>;
};

namespace detail {

/// What an equation is tried with to see whether it can be called: a scalar it is evaluated with as well,
/// so that trying costs no compilation of its own.
template <class C>
using Probe = Dual<directions_for(PointFacts<C>::inputs)>;
template <class C>
using ProbePositions = typename PointFacts<C>::template Positions<Probe<C>>;
template <class C>
using ProbeMotion =
    decltype(std::tuple_cat(std::declval<ProbePositions<C>>(), std::declval<ProbePositions<C>>()));

/// Number of equations in what a constraint returns, and the k-th of them.
template <class T>
inline constexpr int rows_in = 1;
template <class T>
  requires Column<T>
inline constexpr int rows_in<T> = T::RowsAtCompileTime;

template <class C>
[[nodiscard]] Condition condition_of(const C& constraint) {
  if constexpr (OneSided<C>) {
    return {.contact = constraint.contact};
  } else if constexpr (Rough<C>) {
    return {.roughness = constraint.roughness()};
  } else {
    return {};
  }
}

template <class E>
[[nodiscard]] constexpr std::string_view kind_of(std::string_view otherwise) {
  if constexpr (requires { E::kind; }) {
    return E::kind;
  } else {
    return otherwise;
  }
}

template <class C>
[[nodiscard]] constexpr std::string_view singular_hint_of() {
  if constexpr (requires { C::singular; }) {
    return C::singular;
  } else {
    return "its equation does not determine a direction there";
  }
}

/// What the multiplier of a constraint is, in words: `static constexpr std::string_view meaning`.
template <class C>
[[nodiscard]] constexpr std::string_view meaning_of() {
  if constexpr (requires { C::meaning; }) {
    return C::meaning;
  } else if constexpr (VelocityLevel<C>) {
    return "force along the gradient of the equation by velocities, where that has unit length; > 0 pushes "
           "towards larger values of the equation";
  } else {
    return "force along the gradient of the equation, where that has unit length; > 0 pushes towards larger "
           "values of the equation";
  }
}

/// A value for an error message, with its leading digits whatever its size.
[[nodiscard]] inline std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

/// Whether the points of a factory can be called with at all. Each mistake is an error of its own, and
/// the first ends it.
template <class Points, class F>
[[nodiscard]] consteval bool written_for_any_scalar() {
  constexpr bool one_space = PointsOf<Points>::one_space;
  static_assert(one_space, "all points of a constraint or force must have the same dimension");
  static_assert(!one_space || PointsOf<Points>::inputs > 0,
                "at least one point of a constraint or force must be able to move");
  static_assert(!NamesItsArguments<F>,
                "write `auto` for the lambda's arguments, not double or Vec: it is called with numbers that "
                "carry derivatives");
  return one_space && PointsOf<Points>::inputs > 0 && !NamesItsArguments<F>;
}

}  // namespace detail

/// A holonomic constraint g(t, r_1, ..., r_k) = 0: a type with `points()` and an `operator()` that
/// takes their positions, for any scalar type, and returns g: a scalar, or a fixed-size vector of
/// equations. If the equation itself depends on time, `operator()` takes t in front; what is not in
/// the signature is not differentiated. (Driven points bring their own time along.)
template <class C>
concept HolonomicConstraint = ActsOnPoints<C> && !VelocityLevel<C> &&
                              (detail::applicable<C, detail::ProbePositions<C>> ||
                               detail::applicable_with_time<C, detail::Probe<C>, detail::ProbePositions<C>>);

/// A nonholonomic constraint a(t, r_1, ..., r_k, v_1, ..., v_k) = 0, linear (affine) in the
/// velocities: like a holonomic one, but marked `velocity_level` and called with the velocities
/// after the positions.
template <class C>
concept NonholonomicConstraint = ActsOnPoints<C> && VelocityLevel<C> &&
    (detail::applicable<C, detail::ProbeMotion<C>> ||
     detail::applicable_with_time<C, detail::Probe<C>, detail::ProbeMotion<C>>);

namespace detail {

template <class C>
inline constexpr bool takes_time = [] {
  if constexpr (VelocityLevel<C>) {
    return applicable_with_time<C, Probe<C>, ProbeMotion<C>>;
  } else {
    return applicable_with_time<C, Probe<C>, ProbePositions<C>>;
  }
}();

/// What a constraint's equation returns.
template <class C>
using Residual = Result<takes_time<C>, C, Probe<C>,
                        typename std::conditional_t<VelocityLevel<C>, std::type_identity<ProbeMotion<C>>,
                                                    std::type_identity<ProbePositions<C>>>::type>;

}  // namespace detail

/// Scalar equations of a constraint type; 0 of any other type.
template <class C>
inline constexpr int rows_of_constraint = 0;
/// The same of a constraint.
template <class C>
  requires(HolonomicConstraint<C> || NonholonomicConstraint<C>)
inline constexpr int rows_of_constraint<C> = detail::rows_in<detail::Residual<C>>;

/// Whether a constraint depends on time explicitly (rheonomic), by its equation or a driven point.
template <class C>
inline constexpr bool is_timed = detail::takes_time<C> || PointFacts<C>::driven;

namespace detail {

template <class C>
concept AnyConstraint = HolonomicConstraint<C> || NonholonomicConstraint<C>;

/// What Scene asks of an equation.
template <AnyConstraint C>
constexpr void require_equations() {
  static_assert(Equations<Residual<C>>,
                "a constraint's equation returns a number or a plain column of fixed size, vec(g_1, g_2): no "
                "row, matrix or vector of dynamic size, and of an Eigen expression its .eval()");
}

}  // namespace detail

}  // namespace dalembert
