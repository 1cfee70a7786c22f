#pragma once

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/autodiff/derivatives.h>

#include <compare>

/// Arithmetic and comparisons of numbers that carry derivatives. Comparisons are by value and reported to
/// Branches.
namespace dalembert {

template <Differentiated D>
DALEMBERT_INLINE D operator+(const D& a) {
  return a;
}
template <Differentiated D>
DALEMBERT_INLINE D operator-(const D& a) {
  return D::scaled(-1.0, a);
}

template <Differentiated D>
DALEMBERT_INLINE D operator+(const D& a, const D& b) {
  return D::sum(a, b);
}
template <Differentiated D>
DALEMBERT_INLINE D operator+(const D& a, double b) {
  return D::with_value(a, a.value + b);
}
template <Differentiated D>
DALEMBERT_INLINE D operator+(double a, const D& b) {
  return D::with_value(b, a + b.value);
}
template <Differentiated D>
DALEMBERT_INLINE D operator-(const D& a, const D& b) {
  return D::difference(a, b);
}
template <Differentiated D>
DALEMBERT_INLINE D operator-(const D& a, double b) {
  return D::with_value(a, a.value - b);
}
template <Differentiated D>
DALEMBERT_INLINE D operator-(double a, const D& b) {
  return D::with_value(-b, a - b.value);
}

template <Differentiated D>
DALEMBERT_INLINE D operator*(const D& a, const D& b) {
  return D::product(a, b);
}
template <Differentiated D>
DALEMBERT_INLINE D operator*(const D& a, double b) {
  return D::scaled(b, a);
}
template <Differentiated D>
DALEMBERT_INLINE D operator*(double a, const D& b) {
  return D::scaled(a, b);
}
template <Differentiated D>
DALEMBERT_INLINE D operator/(const D& a, const D& b) {
  return D::quotient(a, b);
}
template <Differentiated D>
DALEMBERT_INLINE D operator/(const D& a, double b) {
  return D::with_value(D::scaled(1.0 / b, a), a.value / b);
}
template <Differentiated D>
DALEMBERT_INLINE D operator/(double a, const D& b) {
  const double f = a / b.value, f_b = -f / b.value;
  return D::chain(b, f, f_b, -2.0 * f_b / b.value);
}

template <Differentiated D>
DALEMBERT_INLINE D& operator+=(D& a, const D& b) {
  return a = a + b;
}
template <Differentiated D>
DALEMBERT_INLINE D& operator-=(D& a, const D& b) {
  return a = a - b;
}
template <Differentiated D>
DALEMBERT_INLINE D& operator*=(D& a, const D& b) {
  return a = a * b;
}
template <Differentiated D>
DALEMBERT_INLINE D& operator/=(D& a, const D& b) {
  return a = a / b;
}
template <Differentiated D>
DALEMBERT_INLINE D& operator+=(D& a, double b) {
  return a = a + b;
}
template <Differentiated D>
DALEMBERT_INLINE D& operator-=(D& a, double b) {
  return a = a - b;
}
template <Differentiated D>
DALEMBERT_INLINE D& operator*=(D& a, double b) {
  return a = a * b;
}
template <Differentiated D>
DALEMBERT_INLINE D& operator/=(D& a, double b) {
  return a = a / b;
}

template <Differentiated D>
[[nodiscard]] bool operator==(const D& a, const D& b) {
  return a.value == b.value;
}
template <Differentiated D>
[[nodiscard]] bool operator==(const D& a, double b) {
  return a.value == b;
}
template <Differentiated D>
[[nodiscard]] std::partial_ordering operator<=>(const D& a, const D& b) {
  return Branches::compare(a.value, b.value);
}
template <Differentiated D>
[[nodiscard]] std::partial_ordering operator<=>(const D& a, double b) {
  return Branches::compare(a.value, b);
}
template <Differentiated D>
[[nodiscard]] bool isfinite(const D& a) {
  return a.finite();
}

}  // namespace dalembert
