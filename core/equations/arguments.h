#pragma once

#include <dalembert/core/autodiff/dual.h>
#include <dalembert/core/points/points.h>

#include <algorithm>
#include <array>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

namespace dalembert {

/// Time, coordinates and velocities: what every equation is evaluated at. A view.
struct Instant {
  double t;
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

template <class Element>
using PointFacts = PointsOf<PointTuple<Element>>;

namespace detail {

/// The ways to look at a coordinate r with velocity v that is input number k:
/// as a plain number, as a constant, as the k-th variable, or as a function of time along the motion.
template <class S>
struct AsConstant {
  S operator()(double r, double /*v*/, int /*k*/) const { return S(r); }
};
using AsNumber = AsConstant<double>;
template <class S>
struct AsInput {
  S operator()(double r, double /*v*/, int k) const { return S::input(r, k); }
};
template <class S>
struct AlongMotion {
  S operator()(double r, double v, int /*k*/) const {
    S s = S::input(r, 0);
    s.gradient[0] = v;
    return s;
  }
};

/// Position of a point as scalars of type S; `lift` says how its own coordinates enter.
/// (Out of line, as g++ prefers it, the Duals go through memory: a third of a chain's run time.)
template <class S, Point P, class Lift>
[[nodiscard, gnu::always_inline]] inline VecOf<S, P::dimension> position(const P& point, const S& t,
                                                                         const Instant& at, const Lift& lift,
                                                                         int first) {
  if constexpr (P::inputs > 0) {
    const auto r = point.gather(at.q);
    const auto v = point.gather(at.v);
    VecOf<S, P::dimension> lifted;
    for (int k = 0; k < P::inputs; ++k) lifted[k] = lift(r[k], v[k], first + k);
    return lifted;
  } else if constexpr (P::driven) {
    return point.path(t).template cast<S>();
  } else {
    return point.position.template cast<S>();
  }
}

/// Velocity of a driven point with its dependence on time: the chain rule on r'(t), r''(t).
/// (Second order in t would need r'''; velocities are never asked for that.)
template <class S, Point P>
[[nodiscard]] VecOf<S, P::dimension> driven_velocity(const P& point, const S& t) {
  using Time = Dual<1, 2>;
  if constexpr (std::is_same_v<S, double>) {
    const VecOf<Time, P::dimension> path = point.path(Time::input(t, 0)).template cast<Time>();
    VecOf<S, P::dimension> rate;
    for (int k = 0; k < P::dimension; ++k) rate[k] = path[k].gradient[0];
    return rate;
  } else {
    const VecOf<Time, P::dimension> path = point.path(Time::input(t.value, 0)).template cast<Time>();
    VecOf<S, P::dimension> rate;
    for (int k = 0; k < P::dimension; ++k)
      rate[k] = S::chain(t, path[k].gradient[0], path[k].hessian(0, 0), 0.0);
    return rate;
  }
}

/// Velocity of a point as scalars of type S; `lift` gets a velocity as its first argument.
template <class S, Point P, class Lift>
[[nodiscard]] VecOf<S, P::dimension> velocity(const P& point, const S& t, const Instant& at, const Lift& lift,
                                              int first) {
  if constexpr (P::inputs > 0) {
    const auto v = point.gather(at.v);
    VecOf<S, P::dimension> lifted;
    for (int k = 0; k < P::inputs; ++k) lifted[k] = lift(v[k], 0.0, first + k);
    return lifted;
  } else if constexpr (P::driven) {
    return driven_velocity<S>(point, t);
  } else {
    return VecOf<S, P::dimension>::Constant(S(0.0));
  }
}

/// Positions of all points of an element, inputs numbered from `first`.
template <class S, class Element, class Lift>
[[nodiscard]] auto positions(const Element& element, const S& t, const Instant& at, const Lift& lift,
                             int first = 0) {
  const auto& points = element.points();
  const auto each = [&]<std::size_t... I>(std::index_sequence<I...>) {
    return std::make_tuple(detail::position<S>(std::get<I>(points), t, at, lift,
                                               first + PointFacts<Element>::first_input[I])...);
  };
  return each(std::make_index_sequence<PointFacts<Element>::count>{});
}

/// Velocities of all points of an element, inputs numbered from `first`.
template <class S, class Element, class Lift>
[[nodiscard]] auto velocities(const Element& element, const S& t, const Instant& at, const Lift& lift,
                              int first = 0) {
  const auto& points = element.points();
  const auto each = [&]<std::size_t... I>(std::index_sequence<I...>) {
    return std::make_tuple(detail::velocity<S>(std::get<I>(points), t, at, lift,
                                               first + PointFacts<Element>::first_input[I])...);
  };
  return each(std::make_index_sequence<PointFacts<Element>::count>{});
}

/// Calls `f` with the given arguments, with time in front if it takes time.
template <bool takes_time, class F, class S, class Arguments>
[[nodiscard]] decltype(auto) call(const F& f, const S& t, const Arguments& arguments) {
  if constexpr (takes_time) {
    return std::apply([&](const auto&... a) { return f(t, a...); }, arguments);
  } else {
    return std::apply(f, arguments);
  }
}

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

/// The entries of q that an element reads, PointFacts::coordinates of them.
template <class Element>
void read_coordinates(const Element& element, std::span<int> coordinates) {
  auto next = coordinates.begin();
  for_each_moving_point(element,
                        [&next](const auto& point) { next = std::ranges::copy(point.reads(), next).out; });
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
