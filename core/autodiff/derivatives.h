#pragma once

#include <dalembert/core/autodiff/arithmetic.h>
#include <dalembert/core/vec.h>

#include <cmath>

/// Numbers that carry exact derivatives along: forward automatic differentiation. Of a function f of inputs
/// z, in K of whose directions it is differentiated, and of further directions s, of which one is the motion.
///
///   f(a)     :  f_z = f_a a_z,            f_zs = f_a a_zs + f_aa a_s a_z                           (1)
///   a b      :  f_z = b a_z + a b_z,      f_zs = b a_zs + a b_zs + a_s b_z + b_s a_z               (2)
///
/// Three types, as an equation is evaluated in three ways: `Dual` for its residual with gradient, `Jet` for
/// these and the bias in one pass, `HyperDual` for two columns of its second derivatives. (All pairs of
/// directions at once, as a Hessian, are slower than three passes for six inputs; one column at a time finds
/// value and gradient twice as often. Residuals by Jet take up to twice as long as by Dual.)
///
/// Derivatives in several directions are held in pairs for the processor's vector unit, written out: a
/// compiler that is to find them by itself does so at -O3 only, and not always well. Every operation returns
/// a number: with expressions `auto s = x * y + 1.0;` in a user's lambda would refer to what is gone.
namespace dalembert {

namespace detail {

/// How many directions a number has that differentiates with respect to `inputs`, in as few passes as take
/// nine directions each.
[[nodiscard]] constexpr int directions_for(int inputs) {
  const int passes = (inputs + 8) / 9;
  return (inputs + passes - 1) / passes;
}

using Pair [[gnu::vector_size(16)]] = double;

/// K derivatives; of an odd K the last pair has one number that nobody reads.
template <int K>
struct Lanes {
  static constexpr int pairs = (K + 1) / 2;
  Pair p[pairs > 0 ? pairs : 1];

  [[nodiscard]] DALEMBERT_INLINE double operator[](int i) const { return p[i / 2][i % 2]; }
  /// All 0, and of input number `lane` 1 in its direction, if it is one of these K.
  [[nodiscard]] DALEMBERT_INLINE static Lanes unit(int lane) {
    Lanes r;
    DALEMBERT_UNROLL for (int i = 0; i < pairs; ++i) {
      r.p[i] = Pair{lane == 2 * i ? 1.0 : 0.0, lane == 2 * i + 1 ? 1.0 : 0.0};
    }
    return r;
  }
  [[nodiscard]] DALEMBERT_INLINE static Lanes zero() {
    Lanes r;
    DALEMBERT_UNROLL for (int i = 0; i < pairs; ++i) r.p[i] = Pair{0.0, 0.0};
    return r;
  }
  DALEMBERT_INLINE friend Lanes operator+(const Lanes& a, const Lanes& b) {
    Lanes r;
    DALEMBERT_UNROLL for (int i = 0; i < pairs; ++i) r.p[i] = a.p[i] + b.p[i];
    return r;
  }
  DALEMBERT_INLINE friend Lanes operator-(const Lanes& a, const Lanes& b) {
    Lanes r;
    DALEMBERT_UNROLL for (int i = 0; i < pairs; ++i) r.p[i] = a.p[i] - b.p[i];
    return r;
  }
  DALEMBERT_INLINE friend Lanes operator*(double a, const Lanes& b) {
    Lanes r;
    DALEMBERT_UNROLL for (int i = 0; i < pairs; ++i) r.p[i] = a * b.p[i];
    return r;
  }
};

}  // namespace detail

/// A value with its derivatives in K directions: f and f_z.
template <int K>
struct Dual : detail::Arithmetic<Dual<K>> {
  static constexpr int directions = K, along = 0;  ///< directions s
  double value;
  detail::Lanes<K> z;

  DALEMBERT_INLINE Dual() : Dual(0.0) {}
  /// A constant. Implicit, so that numbers with and without derivatives mix in a formula.
  DALEMBERT_INLINE Dual(double constant)  // NOLINT(google-explicit-constructor)
      : Dual(constant, detail::Lanes<K>::zero()) {}
  DALEMBERT_INLINE Dual(double f, const detail::Lanes<K>& f_z) : value(f), z(f_z) {}
  /// The input whose direction is number `lane`.
  [[nodiscard]] DALEMBERT_INLINE static Dual input(double value, int lane) {
    return {value, detail::Lanes<K>::unit(lane)};
  }
  /// (1): f of a, given f and its derivatives there.
  [[nodiscard]] DALEMBERT_INLINE static Dual chain(const Dual& a, double f, double f_a, double) {
    return {f, f_a * a.z};
  }
  [[nodiscard]] DALEMBERT_INLINE static Dual sum(const Dual& a, const Dual& b) {
    return {a.value + b.value, a.z + b.z};
  }
  [[nodiscard]] DALEMBERT_INLINE static Dual difference(const Dual& a, const Dual& b) {
    return {a.value - b.value, a.z - b.z};
  }
  [[nodiscard]] DALEMBERT_INLINE static Dual scaled(double c, const Dual& a) {
    return {c * a.value, c * a.z};
  }
  [[nodiscard]] DALEMBERT_INLINE static Dual product(const Dual& a, const Dual& b) {
    return {a.value * b.value, b.value * a.z + a.value * b.z};
  }
  /// q = a/b, from a = q b.
  [[nodiscard]] DALEMBERT_INLINE static Dual quotient(const Dual& a, const Dual& b) {
    const double r = 1.0 / b.value, q = a.value / b.value;
    return {q, r * (a.z - q * b.z)};
  }
  /// The same derivatives, with another value.
  [[nodiscard]] DALEMBERT_INLINE static Dual with_value(Dual a, double value) {
    a.value = value;
    return a;
  }
};

/// A value with its derivatives in K directions, and its first and second one along the motion:
/// f, f_s, f_ss and f_z.
template <int K>
struct Jet : detail::Arithmetic<Jet<K>> {
  static constexpr int directions = K, along = 1;
  double value, s, ss;
  detail::Lanes<K> z;

  DALEMBERT_INLINE Jet() : Jet(0.0) {}
  /// A constant.
  DALEMBERT_INLINE Jet(double constant)  // NOLINT(google-explicit-constructor)
      : Jet(constant, 0.0, 0.0, detail::Lanes<K>::zero()) {}
  DALEMBERT_INLINE Jet(double f, double f_s, double f_ss, const detail::Lanes<K>& f_z)
      : value(f), s(f_s), ss(f_ss), z(f_z) {}
  /// The input whose direction is number `lane`, and its rate along the motion.
  [[nodiscard]] DALEMBERT_INLINE static Jet input(double value, int lane, double rate = 0.0) {
    return {value, rate, 0.0, detail::Lanes<K>::unit(lane)};
  }
  /// (1): f of a, given f and its derivatives there.
  [[nodiscard]] DALEMBERT_INLINE static Jet chain(const Jet& a, double f, double f_a, double f_aa) {
    return {f, f_a * a.s, f_a * a.ss + f_aa * a.s * a.s, f_a * a.z};
  }
  [[nodiscard]] DALEMBERT_INLINE static Jet sum(const Jet& a, const Jet& b) {
    return {a.value + b.value, a.s + b.s, a.ss + b.ss, a.z + b.z};
  }
  [[nodiscard]] DALEMBERT_INLINE static Jet difference(const Jet& a, const Jet& b) {
    return {a.value - b.value, a.s - b.s, a.ss - b.ss, a.z - b.z};
  }
  [[nodiscard]] DALEMBERT_INLINE static Jet scaled(double c, const Jet& a) {
    return {c * a.value, c * a.s, c * a.ss, c * a.z};
  }
  [[nodiscard]] DALEMBERT_INLINE static Jet product(const Jet& a, const Jet& b) {
    return {a.value * b.value, b.value * a.s + a.value * b.s,
            b.value * a.ss + a.value * b.ss + 2.0 * a.s * b.s, b.value * a.z + a.value * b.z};
  }
  /// q = a/b, from a = q b.
  [[nodiscard]] DALEMBERT_INLINE static Jet quotient(const Jet& a, const Jet& b) {
    const double r = 1.0 / b.value, q = a.value / b.value, q_s = r * (a.s - q * b.s);
    return {q, q_s, r * (a.ss - q * b.ss - 2.0 * q_s * b.s), r * (a.z - q * b.z)};
  }
  /// The same value and derivatives, with another value.
  [[nodiscard]] DALEMBERT_INLINE static Jet with_value(Jet a, double value) {
    a.value = value;
    return a;
  }
};

/// A value with its derivatives in K directions, and those of all of these along two more directions:
/// f, f_s, f_z and f_zs, for each of both s.
template <int K>
struct HyperDual : detail::Arithmetic<HyperDual<K>> {
  using Both = detail::Pair;
  static constexpr int directions = K, along = 2;

  double value;
  Both s;
  detail::Lanes<K> z, zs[2];

  DALEMBERT_INLINE HyperDual() : HyperDual(0.0) {}
  /// A constant.
  DALEMBERT_INLINE HyperDual(double constant)  // NOLINT(google-explicit-constructor)
      : HyperDual(constant, Both{0.0, 0.0}, detail::Lanes<K>::zero(), detail::Lanes<K>::zero(),
                  detail::Lanes<K>::zero()) {}
  DALEMBERT_INLINE HyperDual(double f, Both f_s, const detail::Lanes<K>& f_z, const detail::Lanes<K>& f_zs0,
                             const detail::Lanes<K>& f_zs1)
      : value(f), s(f_s), z(f_z), zs{f_zs0, f_zs1} {}
  [[nodiscard]] DALEMBERT_INLINE static HyperDual input(double value, int lane, Both rate = Both{0.0, 0.0}) {
    return {value, rate, detail::Lanes<K>::unit(lane), detail::Lanes<K>::zero(), detail::Lanes<K>::zero()};
  }
  [[nodiscard]] DALEMBERT_INLINE static HyperDual chain(const HyperDual& a, double f, double f_a,
                                                        double f_aa) {
    const Both f_as = f_aa * a.s;
    return {f, f_a * a.s, f_a * a.z, f_a * a.zs[0] + f_as[0] * a.z, f_a * a.zs[1] + f_as[1] * a.z};
  }
  [[nodiscard]] DALEMBERT_INLINE static HyperDual sum(const HyperDual& a, const HyperDual& b) {
    return {a.value + b.value, a.s + b.s, a.z + b.z, a.zs[0] + b.zs[0], a.zs[1] + b.zs[1]};
  }
  [[nodiscard]] DALEMBERT_INLINE static HyperDual difference(const HyperDual& a, const HyperDual& b) {
    return {a.value - b.value, a.s - b.s, a.z - b.z, a.zs[0] - b.zs[0], a.zs[1] - b.zs[1]};
  }
  [[nodiscard]] DALEMBERT_INLINE static HyperDual scaled(double c, const HyperDual& a) {
    return {c * a.value, c * a.s, c * a.z, c * a.zs[0], c * a.zs[1]};
  }
  [[nodiscard]] DALEMBERT_INLINE static HyperDual product(const HyperDual& a, const HyperDual& b) {
    return {a.value * b.value, b.value * a.s + a.value * b.s, b.value * a.z + a.value * b.z,
            (b.value * a.zs[0] + a.value * b.zs[0]) + (a.s[0] * b.z + b.s[0] * a.z),
            (b.value * a.zs[1] + a.value * b.zs[1]) + (a.s[1] * b.z + b.s[1] * a.z)};
  }
  [[nodiscard]] DALEMBERT_INLINE static HyperDual quotient(const HyperDual& a, const HyperDual& b) {
    const double r = 1.0 / b.value, q = a.value / b.value;
    const Both q_s = r * (a.s - q * b.s);
    const detail::Lanes<K> q_z = r * (a.z - q * b.z);
    return {q, q_s, q_z, r * ((a.zs[0] - q * b.zs[0]) - (q_s[0] * b.z + b.s[0] * q_z)),
            r * ((a.zs[1] - q * b.zs[1]) - (q_s[1] * b.z + b.s[1] * q_z))};
  }
  [[nodiscard]] DALEMBERT_INLINE static HyperDual with_value(HyperDual a, double value) {
    a.value = value;
    return a;
  }
};

/// A number that carries derivatives.
template <class T>
inline constexpr bool is_differentiated = false;
template <int K>
inline constexpr bool is_differentiated<Dual<K>> = true;
template <int K>
inline constexpr bool is_differentiated<Jet<K>> = true;
template <int K>
inline constexpr bool is_differentiated<HyperDual<K>> = true;
template <class T>
concept AnyDifferentiated = is_differentiated<T>;
/// The same, preferred where both say so (see not_of_std.h).
template <class T>
concept Differentiated = AnyDifferentiated<T> && requires {
  T::chain;
};

namespace detail {
template <Differentiated T>
inline constexpr bool is_scalar<T> = true;
}  // namespace detail

/// A number that carries derivatives, times a vector of Eigen.
template <Differentiated S, detail::OfEigen E>
  requires(E::ColsAtCompileTime == 1 && E::RowsAtCompileTime > 0)
auto operator*(const S& a, const E& b) { return a * VecOf<typename E::Scalar, E::RowsAtCompileTime>(b); }
template <Differentiated S, detail::OfEigen E>
  requires(E::ColsAtCompileTime == 1 && E::RowsAtCompileTime > 0)
auto operator*(const E& a, const S& b) { return VecOf<typename E::Scalar, E::RowsAtCompileTime>(a) * b; }

}  // namespace dalembert
