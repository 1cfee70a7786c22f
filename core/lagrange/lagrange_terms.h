#pragma once

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/equations/arguments.h>
#include <dalembert/core/vec.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace dalembert {

/// A Lagrangian L(t, q, v) of N coordinates and its derivatives at one instant.
template <int N>
struct LagrangeTerms {
  using Matrix = Mat<N, N>;

  double L = 0.0;
  Vec<N> L_q = Vec<N>::Zero();
  Vec<N> L_v = Vec<N>::Zero();  ///< the momenta p
  Matrix L_vv = Matrix::Zero(), L_vq = Matrix::Zero();
  Vec<N> L_vt = Vec<N>::Zero();

  /// What Lagrange's equations  L_vv q'' = L_q - L_vq v - L_vt + Q + A^T lambda  have on their right without
  /// Q and without constraints.
  [[nodiscard]] Vec<N> force(const Vec<N>& v) const { return L_q - L_vq * v - L_vt; }
  /// The energy function h = p v - L; T + V where L = T - V and T is quadratic in the velocities.
  [[nodiscard]] double energy(const Vec<N>& v) const { return L_v.dot(v) - L; }
};

/// A Lagrangian whatever its form.
template <int N>
class Lagrangian {
 public:
  virtual ~Lagrangian() = default;
  [[nodiscard]] virtual LagrangeTerms<N> terms(double t, const Vec<N>& q, const Vec<N>& v) const = 0;
};

namespace detail {

/// Calls a function of (t, arguments...), or of (arguments...) if it does not depend on time.
template <class F, class S, class... A>
[[nodiscard]] decltype(auto) call_in_time(const F& f, const S& t, const A&... arguments) {
  if constexpr (requires { f(t, arguments...); }) {
    return f(t, arguments...);
  } else {
    return f(arguments...);
  }
}

/// The scalars that a Lagrangian is differentiated with, by (q, v, t) and along two velocities.
template <int N>
using LagrangeScalar = HyperDual<directions_for(2 * N + 1)>;

template <int N, class F, class S = LagrangeScalar<N>>
inline constexpr bool takes_time_first = requires(const F& f, const S& t, const VecOf<S, N>& x) {
  f(t, x, x);
};

}  // namespace detail

/// What may be a Lagrangian: written for any scalar, it takes positions and velocities, time in front of them
/// if it depends on time, and returns a number.
template <class F, int N, class S = detail::LagrangeScalar<N>>
concept LagrangianFunction = requires(const F& f, const S& t, const VecOf<S, N>& x) {
  { f(t, x, x) } -> detail::Number;
}
|| requires(const F& f, const VecOf<S, N>& x) {
  { f(x, x) } -> detail::Number;
};

/// A Lagrangian given by a function, differentiated automatically.
template <int N, LagrangianFunction<N> F>
class LagrangianOf final : public Lagrangian<N> {
  static constexpr bool takes_time = detail::takes_time_first<N, F>;
  static constexpr int K = detail::directions_for(2 * N + 1);
  using S = detail::LagrangeScalar<N>;

 public:
  explicit LagrangianOf(F function) : function_(std::move(function)) {}

  [[nodiscard]] LagrangeTerms<N> terms(double t, const Vec<N>& q, const Vec<N>& v) const override {
    LagrangeTerms<N> terms;
    const std::size_t begin = Branches::next();
    for (int k = 0; k < N; k += 2) {
      for (int first = 0; first < 2 * N + (takes_time ? 1 : 0); first += K) {
        Branches::again(begin);
        const S L = along(k, first, t, q, v);
        terms.L = L.value;
        for (int j = 0; j < K; ++j) put(L, j, first + j, k, terms);
      }
    }
    return terms;
  }

 private:
  /// L with its derivatives by K of (q, v, t) from number `first` on, and along velocities k and k + 1.
  [[nodiscard]] S along(int k, int first, double t, const Vec<N>& q, const Vec<N>& v) const {
    VecOf<S, N> x, x_rate;
    for (int i = 0; i < N; ++i) {
      x[i] = S::input(q[i], i - first);
      x_rate[i] = S::input(v[i], N + i - first, typename S::Both{i == k ? 1.0 : 0.0, i == k + 1 ? 1.0 : 0.0});
    }
    return S(detail::call_in_time(function_, S::input(t, 2 * N - first), x, x_rate));
  }
  static void put(const S& L, int j, int variable, int k, LagrangeTerms<N>& terms) {
    if (variable < N) terms.L_q[variable] = L.z[j];
    if (variable >= N && variable < 2 * N) terms.L_v[variable - N] = L.z[j];
    for (int d = 0; d < 2 && k + d < N; ++d) {
      if (variable < N) {
        terms.L_vq(k + d, variable) = L.zs[d][j];
      } else if (variable < 2 * N) {
        terms.L_vv(k + d, variable - N) = L.zs[d][j];
      } else if (variable == 2 * N) {
        terms.L_vt[k + d] = L.zs[d][j];
      }
    }
  }

  F function_;
};

namespace detail {

/// Whether a Lagrangian does not depend on coordinate k there: it is finite where that is no number, its
/// derivative is 0, and no comparison is decided by it: all have the same outcome wherever the coordinate is.
template <int N>
[[nodiscard]] bool independent_of(const Lagrangian<N>& lagrangian, int k, double t, Vec<N> q,
                                  const Vec<N>& v) {
  constexpr double far = 1e100;
  const auto outcomes = [&](double place) {
    q[k] = place;
    Branches::Sides recorded(1);
    const Branches recording(&recorded, nullptr);
    const LagrangeTerms<N> terms = lagrangian.terms(t, q, v);
    const bool finite = std::isfinite(terms.L) && terms.L_q.allFinite() && terms.L_v.allFinite() &&
                        terms.L_vv.allFinite() && terms.L_vq.allFinite();
    std::vector<std::pair<int, double>> sides;
    for (const Branches::Comparison& one : recorded[0]) sides.emplace_back(one.side, one.piece);
    return std::pair(sides, finite && terms.L_q[k] == 0.0);
  };
  try {
    const auto [nowhere, free] = outcomes(std::numeric_limits<double>::quiet_NaN());
    if (!free) return false;
    for (const double place : {0.0, far, -far})
      if (outcomes(place).first != nowhere) return false;
    return true;
  } catch (...) {
    return false;
  }
}

}  // namespace detail

}  // namespace dalembert
