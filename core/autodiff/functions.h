#pragma once

#include <dalembert/core/autodiff/branches.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <numbers>

namespace dalembert {

/// For equations that are evaluated with plain numbers, too: without these a number finds no max and min, and
/// of abs perhaps C's, which is one of int. (A template, so that ::abs(double) is preferred where it is
/// visible, too, and not ambiguous.) NaN wins, or a fault of an equation would be lost in max(0.0, sqrt(x)).
template <std::floating_point T>
[[nodiscard]] T abs(T a) {
  return std::abs(a);
}
[[nodiscard]] inline double max(double a, double b) { return a < b || std::isnan(b) ? b : a; }
[[nodiscard]] inline double min(double a, double b) { return b < a || std::isnan(b) ? b : a; }

/// The functions of <cmath> for a number D that carries derivatives, each with its first and second one; see
/// Dual::chain. They are called without std::.
///
/// Where a function has a kink or a jump, it asks Branches for the side of its argument: abs, max, min and
/// what is made of them, copysign, and floor, ceil, trunc, round, fmod, whose derivatives are those between
/// their jumps. What has no derivative somewhere (sqrt at 0) gives one there that is not finite.
///
/// They are friends, not templates, so that numbers convert: max(x, 0.0).
template <class D>
struct Functions {
  friend D sqrt(const D& a) {
    const double f = std::sqrt(a.value);
    return D::chain(a, f, 0.5 / f, -0.25 / (f * a.value));
  }
  friend D exp(const D& a) {
    const double f = std::exp(a.value);
    return D::chain(a, f, f, f);
  }
  friend D log(const D& a) {
    const double r = 1.0 / a.value;
    return D::chain(a, std::log(a.value), r, -r * r);
  }
  friend D sin(const D& a) {
    const double s = std::sin(a.value);
    return D::chain(a, s, std::cos(a.value), -s);
  }
  friend D cos(const D& a) {
    const double c = std::cos(a.value);
    return D::chain(a, c, -std::sin(a.value), -c);
  }
  friend D tan(const D& a) {
    const double f = std::tan(a.value);
    const double f_a = 1.0 + f * f;
    return D::chain(a, f, f_a, 2.0 * f * f_a);
  }
  friend D asin(const D& a) {
    const double f_a = 1.0 / std::sqrt(1.0 - a.value * a.value);
    return D::chain(a, std::asin(a.value), f_a, a.value * f_a * f_a * f_a);
  }
  friend D acos(const D& a) {
    const double f_a = -1.0 / std::sqrt(1.0 - a.value * a.value);
    return D::chain(a, std::acos(a.value), f_a, a.value * f_a * f_a * f_a);
  }
  friend D atan(const D& a) {
    const double f_a = 1.0 / (1.0 + a.value * a.value);
    return D::chain(a, std::atan(a.value), f_a, -2.0 * a.value * f_a * f_a);
  }
  friend D sinh(const D& a) {
    const double s = std::sinh(a.value);
    return D::chain(a, s, std::cosh(a.value), s);
  }
  friend D cosh(const D& a) {
    const double c = std::cosh(a.value);
    return D::chain(a, c, std::sinh(a.value), c);
  }
  friend D tanh(const D& a) {
    const double f = std::tanh(a.value);
    const double f_a = 1.0 - f * f;
    return D::chain(a, f, f_a, -2.0 * f * f_a);
  }
  friend D abs(const D& a) { return a < 0.0 ? -a : a; }
  friend D abs2(const D& a) { return a * a; }
  friend D pow(const D& a, double p) {
    // A zero factor must win against 0^(p-2) = inf, or x^1 would be NaN at x = 0.
    const double f_a = p == 0.0 ? 0.0 : p * std::pow(a.value, p - 1.0);
    const double f_aa = p == 0.0 || p == 1.0 ? 0.0 : p * (p - 1.0) * std::pow(a.value, p - 2.0);
    return D::chain(a, std::pow(a.value, p), f_a, f_aa);
  }
  friend D pow(const D& a, const D& b) { return exp(b * log(a)); }
  friend D atan2(const D& y, const D& x) {
    // Equation (2) with f = atan2: the angle's derivatives are those of Im log(x + iy).
    const double r2 = x.value * x.value + y.value * y.value;
    const double f_y = x.value / r2;
    const double f_x = -y.value / r2;
    const double f_xx = -2.0 * f_x * f_y;  // = -f_yy
    const double f_xy = f_x * f_x - f_y * f_y;
    return D::derived(
        std::atan2(y.value, x.value), [&](auto i) { return f_y * y.gradient[i] + f_x * x.gradient[i]; },
        [&](auto i, auto j) {
          return f_y * y.hessian(i, j) + f_x * x.hessian(i, j) +
                 f_xx * (x.gradient[i] * x.gradient[j] - y.gradient[i] * y.gradient[j]) +
                 f_xy * (x.gradient[i] * y.gradient[j] + y.gradient[i] * x.gradient[j]);
        });
  }
  friend D hypot(const D& a, const D& b) { return sqrt(a * a + b * b); }
  friend D exp2(const D& a) {
    const double f = std::exp2(a.value);
    constexpr double k = std::numbers::ln2;
    return D::chain(a, f, k * f, k * k * f);
  }
  friend D expm1(const D& a) {
    const double e = std::exp(a.value);
    return D::chain(a, std::expm1(a.value), e, e);
  }
  friend D log2(const D& a) { return logarithm(a, std::log2(a.value), std::numbers::log2e); }
  friend D log10(const D& a) { return logarithm(a, std::log10(a.value), std::numbers::log10e); }
  friend D log1p(const D& a) {
    const double r = 1.0 / (1.0 + a.value);
    return D::chain(a, std::log1p(a.value), r, -r * r);
  }
  friend D cbrt(const D& a) {
    const double f = std::cbrt(a.value);
    const double f_a = 1.0 / (3.0 * f * f);
    return D::chain(a, f, f_a, -2.0 * f_a * f_a / f);
  }
  friend D asinh(const D& a) {
    const double f_a = 1.0 / std::sqrt(1.0 + a.value * a.value);
    return D::chain(a, std::asinh(a.value), f_a, -a.value * f_a * f_a * f_a);
  }
  friend D acosh(const D& a) {
    const double f_a = 1.0 / std::sqrt(a.value * a.value - 1.0);
    return D::chain(a, std::acosh(a.value), f_a, -a.value * f_a * f_a * f_a);
  }
  friend D atanh(const D& a) {
    const double f_a = 1.0 / (1.0 - a.value * a.value);
    return D::chain(a, std::atanh(a.value), f_a, 2.0 * a.value * f_a * f_a);
  }
  friend D erf(const D& a) { return error_function(a, std::erf(a.value), 1.0); }
  friend D erfc(const D& a) { return error_function(a, std::erfc(a.value), -1.0); }

  friend D fabs(const D& a) { return abs(a); }
  friend D max(const D& a, const D& b) { return a < b || std::isnan(b.value) ? b : a; }
  friend D min(const D& a, const D& b) { return b < a || std::isnan(b.value) ? b : a; }
  friend D fmax(const D& a, const D& b) { return max(a, b); }
  friend D fmin(const D& a, const D& b) { return min(a, b); }
  /// a - b where that is positive, else 0.
  friend D fdim(const D& a, const D& b) { return max(a - b, D(0.0)); }
  /// |a| with the sign of b.
  friend D copysign(const D& a, const D& b) {
    const D size = abs(a);
    return b < 0.0 || (b.value == 0.0 && std::signbit(b.value)) ? -size : size;
  }
  friend D hypot(const D& a, const D& b, const D& c) { return sqrt(a * a + b * b + c * c); }

  friend D floor(const D& a) { return piece(a.value, std::floor(a.value), 0.0, 1.0); }
  friend D ceil(const D& a) { return piece(a.value, std::ceil(a.value), 1.0, 0.0); }
  friend D trunc(const D& a) { return truncated(a.value, std::trunc(a.value)); }
  friend D round(const D& a) { return piece(a.value, std::round(a.value), 0.5, 0.5); }
  /// a - n b, n the integer part of a/b.
  friend D fmod(const D& a, const D& b) {
    const double f = std::fmod(a.value, b.value), natural = std::round((a.value - f) / b.value);
    const D n = truncated(a.value / b.value, natural);
    D r = a - n * b;
    if (n.value == natural) r.value = f;  // without round-off
    return r;
  }

 private:
  [[nodiscard]] static D logarithm(const D& a, double f, double of_e) {
    const double r = 1.0 / a.value;
    return D::chain(a, f, of_e * r, -of_e * r * r);
  }
  [[nodiscard]] static D error_function(const D& a, double f, double sign) {
    const double f_a = sign * 2.0 * std::numbers::inv_sqrtpi * std::exp(-a.value * a.value);
    return D::chain(a, f, f_a, -2.0 * a.value * f_a);
  }
  /// A constant, f of the argument, which jumps where that is so far below or above it.
  [[nodiscard]] static D piece(double argument, double f, double below, double above) {
    f = Branches::choose(f);
    return between(argument, f, below, above);
  }
  [[nodiscard]] static D truncated(double argument, double f) {
    f = Branches::choose(f);
    return between(argument, f, f > 0.0 ? 0.0 : 1.0, f < 0.0 ? 0.0 : 1.0);
  }
  [[nodiscard]] static D between(double argument, double f, double below, double above) {
    Branches::within(argument - (f - below));
    Branches::within(f + above - argument);
    return D(f);
  }
};

}  // namespace dalembert
