#pragma once

#include <dalembert/core/autodiff/functions.h>
#include <dalembert/core/points/points.h>

#include <array>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

namespace dalembert {

/// Time, coordinates and velocities: what every equation is evaluated at. A view.
struct Instant {
  double t;                   ///< [time]
  std::span<const double> q;  ///< n coordinates
  std::span<const double> v;  ///< n velocities
};

/// Compile-time facts about the points of one constraint or force.
template <class Tuple>
struct PointsOf;

template <Point... P>
struct PointsOf<std::tuple<P...>> {
  static constexpr int count = sizeof...(P);
  static constexpr int inputs = (0 + ... + P::inputs);
  static constexpr int coordinates = (0 + ... + P::coordinates);
  static constexpr bool driven = (false || ... || P::driven);
  /// Whether the inputs simply are the coordinates.
  static constexpr bool direct = (true && ... && (P::inputs == P::coordinates));
  /// Whether all points lie in the same space; a rotor's angle has its place in any.
  template <int D>
  static constexpr bool in_space = (true && ... && (P::dimension == D || std::is_same_v<P, Rotor>));
  static constexpr bool one_space = in_space<2> || in_space<3>;
  /// Where the inputs of each point begin among those of all.
  static constexpr std::array<int, count> first_input = [] {
    std::array<int, count> first{};
    const std::array<int, count> own{P::inputs...};
    for (std::size_t i = 1; i < count; ++i) first[i] = first[i - 1] + own[i - 1];
    return first;
  }();
  template <class S>
  using Positions = std::tuple<VecOf<S, P::dimension>...>;
};

namespace detail {
template <class Tuple>
struct WithoutReferences;
template <class... P>
struct WithoutReferences<std::tuple<P...>> {
  using type = std::tuple<std::remove_cvref_t<P>...>;
};
}  // namespace detail

/// The tuple of points that an element declares, without references.
template <class Element>
using PointTuple = typename detail::WithoutReferences<
    std::remove_cvref_t<decltype(std::declval<const Element&>().points())>>::type;

/// What the points of an element have in common, and how many inputs they are.
template <class Element>
using PointFacts = PointsOf<PointTuple<Element>>;

namespace detail {

/// Position of a point of which the inputs are scalars z of type S.
template <class S, Point P>
[[nodiscard]] DALEMBERT_INLINE VecOf<S, P::dimension> position(const P& point, const S& t, const S* z) {
  if constexpr (P::inputs > 0) {
    return VecOf<S, P::dimension>::from(z);
  } else if constexpr (P::driven) {
    return VecOf<S, P::dimension>(point.path(t).template cast<S>());
  } else {
    return VecOf<double, P::dimension>(point.position).template cast<S>();
  }
}

/// Velocity of a driven point with its dependence on time: the chain rule on r'(t), r''(t).
/// (Second order in t would need r'''; velocities are never asked for that.)
template <class S, Point P>
[[nodiscard]] VecOf<S, P::dimension> driven_velocity(const P& point, const S& t) {
  using Time = Jet<1>;
  const auto path = [&point](double at) {
    return VecOf<Time, P::dimension>(point.path(Time::input(at, 0, 1.0)).template cast<Time>());
  };
  VecOf<S, P::dimension> rate;
  if constexpr (std::is_same_v<S, double>) {
    const auto r = path(t);
    for (int k = 0; k < P::dimension; ++k) rate[k] = r[k].s;
  } else {
    const auto r = path(t.value);
    for (int k = 0; k < P::dimension; ++k) rate[k] = S::chain(t, r[k].s, r[k].ss, 0.0);
  }
  return rate;
}

/// Velocity of a point of which the rates of the inputs are scalars z of type S.
template <class S, Point P>
[[nodiscard]] DALEMBERT_INLINE VecOf<S, P::dimension> velocity(const P& point, const S& t, const S* z) {
  if constexpr (P::inputs > 0) {
    return VecOf<S, P::dimension>::from(z);
  } else if constexpr (P::driven) {
    return driven_velocity<S>(point, t);
  } else {
    return VecOf<S, P::dimension>::Constant(S(0.0));
  }
}

/// Calls `f` with time in front if it takes time, then `first`, and the positions of all points of an
/// element.
template <bool takes_time, class E, class F, class S, class... First>
[[nodiscard]] DALEMBERT_INLINE auto call_at(const F& f, const E& element, const S& t, const S* r,
                                            const First&... first) {
  constexpr auto at = PointFacts<E>::first_input;
  const auto& on = element.points();
  const auto each = [&]<std::size_t... I>(std::index_sequence<I...>) DALEMBERT_INLINE_LAMBDA {
    if constexpr (takes_time) {
      return f(t, first..., detail::position<S>(std::get<I>(on), t, r + at[I])...);
    } else {
      return f(first..., detail::position<S>(std::get<I>(on), t, r + at[I])...);
    }
  };
  return each(std::make_index_sequence<PointFacts<E>::count>{});
}

/// The same, with the velocities of all points behind their positions.
template <bool takes_time, class E, class F, class S, class... First>
[[nodiscard]] DALEMBERT_INLINE auto call_in_motion(const F& f, const E& element, const S& t, const S* r,
                                                   const S* v, const First&... first) {
  constexpr auto at = PointFacts<E>::first_input;
  const auto& on = element.points();
  const auto each = [&]<std::size_t... I>(std::index_sequence<I...>) DALEMBERT_INLINE_LAMBDA {
    if constexpr (takes_time) {
      return f(t, first..., detail::position<S>(std::get<I>(on), t, r + at[I])...,
               detail::velocity<S>(std::get<I>(on), t, v + at[I])...);
    } else {
      return f(first..., detail::position<S>(std::get<I>(on), t, r + at[I])...,
               detail::velocity<S>(std::get<I>(on), t, v + at[I])...);
    }
  };
  return each(std::make_index_sequence<PointFacts<E>::count>{});
}

/// The types that an equation is called with, time in front of others.
template <class S, class Tuple>
struct TimeInFront;
template <class S, class... A>
struct TimeInFront<S, std::tuple<A...>> {
  using type = std::tuple<S, A...>;
};

/// What `f` returns for arguments of the types in a tuple.
template <class F, class Tuple>
struct ResultOf;
template <class F, class... A>
struct ResultOf<F, std::tuple<A...>> {
  using type = std::remove_cvref_t<decltype(std::declval<const F&>()(std::declval<const A&>()...))>;
};
template <bool takes_time, class F, class S, class Tuple>
using Result = typename ResultOf<
    F, typename std::conditional_t<takes_time, TimeInFront<S, Tuple>, std::type_identity<Tuple>>::type>::type;

/// Whether `f` can be called with the types in a tuple, and whether with time in front.
template <class F, class Tuple>
inline constexpr bool applicable = false;
template <class F, class... A>
inline constexpr bool applicable<F, std::tuple<A...>> = requires(const F& f, const A&... a) {
  f(a...);
};
template <class F, class S, class Tuple>
inline constexpr bool applicable_with_time = false;
template <class F, class S, class... A>
inline constexpr bool applicable_with_time<F, S, std::tuple<A...>> = requires(const F& f, const S& t,
                                                                              const A&... a) {
  f(t, a...);
};

/// Calls `f` with every point of the element that has inputs.
template <class Element, class F>
void for_each_moving_point(const Element& element, const F& f) {
  const auto visit = [&f]<class P>(const P& point) {
    if constexpr (P::inputs > 0) f(point);
  };
  std::apply([&visit](const auto&... point) { (visit(point), ...); }, element.points());
}

/// The inputs of an element out of q, or their rates out of v.
template <class Element>
[[nodiscard]] Vec<PointFacts<Element>::inputs> gather_inputs(const Element& element,
                                                             std::span<const double> x) {
  Vec<PointFacts<Element>::inputs> inputs;
  int next = 0;
  for_each_moving_point(element, [&]<class P>(const P& point) {
    const auto own = point.gather(x);
    for (int k = 0; k < P::inputs; ++k) inputs[next + k] = own[k];
    next += P::inputs;
  });
  return inputs;
}

}  // namespace detail

}  // namespace dalembert
