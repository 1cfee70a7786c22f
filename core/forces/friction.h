#pragma once

#include <dalembert/core/forces/force.h>
#include <dalembert/core/points/handles.h>

namespace dalembert {

namespace detail {

/// Makes `friction` of an element callable like a function, without hiding its arity.
template <class E>
struct FrictionOf {
  const E& element;
  auto operator()(const auto&... a) const requires requires { element.friction(a...); }
  { return element.friction(a...); }
};

template <class Handle>
inline constexpr int rows_of_handle = 0;
template <int Rows>
inline constexpr int rows_of_handle<Constraint<Rows>> = Rows;

/// The multiplier of `Rows` equations as scalars of type S: a number or a vector.
template <class S, int Rows>
using MultiplierOf = std::conditional_t<Rows == 1, S, VecOf<S, Rows>>;

}  // namespace detail

/// An element that reads the multiplier of a constraint: `constraint()` is that one's handle.
template <class E>
concept ReadsMultiplier = requires(const E& e) {
  { e.constraint().index } -> std::convertible_to<int>;
};

/// Equations of the constraint that an element reads.
template <ReadsMultiplier E>
inline constexpr int rows_read =
    detail::rows_of_handle<std::remove_cvref_t<decltype(std::declval<const E&>().constraint())>>;

namespace detail {
template <class E>
using ProbeFriction = decltype(std::tuple_cat(
    std::declval<std::tuple<MultiplierOf<Probe<E>, rows_read<E>>>>(), std::declval<ProbeMotion<E>>()));
}  // namespace detail

/// A force that depends on a multiplier: `points()`, `constraint()` and
/// `friction([t,] lambda, r_1, ..., r_k, v_1, ..., v_k)`, which returns the force on each point.
template <class E>
concept FrictionForce = ActsOnPoints<E> && ReadsMultiplier<E> &&
    (detail::applicable<detail::FrictionOf<E>, detail::ProbeFriction<E>> ||
     detail::applicable_with_time<detail::FrictionOf<E>, detail::Probe<E>, detail::ProbeFriction<E>>);

/// A user's own force that depends on a multiplier; made by `friction_law`.
template <int Rows, class Points, class Law>
struct FrictionFromLaw {
  static constexpr std::string_view kind = "FrictionLaw";
  Constraint<Rows> of;  ///< whose multiplier it reads
  Points on;            ///< its points
  Law function;         ///< as it was stated

  /// Its points.
  const Points& points() const { return on; }
  /// Whose multiplier it reads.
  const Constraint<Rows>& constraint() const { return of; }
  auto friction(const auto&... a) const requires requires { function(a...); }
  { return function(a...); }
};

/// A force from its law F(lambda, r, v) that reads the multiplier of one constraint: sliding friction on
/// a surface,
///
///   friction_law(table, points(block), [](auto lambda, auto, auto v) {
///     return -0.3 * lambda * v.normalized();
///   })
///
/// lambda is a number, or a vector for a constraint of several equations, and has the sign that
/// Sample::multiplier has: positive pushes towards g > 0. Where it may have either, as on a wire, the
/// law takes abs(lambda), whose kink a run finds and goes on from. Time may stand in front; for
/// several points return std::tuple{f_a, f_b}. The force is an applied one, F in M q'' = F + W^T lambda: it
/// is no part of the constraint's force, and its power is listed by `virtual_work`.
///
/// The law is called with multipliers near those of the motion: with those of the motion without friction at
/// first, later with the last ones, and with the iterates of Newton's method, which may lie on the other side
/// of 0 for a moment. It needs a value and a derivative where lambda itself is, none at 0.
///
/// It describes sliding, not sticking: where the sliding velocity vanishes and friction exceeds the driving
/// force both ways, or holds what is at rest, the run stops and says so; smooth the law, v / sqrt(v^2 +
/// small^2), or end the run there. Where friction is weaker, sliding reverses. Nor does a constraint open
/// where lambda changes sign.
///
/// Friction that changes, through other constraints, the very multiplier that it reads has a limit
/// beyond which no acceleration exists, or no unique one (Painleve); reaching it is an error that names the
/// force. So is reading a multiplier that the motion does not determine, of redundant constraints.
template <int Rows, class... P, class Law>
[[nodiscard]] auto friction_law(Constraint<Rows> of, std::tuple<P...> on, Law law) {
  using Force = FrictionFromLaw<Rows, std::tuple<P...>, Law>;
  if constexpr (detail::written_for_any_scalar<std::tuple<P...>, Law>())
    static_assert(
        FrictionForce<Force>,
        "the lambda of a friction law takes lambda, the position of each of its points and then the "
        "velocity of each, and time in front of them if it depends on time");
  return Force{of, std::move(on), std::move(law)};
}

}  // namespace dalembert
