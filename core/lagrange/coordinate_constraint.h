#pragma once

#include <dalembert/core/lagrange/lagrange_terms.h>
#include <dalembert/core/points/points.h>

#include <array>
#include <string_view>
#include <tuple>
#include <utility>

namespace dalembert::detail {

/// The first N of some numbers times `scale`, each a column of one.
template <int N, class First, class... U>
[[nodiscard]] VecOf<typename First::Scalar, N> scaled(const Vec<N>& scale, const First& first,
                                                      const U&... u) {
  VecOf<typename First::Scalar, N> q;
  int k = 0;
  const auto next = [&](const auto& x) {
    if (k < N) q[k] = scale[k] * x[0];
    ++k;
  };
  next(first);
  (next(u), ...);
  return q;
}

template <int N, class F, class S>
concept OfPositions = requires(const F& f, const VecOf<S, N>& q) {
  f(q);
};
template <int N, class F, class S>
concept OfPositionsInTime = requires(const F& f, const S& t, const VecOf<S, N>& q) {
  f(t, q);
};

/// A holonomic constraint g([t,] q) = 0 on the coordinates q = scale u of a Lagrangian.
template <int N, class G>
struct OnPositions {
  static constexpr std::string_view kind = "Holonomic";
  std::array<Rotor, static_cast<std::size_t>(N)> coordinates;
  Vec<N> scale;
  G function;

  auto points() const { return std::tuple_cat(coordinates); }
  template <class First, class... U>
    requires(sizeof...(U) + 1 == N && OfPositions<N, G, typename First::Scalar>)
  auto operator()(const First& first, const U&... u) const { return function(scaled<N>(scale, first, u...)); }
  template <class S, class... U>
    requires(sizeof...(U) == N && OfPositionsInTime<N, G, S>)
  auto operator()(const S& t, const U&... u) const { return function(t, scaled<N>(scale, u...)); }
};

template <int N, class F, class S>
concept OfMotion = requires(const F& f, const VecOf<S, N>& q) {
  f(q, q);
};
template <int N, class F, class S>
concept OfMotionInTime = requires(const F& f, const S& t, const VecOf<S, N>& q) {
  f(t, q, q);
};

/// A nonholonomic one, a([t,] q, v) = 0, linear in v.
template <int N, class A>
struct OnVelocities {
  static constexpr std::string_view kind = "Nonholonomic";
  static constexpr bool velocity_level = true;
  std::array<Rotor, static_cast<std::size_t>(N)> coordinates;
  Vec<N> scale;
  A function;

  auto points() const { return std::tuple_cat(coordinates); }
  template <class First, class... U>
    requires(sizeof...(U) + 1 == 2 * N && OfMotion<N, A, typename First::Scalar>)
  auto operator()(const First& first, const U&... u) const {
    const auto [q, v] = motion(first, u...);
    return function(q, v);
  }
  template <class S, class... U>
    requires(sizeof...(U) == 2 * N && OfMotionInTime<N, A, S>)
  auto operator()(const S& t, const U&... u) const {
    const auto [q, v] = motion(u...);
    return function(t, q, v);
  }

 private:
  /// q and v out of the coordinates and then their rates.
  template <class First, class... U>
  [[nodiscard]] auto motion(const First& first, const U&... u) const {
    Vec<2 * N> both;
    for (int k = 0; k < N; ++k) both[k] = both[N + k] = scale[k];
    const auto x = scaled<2 * N>(both, first, u...);
    using Half = VecOf<typename First::Scalar, N>;
    return std::pair<Half, Half>(x.template head<N>(), x.template tail<N>());
  }
};

}  // namespace dalembert::detail
