#pragma once

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/vec.h>

#include <compare>

namespace dalembert::detail {

/// Arithmetic and comparisons of numbers D that carry derivatives. Comparisons are by value and reported to
/// Branches. (Friends: where all names of the library are visible, templates would be tried on enumerations,
/// which clang 14 answers with an error.)
template <class D>
struct Arithmetic {
  /// Whether value and gradient are finite.
  [[nodiscard]] bool finite() const {
    const D& a = static_cast<const D&>(*this);
    double zero = 0.0 * a.value;
    for (int i = 0; i < D::directions; ++i) zero += 0.0 * a.z[i];
    return zero == 0.0;
  }

  DALEMBERT_INLINE friend D operator+(const D& a) { return a; }
  DALEMBERT_INLINE friend D operator-(const D& a) { return D::scaled(-1.0, a); }

  DALEMBERT_INLINE friend D operator+(const D& a, const D& b) { return D::sum(a, b); }
  DALEMBERT_INLINE friend D operator+(const D& a, double b) { return D::with_value(a, a.value + b); }
  DALEMBERT_INLINE friend D operator+(double a, const D& b) { return D::with_value(b, a + b.value); }
  DALEMBERT_INLINE friend D operator-(const D& a, const D& b) { return D::difference(a, b); }
  DALEMBERT_INLINE friend D operator-(const D& a, double b) { return D::with_value(a, a.value - b); }
  DALEMBERT_INLINE friend D operator-(double a, const D& b) { return D::with_value(-b, a - b.value); }

  DALEMBERT_INLINE friend D operator*(const D& a, const D& b) { return D::product(a, b); }
  DALEMBERT_INLINE friend D operator*(const D& a, double b) { return D::scaled(b, a); }
  DALEMBERT_INLINE friend D operator*(double a, const D& b) { return D::scaled(a, b); }
  DALEMBERT_INLINE friend D operator/(const D& a, const D& b) { return D::quotient(a, b); }
  DALEMBERT_INLINE friend D operator/(const D& a, double b) {
    return D::with_value(D::scaled(1.0 / b, a), a.value / b);
  }
  DALEMBERT_INLINE friend D operator/(double a, const D& b) {
    const double f = a / b.value, f_b = -f / b.value;
    return D::chain(b, f, f_b, -2.0 * f_b / b.value);
  }

  DALEMBERT_INLINE friend D& operator+=(D& a, const D& b) { return a = a + b; }
  DALEMBERT_INLINE friend D& operator-=(D& a, const D& b) { return a = a - b; }
  DALEMBERT_INLINE friend D& operator*=(D& a, const D& b) { return a = a * b; }
  DALEMBERT_INLINE friend D& operator/=(D& a, const D& b) { return a = a / b; }
  DALEMBERT_INLINE friend D& operator+=(D& a, double b) { return a = a + b; }
  DALEMBERT_INLINE friend D& operator-=(D& a, double b) { return a = a - b; }
  DALEMBERT_INLINE friend D& operator*=(D& a, double b) { return a = a * b; }
  DALEMBERT_INLINE friend D& operator/=(D& a, double b) { return a = a / b; }

  friend bool operator==(const D& a, const D& b) { return a.value == b.value; }
  friend bool operator==(const D& a, double b) { return a.value == b; }
  friend std::partial_ordering operator<=>(const D& a, const D& b) {
    return Branches::compare(a.value, b.value);
  }
  friend std::partial_ordering operator<=>(const D& a, double b) { return Branches::compare(a.value, b); }
  friend bool isfinite(const D& a) { return a.finite(); }
};

}  // namespace dalembert::detail
