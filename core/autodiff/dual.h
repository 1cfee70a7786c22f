#pragma once

#include <dalembert/core/autodiff/branches.h>

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
template <int N, int Order>
class Dual {
  static_assert(N > 0 && (Order == 1 || Order == 2));
  struct None {};

 public:
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

  friend Dual sqrt(const Dual& a) {
    const double f = std::sqrt(a.value);
    return chain(a, f, 0.5 / f, -0.25 / (f * a.value));
  }
  friend Dual exp(const Dual& a) {
    const double f = std::exp(a.value);
    return chain(a, f, f, f);
  }
  friend Dual log(const Dual& a) {
    const double r = 1.0 / a.value;
    return chain(a, std::log(a.value), r, -r * r);
  }
  friend Dual sin(const Dual& a) {
    const double s = std::sin(a.value);
    return chain(a, s, std::cos(a.value), -s);
  }
  friend Dual cos(const Dual& a) {
    const double c = std::cos(a.value);
    return chain(a, c, -std::sin(a.value), -c);
  }
  friend Dual tan(const Dual& a) {
    const double f = std::tan(a.value);
    const double f_a = 1.0 + f * f;
    return chain(a, f, f_a, 2.0 * f * f_a);
  }
  friend Dual asin(const Dual& a) {
    const double f_a = 1.0 / std::sqrt(1.0 - a.value * a.value);
    return chain(a, std::asin(a.value), f_a, a.value * f_a * f_a * f_a);
  }
  friend Dual acos(const Dual& a) {
    const double f_a = -1.0 / std::sqrt(1.0 - a.value * a.value);
    return chain(a, std::acos(a.value), f_a, a.value * f_a * f_a * f_a);
  }
  friend Dual atan(const Dual& a) {
    const double f_a = 1.0 / (1.0 + a.value * a.value);
    return chain(a, std::atan(a.value), f_a, -2.0 * a.value * f_a * f_a);
  }
  friend Dual sinh(const Dual& a) {
    const double s = std::sinh(a.value);
    return chain(a, s, std::cosh(a.value), s);
  }
  friend Dual cosh(const Dual& a) {
    const double c = std::cosh(a.value);
    return chain(a, c, std::sinh(a.value), c);
  }
  friend Dual tanh(const Dual& a) {
    const double f = std::tanh(a.value);
    const double f_a = 1.0 - f * f;
    return chain(a, f, f_a, -2.0 * f * f_a);
  }
  friend Dual abs(const Dual& a) { return a < 0.0 ? -a : a; }
  friend Dual abs2(const Dual& a) { return a * a; }
  friend Dual pow(const Dual& a, double p) {
    // A zero factor must win against 0^(p-2) = inf, or x^1 would be NaN at x = 0.
    const double f_a = p == 0.0 ? 0.0 : p * std::pow(a.value, p - 1.0);
    const double f_aa = p == 0.0 || p == 1.0 ? 0.0 : p * (p - 1.0) * std::pow(a.value, p - 2.0);
    return chain(a, std::pow(a.value, p), f_a, f_aa);
  }
  friend Dual pow(const Dual& a, const Dual& b) { return exp(b * log(a)); }
  friend Dual atan2(const Dual& y, const Dual& x) {
    // Equation (2) with f = atan2: the angle's derivatives are those of Im log(x + iy).
    const double r2 = x.value * x.value + y.value * y.value;
    const double f_y = x.value / r2;
    const double f_x = -y.value / r2;
    Dual r(std::atan2(y.value, x.value));
    r.gradient = f_y * y.gradient + f_x * x.gradient;
    if constexpr (Order == 2) {
      const double f_xx = -2.0 * f_x * f_y;  // = -f_yy
      const double f_xy = f_x * f_x - f_y * f_y;
      r.hessian = f_y * y.hessian + f_x * x.hessian;
      r.hessian += f_xx * (x.gradient * x.gradient.transpose() - y.gradient * y.gradient.transpose());
      r.hessian += f_xy * (x.gradient * y.gradient.transpose() + y.gradient * x.gradient.transpose());
    }
    return r;
  }
  friend Dual hypot(const Dual& a, const Dual& b) { return sqrt(a * a + b * b); }
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
