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
  using Matrix = Eigen::Matrix<double, N, N>;

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

/// The scalars that a Lagrangian is differentiated with.
template <int N, bool takes_time>
using LagrangeScalar = Dual<2 * N + (takes_time ? 1 : 0), 2>;

template <int N, class F, class S = LagrangeScalar<N, true>>
inline constexpr bool takes_time_first = requires(const F& f, const S& t, const VecOf<S, N>& x) {
  f(t, x, x);
};

}  // namespace detail

/// What may be a Lagrangian: written for any scalar, it takes positions and velocities, time in front of them
/// if it depends on time, and returns a number.
template <class F, int N, class S = detail::LagrangeScalar<N, true>>
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
  using S = detail::LagrangeScalar<N, takes_time>;

 public:
  explicit LagrangianOf(F function) : function_(std::move(function)) {}

  [[nodiscard]] LagrangeTerms<N> terms(double t, const Vec<N>& q, const Vec<N>& v) const override {
    VecOf<S, N> x, x_rate;
    for (int k = 0; k < N; ++k) {
      x[k] = S::input(q[k], k);
      x_rate[k] = S::input(v[k], N + k);
    }
    S time(t);
    if constexpr (takes_time) time = S::input(t, 2 * N);
    const S L(detail::call_in_time(function_, time, x, x_rate));
    LagrangeTerms<N> terms;
    terms.L = L.value;
    terms.L_q = L.gradient.template head<N>();
    terms.L_v = L.gradient.template segment<N>(N);
    terms.L_vv = L.hessian.template block<N, N>(N, N);
    terms.L_vq = L.hessian.template block<N, N>(N, 0);
    if constexpr (takes_time) terms.L_vt = L.hessian.template block<N, 1>(N, 2 * N);
    return terms;
  }

 private:
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
    Branches::Sides heard(1);
    const Branches listening(&heard, nullptr);
    const LagrangeTerms<N> terms = lagrangian.terms(t, q, v);
    const bool finite = std::isfinite(terms.L) && terms.L_q.allFinite() && terms.L_v.allFinite() &&
                        terms.L_vv.allFinite() && terms.L_vq.allFinite();
    std::vector<std::pair<int, double>> sides;
    for (const Branches::Comparison& one : heard[0]) sides.emplace_back(one.side, one.piece);
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
