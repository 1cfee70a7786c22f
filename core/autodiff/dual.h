#pragma once

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/autodiff/functions.h>

#include <Eigen/Core>

#include <cmath>
#include <limits>
#include <type_traits>

namespace dalembert {

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

  /// Equation (1): f of a, given f and its derivatives there.
  [[nodiscard]] static Dual chain(const Dual& a, double f, double f_a, [[maybe_unused]] double f_aa) {
    Dual r(f);
    r.gradient = f_a * a.gradient;
    if constexpr (Order == 2) {
      r.hessian = f_a * a.hessian;
      r.hessian.noalias() += (f_aa * a.gradient) * a.gradient.transpose();
    }
    return r;
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
    Dual r(a.value * b.value);
    r.gradient = b.value * a.gradient + a.value * b.gradient;
    if constexpr (Order == 2) {
      r.hessian = b.value * a.hessian + a.value * b.hessian;
      r.hessian.noalias() += a.gradient * b.gradient.transpose();
      r.hessian.noalias() += b.gradient * a.gradient.transpose();
    }
    return r;
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
  friend auto operator<=>(const Dual& a, double b) {
    Branches::compare(a.value, b);
    return a.value <=> b;
  }

  friend bool isfinite(const Dual& a) { return std::isfinite(a.value) && a.gradient.allFinite(); }

 private:
  [[nodiscard]] static Hessian zero_hessian() {
    if constexpr (Order == 2) {
      return Hessian::Zero();
    } else {
      return {};
    }
  }
  [[nodiscard]] static Dual scaled(const Dual& a, double factor, double value) {
    Dual r(value);
    r.gradient = factor * a.gradient;
    if constexpr (Order == 2) r.hessian = factor * a.hessian;
    return r;
  }
};

}  // namespace dalembert

namespace Eigen {

template <int N, int Order>
struct NumTraits<dalembert::Dual<N, Order>> : NumTraits<double> {
  using Real = dalembert::Dual<N, Order>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = N,
    AddCost = 2 * N,
    MulCost = 4 * N
  };
};

template <int N, int Order, class Op>
struct ScalarBinaryOpTraits<dalembert::Dual<N, Order>, double, Op> {
  using ReturnType = dalembert::Dual<N, Order>;
};
template <int N, int Order, class Op>
struct ScalarBinaryOpTraits<double, dalembert::Dual<N, Order>, Op> {
  using ReturnType = dalembert::Dual<N, Order>;
};

}  // namespace Eigen
