#pragma once

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/autodiff/functions.h>
#include <dalembert/core/vec.h>

#include <Eigen/Core>

#include <cmath>
#include <limits>
#include <type_traits>

namespace dalembert {

namespace detail {
[[nodiscard]] bool all_finite(const auto& matrix) {
  bool finite = true;  // all are looked at: comparisons side by side take less time than one after another
  for (int i = 0; i < matrix.size(); ++i) finite &= std::isfinite(matrix.data()[i]);
  return finite;
}
}  // namespace detail

/// A number that carries its exact first (Order 1) or first and second (Order 2) derivatives with
/// respect to N inputs: forward automatic differentiation.
///
///   f(a)     :  f' = f_a a',              f'' = f_a a'' + f_aa a' a'^T                       (1)
///   f(a, b)  :  f' = f_a a' + f_b b',     f'' = f_a a'' + f_b b'' + f_aa a' a'^T
///                                               + f_ab (a' b'^T + b' a'^T) + f_bb b' b'^T    (2)
///
/// Every operation returns a plain Dual. Eigen::AutoDiffScalar returns expressions that refer to
/// temporaries, so that `auto s = x * y + 1.0;` in a user's lambda would read dead memory; and its
/// second derivatives, by nesting, compute the value N + 1 times.
///
/// The functions of <cmath> are in Functions.
template <int N, int Order>
class Dual : Functions<Dual<N, Order>> {
  static_assert(N > 0 && (Order == 1 || Order == 2));
  struct None {};

 public:
  static constexpr int order = Order;
  using Gradient = Eigen::Matrix<double, N, 1>;
  using Hessian = std::conditional_t<Order == 2, Eigen::Matrix<double, N, N>, None>;

  double value = 0.0;
  Gradient gradient = Gradient::Zero();
  [[no_unique_address]] Hessian hessian = zero_hessian();

  Dual() = default;
  /// A constant. Implicit, so that numbers and Duals mix in a formula.
  Dual(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor)

  /// The k-th of the N inputs.
  [[nodiscard]] static Dual input(double value, int k) {
    Dual x(value);
    x.gradient[k] = 1.0;
    return x;
  }

  /// From a value and the entries of its derivatives. (Loops: an Eigen expression costs a compiler four types
  /// and a dozen functions for every N.)
  [[nodiscard]] static Dual derived(double value, const auto& gradient,
                                    [[maybe_unused]] const auto& hessian) {
    Dual r{Blank{}};
    r.value = value;
    for (int i = 0; i < N; ++i) r.gradient[i] = gradient(i);
    if constexpr (Order == 2) {
      for (int j = 0; j < N; ++j) {
        for (int i = 0; i < N; ++i) r.hessian(i, j) = hessian(i, j);
      }
    }
    return r;
  }

  /// Equation (1): f of a, given f and its derivatives there.
  [[nodiscard]] static Dual chain(const Dual& a, double f, double f_a, double f_aa) {
    return derived(
        f, [&](auto i) { return f_a * a.gradient[i]; },
        [&](auto i, auto j) { return f_a * a.hessian(i, j) + (f_aa * a.gradient[i]) * a.gradient[j]; });
  }

  Dual& operator+=(const Dual& b) {
    value += b.value;
    gradient += b.gradient;
    if constexpr (Order == 2) hessian += b.hessian;
    return *this;
  }
  Dual& operator-=(const Dual& b) {
    value -= b.value;
    gradient -= b.gradient;
    if constexpr (Order == 2) hessian -= b.hessian;
    return *this;
  }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }

  friend Dual operator+(const Dual& a) { return a; }
  friend Dual operator-(const Dual& a) { return chain(a, -a.value, -1.0, 0.0); }
  friend Dual operator+(Dual a, const Dual& b) { return a += b; }
  friend Dual operator-(Dual a, const Dual& b) { return a -= b; }
  friend Dual operator+(Dual a, double b) { return a.value += b, a; }
  friend Dual operator+(double a, Dual b) { return b.value += a, b; }
  friend Dual operator-(Dual a, double b) { return a.value -= b, a; }
  friend Dual operator-(double a, const Dual& b) { return chain(b, a - b.value, -1.0, 0.0); }

  friend Dual operator*(const Dual& a, double b) { return scaled(a, b, a.value * b); }
  friend Dual operator*(double a, const Dual& b) { return b * a; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return derived(
        a.value * b.value, [&](auto i) { return b.value * a.gradient[i] + a.value * b.gradient[i]; },
        [&](auto i, auto j) {
          return b.value * a.hessian(i, j) + a.value * b.hessian(i, j) + a.gradient[i] * b.gradient[j] +
                 b.gradient[i] * a.gradient[j];
        });
  }
  friend Dual operator/(const Dual& a, double b) { return scaled(a, 1.0 / b, a.value / b); }
  friend Dual operator/(double a, const Dual& b) {
    const double f = a / b.value;
    return chain(b, f, -f / b.value, 2.0 * f / (b.value * b.value));
  }
  friend Dual operator/(const Dual& a, const Dual& b) { return a * (1.0 / b); }

  friend bool operator==(const Dual& a, const Dual& b) { return a.value == b.value; }
  friend auto operator<=>(const Dual& a, const Dual& b) { return a <=> b.value; }
  friend bool operator==(const Dual& a, double b) { return a.value == b; }
  friend auto operator<=>(const Dual& a, double b) { return Branches::compare(a.value, b); }

  friend bool isfinite(const Dual& a) { return std::isfinite(a.value) && detail::all_finite(a.gradient); }

 private:
  /// To be filled: zeros written before would cost as much as an operation.
  struct Blank {};
  explicit Dual(Blank /*all*/) : gradient(), hessian() {}

  [[nodiscard]] static Hessian zero_hessian() {
    if constexpr (Order == 2) {
      return Hessian::Zero();
    } else {
      return {};
    }
  }
  [[nodiscard]] static Dual scaled(const Dual& a, double factor, double value) {
    return derived(
        value, [&](auto i) { return factor * a.gradient[i]; },
        [&](auto i, auto j) { return factor * a.hessian(i, j); });
  }
};

namespace detail {
template <int N, int Order>
inline constexpr bool is_scalar<Dual<N, Order>> = true;
}  // namespace detail

}  // namespace dalembert
