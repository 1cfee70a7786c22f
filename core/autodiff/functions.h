#pragma once

#include <dalembert/core/autodiff/derivatives.h>

#include <cmath>
#include <concepts>
#include <numbers>

/// The functions of <cmath> for a number D that carries derivatives, each by its first and second derivative;
/// see Jet::chain. They are called without std::.
///
/// Where a function has a kink or a jump, it asks Branches for the side of its argument: abs, max, min and
/// what is made of them, copysign, and floor, ceil, trunc, round, fmod, whose derivatives are those between
/// their jumps. What has no derivative somewhere (sqrt at 0) gives one there that is not finite.
namespace dalembert {

// Of plain numbers, which the names below would hide.
using std::acos, std::acosh, std::asin, std::asinh, std::atan, std::atan2, std::atanh, std::cbrt, std::ceil,
    std::copysign, std::cos, std::cosh, std::erf, std::erfc, std::exp, std::exp2, std::expm1, std::fabs,
    std::fdim, std::floor, std::fmax, std::fmin, std::fmod, std::hypot, std::log, std::log10, std::log1p,
    std::log2, std::pow, std::round, std::sin, std::sinh, std::sqrt, std::tan, std::tanh, std::trunc;

/// For equations that are evaluated with plain numbers, too: without these a number finds no max and min, and
/// of abs perhaps C's, which is one of int. (A template, so that ::abs(double) is preferred where it is
/// visible, too, and not ambiguous.) NaN wins, or a fault of an equation would be lost in max(0.0, sqrt(x)).
template <std::floating_point T>
[[nodiscard]] T abs(T a) {
  return std::abs(a);
}
[[nodiscard]] inline double max(double a, double b) { return a < b || std::isnan(b) ? b : a; }
[[nodiscard]] inline double min(double a, double b) { return b < a || std::isnan(b) ? b : a; }

template <Differentiated D>
[[nodiscard]] DALEMBERT_INLINE D sqrt(const D& a) {
  const double f = std::sqrt(a.value);
  return D::chain(a, f, 0.5 / f, -0.25 / (f * a.value));
}
template <Differentiated D>
[[nodiscard]] D exp(const D& a) {
  const double f = std::exp(a.value);
  return D::chain(a, f, f, f);
}
template <Differentiated D>
[[nodiscard]] D log(const D& a) {
  const double r = 1.0 / a.value;
  return D::chain(a, std::log(a.value), r, -r * r);
}
template <Differentiated D>
[[nodiscard]] D sin(const D& a) {
  const double s = std::sin(a.value);
  return D::chain(a, s, std::cos(a.value), -s);
}
template <Differentiated D>
[[nodiscard]] D cos(const D& a) {
  const double c = std::cos(a.value);
  return D::chain(a, c, -std::sin(a.value), -c);
}
template <Differentiated D>
[[nodiscard]] D tan(const D& a) {
  const double f = std::tan(a.value), f_a = 1.0 + f * f;
  return D::chain(a, f, f_a, 2.0 * f * f_a);
}
template <Differentiated D>
[[nodiscard]] D asin(const D& a) {
  const double f_a = 1.0 / std::sqrt(1.0 - a.value * a.value);
  return D::chain(a, std::asin(a.value), f_a, a.value * f_a * f_a * f_a);
}
template <Differentiated D>
[[nodiscard]] D acos(const D& a) {
  const double f_a = -1.0 / std::sqrt(1.0 - a.value * a.value);
  return D::chain(a, std::acos(a.value), f_a, a.value * f_a * f_a * f_a);
}
template <Differentiated D>
[[nodiscard]] D atan(const D& a) {
  const double f_a = 1.0 / (1.0 + a.value * a.value);
  return D::chain(a, std::atan(a.value), f_a, -2.0 * a.value * f_a * f_a);
}
template <Differentiated D>
[[nodiscard]] D sinh(const D& a) {
  const double s = std::sinh(a.value);
  return D::chain(a, s, std::cosh(a.value), s);
}
template <Differentiated D>
[[nodiscard]] D cosh(const D& a) {
  const double c = std::cosh(a.value);
  return D::chain(a, c, std::sinh(a.value), c);
}
template <Differentiated D>
[[nodiscard]] D tanh(const D& a) {
  const double f = std::tanh(a.value), f_a = 1.0 - f * f;
  return D::chain(a, f, f_a, -2.0 * f * f_a);
}
template <Differentiated D>
[[nodiscard]] D exp2(const D& a) {
  const double f = std::exp2(a.value);
  constexpr double k = std::numbers::ln2;
  return D::chain(a, f, k * f, k * k * f);
}
template <Differentiated D>
[[nodiscard]] D expm1(const D& a) {
  const double e = std::exp(a.value);
  return D::chain(a, std::expm1(a.value), e, e);
}
template <Differentiated D>
[[nodiscard]] D log2(const D& a) {
  const double r = 1.0 / a.value;
  return D::chain(a, std::log2(a.value), std::numbers::log2e * r, -std::numbers::log2e * r * r);
}
template <Differentiated D>
[[nodiscard]] D log10(const D& a) {
  const double r = 1.0 / a.value;
  return D::chain(a, std::log10(a.value), std::numbers::log10e * r, -std::numbers::log10e * r * r);
}
template <Differentiated D>
[[nodiscard]] D log1p(const D& a) {
  const double r = 1.0 / (1.0 + a.value);
  return D::chain(a, std::log1p(a.value), r, -r * r);
}
template <Differentiated D>
[[nodiscard]] D cbrt(const D& a) {
  const double f = std::cbrt(a.value), f_a = 1.0 / (3.0 * f * f);
  return D::chain(a, f, f_a, -2.0 * f_a * f_a / f);
}
template <Differentiated D>
[[nodiscard]] D asinh(const D& a) {
  const double f_a = 1.0 / std::sqrt(1.0 + a.value * a.value);
  return D::chain(a, std::asinh(a.value), f_a, -a.value * f_a * f_a * f_a);
}
template <Differentiated D>
[[nodiscard]] D acosh(const D& a) {
  const double f_a = 1.0 / std::sqrt(a.value * a.value - 1.0);
  return D::chain(a, std::acosh(a.value), f_a, -a.value * f_a * f_a * f_a);
}
template <Differentiated D>
[[nodiscard]] D atanh(const D& a) {
  const double f_a = 1.0 / (1.0 - a.value * a.value);
  return D::chain(a, std::atanh(a.value), f_a, 2.0 * a.value * f_a * f_a);
}
template <Differentiated D>
[[nodiscard]] D erf(const D& a) {
  const double f_a = 2.0 * std::numbers::inv_sqrtpi * std::exp(-a.value * a.value);
  return D::chain(a, std::erf(a.value), f_a, -2.0 * a.value * f_a);
}
template <Differentiated D>
[[nodiscard]] D erfc(const D& a) {
  const double f_a = -2.0 * std::numbers::inv_sqrtpi * std::exp(-a.value * a.value);
  return D::chain(a, std::erfc(a.value), f_a, -2.0 * a.value * f_a);
}
template <Differentiated D>
[[nodiscard]] D abs(const D& a) {
  return a < 0.0 ? -a : a;
}
template <Differentiated D>
[[nodiscard]] D fabs(const D& a) {
  return abs(a);
}
template <Differentiated D>
[[nodiscard]] D abs2(const D& a) {
  return a * a;
}
template <Differentiated D>
[[nodiscard]] D pow(const D& a, double p) {
  // A zero factor must win against 0^(p-2) = inf, or x^1 would be NaN at x = 0.
  const double f_a = p == 0.0 ? 0.0 : p * std::pow(a.value, p - 1.0);
  const double f_aa = p == 0.0 || p == 1.0 ? 0.0 : p * (p - 1.0) * std::pow(a.value, p - 2.0);
  return D::chain(a, std::pow(a.value, p), f_a, f_aa);
}

template <Differentiated D>
[[nodiscard]] D pow(const D& a, const D& b) {
  return exp(b * log(a));
}
/// The value, and atan((x0 y - y0 x)/(x0 x + y0 y)) with its argument 0 there: the angle seen from (x0, y0).
template <Differentiated D>
[[nodiscard]] D atan2(const D& y, const D& x) {
  const D u = (x.value * y - y.value * x) / (x.value * x + y.value * y);
  return D::with_value(u, std::atan2(y.value, x.value));
}
template <Differentiated D>
[[nodiscard]] D hypot(const D& a, const D& b) {
  return sqrt(a * a + b * b);
}
template <Differentiated D>
[[nodiscard]] D max(const D& a, const D& b) {
  return a < b || std::isnan(b.value) ? b : a;
}
template <Differentiated D>
[[nodiscard]] D min(const D& a, const D& b) {
  return b < a || std::isnan(b.value) ? b : a;
}
template <Differentiated D>
[[nodiscard]] D fmax(const D& a, const D& b) {
  return max(a, b);
}
template <Differentiated D>
[[nodiscard]] D fmin(const D& a, const D& b) {
  return min(a, b);
}
/// a - b where that is positive, else 0.
template <Differentiated D>
[[nodiscard]] D fdim(const D& a, const D& b) {
  return max(a - b, D(0.0));
}
/// |a| with the sign of b.
template <Differentiated D>
[[nodiscard]] D copysign(const D& a, const D& b) {
  const D size = abs(a);
  return b < 0.0 || (b.value == 0.0 && std::signbit(b.value)) ? -size : size;
}

namespace detail {

/// f, a constant that jumps where its argument is so far below or above it.
[[nodiscard]] inline double piece(double argument, double f, double below, double above) {
  Branches::within(argument - (f - below));
  Branches::within(f + above - argument);
  return f;
}
[[nodiscard]] inline double truncated(double argument, double natural) {
  const double f = Branches::choose(natural);
  return piece(argument, f, f > 0.0 ? 0.0 : 1.0, f < 0.0 ? 0.0 : 1.0);
}

}  // namespace detail

template <Differentiated D>
[[nodiscard]] D floor(const D& a) {
  return detail::piece(a.value, Branches::choose(std::floor(a.value)), 0.0, 1.0);
}
template <Differentiated D>
[[nodiscard]] D ceil(const D& a) {
  return detail::piece(a.value, Branches::choose(std::ceil(a.value)), 1.0, 0.0);
}
template <Differentiated D>
[[nodiscard]] D round(const D& a) {
  return detail::piece(a.value, Branches::choose(std::round(a.value)), 0.5, 0.5);
}
template <Differentiated D>
[[nodiscard]] D trunc(const D& a) {
  return detail::truncated(a.value, std::trunc(a.value));
}
/// a - n b, n the integer part of a/b.
template <Differentiated D>
[[nodiscard]] D fmod(const D& a, const D& b) {
  const double f = std::fmod(a.value, b.value), natural = std::round((a.value - f) / b.value);
  const double n = detail::truncated(a.value / b.value, natural);
  const D r = a - n * b;
  return n == natural ? D::with_value(r, f) : r;  // without round-off
}

/// Two arguments, one of them a plain number, and the type of the other.
template <class A, class B>
concept Mixed = (Differentiated<A> && !Differentiated<B> && std::convertible_to<B, double>) ||
                (Differentiated<B> && !Differentiated<A> && std::convertible_to<A, double>);
template <class A, class B>
using Wider = std::conditional_t<is_differentiated<A>, A, B>;

#define DALEMBERT_OF_A_NUMBER_TOO(name)                                    \
  template <class A, class B>                                              \
    requires Mixed<A, B>                                                   \
  [[nodiscard]] Wider<A, B> name(const A& a, const B& b) {                 \
    return name(static_cast<Wider<A, B>>(a), static_cast<Wider<A, B>>(b)); \
  }
DALEMBERT_OF_A_NUMBER_TOO(atan2)
DALEMBERT_OF_A_NUMBER_TOO(hypot)
DALEMBERT_OF_A_NUMBER_TOO(max)
DALEMBERT_OF_A_NUMBER_TOO(min)
DALEMBERT_OF_A_NUMBER_TOO(fmax)
DALEMBERT_OF_A_NUMBER_TOO(fmin)
DALEMBERT_OF_A_NUMBER_TOO(fdim)
DALEMBERT_OF_A_NUMBER_TOO(copysign)
DALEMBERT_OF_A_NUMBER_TOO(fmod)
#undef DALEMBERT_OF_A_NUMBER_TOO

template <Differentiated D>
[[nodiscard]] D pow(double a, const D& b) {
  return exp(b * std::log(a));
}
template <class A, class B, class C>
  requires Differentiated<Wider<Wider<A, B>, C>>
[[nodiscard]] auto hypot(const A& a, const B& b, const C& c) { return sqrt(a * a + b * b + c * c); }

}  // namespace dalembert
