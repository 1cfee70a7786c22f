#pragma once

#include <cassert>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <iosfwd>
#include <type_traits>

// Named here, not included.
namespace Eigen {
template <class Scalar, int Rows, int Cols, int Options, int MaxRows, int MaxCols>
class Matrix;
template <class Xpr>
struct CommaInitializer;
}  // namespace Eigen

/// Loops over the few components of a vector, written out also at -O2. (g++ does so by itself at -O3 only,
/// and clang always.)
#if defined(__GNUC__) && !defined(__clang__)
#define DALEMBERT_UNROLL _Pragma("GCC unroll 8")
#else
#define DALEMBERT_UNROLL
#endif

// Inlined also at -O1 and -O2: out of line, numbers with derivatives would go through memory.
#define DALEMBERT_INLINE [[gnu::always_inline]] inline
#define DALEMBERT_INLINE_LAMBDA __attribute__((always_inline))

namespace dalembert {

template <class S, int N>
struct VecOf;

template <class S, int Rows, int Cols>
struct MatOf;

namespace detail {

/// What multiplies a vector: a number, or one that carries derivatives.
template <class T>
inline constexpr bool is_scalar = std::is_arithmetic_v<T>;

template <class T>
inline constexpr bool is_vector = false;
template <class S, int N>
inline constexpr bool is_vector<VecOf<S, N>> = true;

/// A matrix or an expression of Eigen, told by what it says of itself: Eigen need not be included.
template <class E>
concept OfEigen = requires {
  typename E::PlainObject;
  E::RowsAtCompileTime;
  E::ColsAtCompileTime;
};
/// One that is a column of N numbers, as far as its type says.
template <class E, int N>
concept ColumnOfEigen = OfEigen<E> &&
    (E::ColsAtCompileTime == 1 && (E::RowsAtCompileTime == N || E::RowsAtCompileTime == -1));
/// The same, or a row.
template <class E, int N>
concept MaybeColumnOfEigen = ColumnOfEigen<E, N> ||
    (OfEigen<E> && (E::RowsAtCompileTime == 1 && E::ColsAtCompileTime == N));

/// A vector of N components. Two or three are written out: g++ at -O2 keeps a loop over numbers with
/// derivatives, which then go through memory.
template <class S, int N, class F>
[[nodiscard]] DALEMBERT_INLINE VecOf<S, N> components(const F& of) {
  if constexpr (N == 1) {
    return VecOf<S, N>(S(of(0)));
  } else if constexpr (N == 2) {
    return VecOf<S, N>(of(0), of(1));
  } else if constexpr (N == 3) {
    return VecOf<S, N>(of(0), of(1), of(2));
  } else {
    VecOf<S, N> r;
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r[i] = of(i);
    return r;
  }
}

/// The conjugate of a complex number, of a real one itself.
template <class S>
[[nodiscard]] DALEMBERT_INLINE S conjugate(const S& x) {
  if constexpr (requires { x.imag(); }) {
    return S(x.real(), -x.imag());
  } else {
    return x;
  }
}

/// As `operator<<` of Eigen: columns of numbers of one width.
void print(std::ostream& out, const double* x, int rows, int cols);

}  // namespace detail

/// A column of N numbers of type S: positions, velocities and forces, and what a constraint's equation
/// computes with, S being `double` or a number that carries derivatives. Sums, products and what else
/// equations consist of are vectors, loops over components: expressions such as Eigen's would refer to what
/// may be gone, and cost a compiler much more for every equation. Vectors of Eigen become ones of these, and
/// these become vectors of Eigen, by themselves; only the functions of an Eigen vector take none of these:
/// `n.dot(eigen(r))` (dalembert/eigen.h), or `r.dot(n)`.
template <class S, int N>
struct VecOf {
  static_assert(N > 0);
  using Scalar = S;                            ///< of its components
  static constexpr int RowsAtCompileTime = N;  ///< as Eigen says it
  static constexpr int ColsAtCompileTime = 1;  ///< as Eigen says it

  VecOf() = default;
  VecOf(const VecOf&) = default;  ///< A copy.
  /// Not of what a function returned: `r.head<2>()` is no place to write to.
  VecOf& operator=(const VecOf&) & = default;
  /// @{
  /// Of its components, of numbers of another type, or of a column of Eigen's.
  DALEMBERT_INLINE explicit VecOf(const S& x) requires(N == 1) : c_{x} {}
  template <class... T>
    requires(N > 1 && sizeof...(T) == N && (std::convertible_to<T, S> && ...))
  DALEMBERT_INLINE VecOf(const T&... x) : c_{S(x)...} {}
  template <class T>
    requires(!std::is_same_v<T, S> && std::convertible_to<T, S>)
  VecOf(const VecOf<T, N>& x) {  // NOLINT(google-explicit-constructor)
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) at(i) = S(x[i]);
  }
  template <detail::MaybeColumnOfEigen<N> E>
    requires(std::convertible_to<typename E::Scalar, S>)
  VecOf(const E& of_eigen) {  // NOLINT(google-explicit-constructor)
    const auto& x = of_eigen.eval();
    assert(x.size() == N);
    for (int i = 0; i < N; ++i) at(i) = S(x.coeff(i));
  }
  /// @}
  /// @{
  /// As one of Eigen's, for who has included Eigen.
  operator Eigen::Matrix<S, N, 1, 0, N, 1>() const {  // NOLINT(google-explicit-constructor)
    return Eigen::Matrix<S, N, 1, 0, N, 1>(c_);
  }
  operator Eigen::Matrix<S, -1, 1, 0, -1, 1>() const requires(N > 1) {  // NOLINT(google-explicit-constructor)
    return Eigen::Matrix<S, N, 1, 0, N, 1>(c_);
  }
  /// @}
  friend bool operator==(const VecOf& a, const VecOf& b) {
    for (int i = 0; i < N; ++i)
      if (!(a.at(i) == b.at(i))) return false;
    return true;
  }

  /// @{
  /// Where its numbers are, one after the other.
  [[nodiscard]] DALEMBERT_INLINE S* data() { return c_; }
  [[nodiscard]] DALEMBERT_INLINE const S* data() const { return c_; }
  [[nodiscard]] const S* begin() const { return c_; }
  [[nodiscard]] const S* end() const { return c_ + N; }
  /// @}
  /// @{
  /// How many they are, also as rows and columns.
  [[nodiscard]] static constexpr int size() { return N; }
  [[nodiscard]] static constexpr int rows() { return N; }
  [[nodiscard]] static constexpr int cols() { return 1; }
  /// @}

  /// @{
  /// A component, not checked; of a vector that is about to go by value.
  DALEMBERT_INLINE S& operator[](std::ptrdiff_t i) & { return at(i); }
  DALEMBERT_INLINE const S& operator[](std::ptrdiff_t i) const& { return at(i); }
  DALEMBERT_INLINE S operator[](std::ptrdiff_t i) && { return at(i); }
  DALEMBERT_INLINE S& operator()(std::ptrdiff_t i) & { return at(i); }
  DALEMBERT_INLINE const S& operator()(std::ptrdiff_t i) const& { return at(i); }
  DALEMBERT_INLINE S operator()(std::ptrdiff_t i) && { return at(i); }
  [[nodiscard]] S value() const requires(N == 1) { return at(0); }
  DALEMBERT_INLINE S& x() & { return at(0); }
  DALEMBERT_INLINE const S& x() const& { return at(0); }
  DALEMBERT_INLINE S x() && { return at(0); }
  DALEMBERT_INLINE S& y() & requires(N > 1) { return at(1); }
  DALEMBERT_INLINE const S& y() const& requires(N > 1) { return at(1); }
  DALEMBERT_INLINE S y() && requires(N > 1) { return at(1); }
  DALEMBERT_INLINE S& z() & requires(N > 2) { return at(2); }
  DALEMBERT_INLINE const S& z() const& requires(N > 2) { return at(2); }
  DALEMBERT_INLINE S z() && requires(N > 2) { return at(2); }
  /// @}

  /// @{
  /// Some of the components.
  template <int M>
  [[nodiscard]] VecOf<S, M> head() const {
    return VecOf<S, M>::from(c_);
  }
  template <int M>
  [[nodiscard]] VecOf<S, M> tail() const {
    return VecOf<S, M>::from(c_ + N - M);
  }
  template <int M>
  [[nodiscard]] VecOf<S, M> segment(std::ptrdiff_t first) const {
    return VecOf<S, M>::from(c_ + first);
  }
  /// @}
  /// As a row.
  [[nodiscard]] MatOf<S, 1, N> transpose() const;
  /// @{
  /// Component by component.
  template <class E>
  [[nodiscard]] auto cwiseProduct(const E& b) const {
    VecOf<std::remove_cvref_t<decltype(at(0) * b[0])>, N> r;
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r[i] = at(i) * b[i];
    return r;
  }
  template <class E>
  [[nodiscard]] auto cwiseQuotient(const E& b) const {
    VecOf<std::remove_cvref_t<decltype(at(0) / b[0])>, N> r;
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r[i] = at(i) / b[i];
    return r;
  }
  [[nodiscard]] auto cwiseAbs() const {
    using std::abs;
    VecOf<std::remove_cvref_t<decltype(abs(at(0)))>, N> r;
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r[i] = abs(at(i));
    return r;
  }
  [[nodiscard]] VecOf cwiseAbs2() const { return cwiseProduct(*this); }
  [[nodiscard]] VecOf cwiseMax(const VecOf& b) const {
    VecOf r;
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r.at(i) = at(i) < b.at(i) ? b.at(i) : at(i);
    return r;
  }
  [[nodiscard]] VecOf cwiseMin(const VecOf& b) const {
    VecOf r;
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r.at(i) = b.at(i) < at(i) ? b.at(i) : at(i);
    return r;
  }
  /// @}
  /// Itself: equations may be written for Eigen's expressions, too.
  [[nodiscard]] DALEMBERT_INLINE VecOf eval() const { return *this; }

  /// The N numbers from a place in memory on.
  [[nodiscard]] DALEMBERT_INLINE static VecOf from(const S* x) {
    return detail::components<S, N>([x](int i) DALEMBERT_INLINE_LAMBDA { return x[i]; });
  }
  /// @{
  /// As those of Eigen.
  [[nodiscard]] static VecOf Constant(const S& s) {
    VecOf r;
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r.at(i) = s;
    return r;
  }
  [[nodiscard]] static VecOf Zero() { return Constant(S(0.0)); }
  [[nodiscard]] static VecOf Ones() { return Constant(S(1.0)); }
  [[nodiscard]] static VecOf Unit(std::ptrdiff_t k) {
    VecOf r = Zero();
    r.at(k) = S(1.0);
    return r;
  }
  [[nodiscard]] static VecOf UnitX() { return Unit(0); }
  [[nodiscard]] static VecOf UnitY() requires(N > 1) { return Unit(1); }
  [[nodiscard]] static VecOf UnitZ() requires(N > 2) { return Unit(2); }
  /// @}

  /// With every component as a T.
  template <class T>
  [[nodiscard]] DALEMBERT_INLINE VecOf<T, N> cast() const {
    if constexpr (std::is_same_v<T, S>) {
      return *this;
    } else {
      VecOf<T, N> r;
      DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r.at(i) = T(at(i));
      return r;
    }
  }
  /// @{
  /// As those of Eigen, but by value.
  DALEMBERT_INLINE VecOf& operator+=(const VecOf& b) & {
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) at(i) += b.at(i);
    return *this;
  }
  DALEMBERT_INLINE VecOf& operator-=(const VecOf& b) & {
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) at(i) -= b.at(i);
    return *this;
  }
  DALEMBERT_INLINE VecOf& operator*=(S b) & {  // by value: r *= r.x()
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) at(i) *= b;
    return *this;
  }
  DALEMBERT_INLINE VecOf& operator/=(S b) & {
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) at(i) /= b;
    return *this;
  }
  DALEMBERT_INLINE VecOf operator-() const {
    return detail::components<S, N>([this](int i) DALEMBERT_INLINE_LAMBDA { return -at(i); });
  }
  template <class T>
  [[nodiscard]] DALEMBERT_INLINE auto dot(const VecOf<T, N>& b) const {
    auto s = detail::conjugate(at(0)) * b.at(0);
    DALEMBERT_UNROLL for (int i = 1; i < N; ++i) s += detail::conjugate(at(i)) * b.at(i);
    return s;
  }
  template <class T>
  [[nodiscard]] DALEMBERT_INLINE auto cross(const VecOf<T, N>& b) const requires(N == 3) {
    using R = decltype(at(0) * b.at(0));
    return VecOf<R, 3>(at(1) * b.at(2) - at(2) * b.at(1), at(2) * b.at(0) - at(0) * b.at(2),
                       at(0) * b.at(1) - at(1) * b.at(0));
  }
  template <detail::OfEigen E>
  [[nodiscard]] auto dot(const E& b) const {
    return dot(VecOf<typename E::Scalar, N>(b));
  }
  template <detail::OfEigen E>
  [[nodiscard]] auto cross(const E& b) const requires(N == 3) {
    return cross(VecOf<typename E::Scalar, N>(b));
  }
  [[nodiscard]] DALEMBERT_INLINE auto squaredNorm() const {
    if constexpr (requires { at(0).imag(); }) {
      return dot(*this).real();
    } else {
      return dot(*this);
    }
  }
  [[nodiscard]] DALEMBERT_INLINE auto norm() const {
    using std::sqrt;
    return sqrt(squaredNorm());
  }
  /// @}
  /// Of 0 itself, as in Eigen.
  [[nodiscard]] DALEMBERT_INLINE VecOf normalized() const {
    using std::sqrt;
    const auto square = squaredNorm();
    if (square > 0.0) return *this / sqrt(square);
    return *this;
  }
  /// One across it, of length 1.
  [[nodiscard]] VecOf unitOrthogonal() const requires(N == 2 || N == 3) {
    if constexpr (N == 2) {
      return VecOf(-at(1), at(0)).normalized();
    } else {  // across it and the axis of space that is farther from it
      using std::abs;
      const S low = 1e-12 * abs(at(2));
      if (abs(at(0)) > low || abs(at(1)) > low) return VecOf(-at(1), at(0), S(0.0)).normalized();
      return VecOf(S(0.0), -at(2), at(1)).normalized();
    }
  }
  /// Of 0 likewise.
  void normalize() & { *this = normalized(); }
  /// Of the components.
  [[nodiscard]] S sum() const {
    S s = at(0);
    DALEMBERT_UNROLL for (int i = 1; i < N; ++i) s += at(i);
    return s;
  }

  /// @{
  /// The largest and the smallest component.
  [[nodiscard]] S maxCoeff() const {
    S s = at(0);
    for (int i = 1; i < N; ++i) s = at(i) > s ? at(i) : s;
    return s;
  }
  [[nodiscard]] S minCoeff() const {
    S s = at(0);
    for (int i = 1; i < N; ++i) s = at(i) < s ? at(i) : s;
    return s;
  }
  /// @}
  /// Whether all components are finite.
  [[nodiscard]] bool allFinite() const {
    using std::isfinite;
    for (int i = 0; i < N; ++i)
      if (!isfinite(at(i))) return false;
    return true;
  }
  /// Makes all components 0.
  void setZero() & { *this = Zero(); }
  /// Whether both differ by little beside the smaller of them.
  [[nodiscard]] bool isApprox(const VecOf& b, double precision = 1e-12) const {
    const S a2 = squaredNorm(), b2 = b.squaredNorm();
    return (*this - b).squaredNorm() <= precision * precision * (a2 < b2 ? a2 : b2);
  }

 private:
  template <class T, int M>
  friend struct VecOf;
  DALEMBERT_INLINE S& at(std::ptrdiff_t i) { return c_[i]; }
  DALEMBERT_INLINE const S& at(std::ptrdiff_t i) const { return c_[i]; }

  S c_[N];
};

/// @{
/// Vectors by value, of the type of numbers that holds both.
template <class A, class B, int N>
DALEMBERT_INLINE auto operator+(const VecOf<A, N>& a, const VecOf<B, N>& b) {
  return detail::components<decltype(a[0] + b[0]), N>([&](int i)
                                                          DALEMBERT_INLINE_LAMBDA { return a[i] + b[i]; });
}
template <class A, class B, int N>
DALEMBERT_INLINE auto operator-(const VecOf<A, N>& a, const VecOf<B, N>& b) {
  return detail::components<decltype(a[0] - b[0]), N>([&](int i)
                                                          DALEMBERT_INLINE_LAMBDA { return a[i] - b[i]; });
}
template <class A, class B, int N>
requires detail::is_scalar<B> DALEMBERT_INLINE auto operator*(const VecOf<A, N>& a, const B& b) {
  return detail::components<std::remove_cvref_t<decltype(a[0] * b)>, N>(
      [&](int i) DALEMBERT_INLINE_LAMBDA { return a[i] * b; });
}
template <class A, class B, int N>
requires detail::is_scalar<A> DALEMBERT_INLINE auto operator*(const A& a, const VecOf<B, N>& b) {
  return detail::components<std::remove_cvref_t<decltype(a * b[0])>, N>(
      [&](int i) DALEMBERT_INLINE_LAMBDA { return a * b[i]; });
}
template <class A, class B, int N>
requires detail::is_scalar<B> DALEMBERT_INLINE auto operator/(const VecOf<A, N>& a, const B& b) {
  return detail::components<std::remove_cvref_t<decltype(a[0] / b)>, N>(
      [&](int i) DALEMBERT_INLINE_LAMBDA { return a[i] / b; });
}

/// @}

/// @{
/// With a vector of Eigen on one side: the result is one of ours.
template <class A, int N, detail::ColumnOfEigen<N> E>
auto operator+(const VecOf<A, N>& a, const E& b) {
  return a + VecOf<typename E::Scalar, N>(b);
}
template <class A, int N, detail::ColumnOfEigen<N> E>
auto operator+(const E& a, const VecOf<A, N>& b) {
  return VecOf<typename E::Scalar, N>(a) + b;
}
template <class A, int N, detail::ColumnOfEigen<N> E>
auto operator-(const VecOf<A, N>& a, const E& b) {
  return a - VecOf<typename E::Scalar, N>(b);
}
template <class A, int N, detail::ColumnOfEigen<N> E>
auto operator-(const E& a, const VecOf<A, N>& b) {
  return VecOf<typename E::Scalar, N>(a) - b;
}
/// @}

/// A position, velocity or force in D dimensions, in the user's own consistent units.
template <int D>
using Vec = VecOf<double, D>;

/// A vector from its components, whatever mixture of numbers and numbers with derivatives they are:
/// `vec(0.1 * sin(10.0 * t), 0.0)`.
template <class... S>
[[nodiscard]] auto vec(const S&... component) {
  using T = std::common_type_t<S...>;
  if constexpr (sizeof...(S) == 1) {
    return VecOf<T, 1>(T(component)...);
  } else {
    return VecOf<T, static_cast<int>(sizeof...(S))>(T(component)...);
  }
}

/// A moment or a turning: in the plane a number, counter-clockwise; in space a vector.
template <int D>
using MomentOf = std::conditional_t<D == 2, double, Vec<3>>;

namespace detail {
/// r x F.
[[nodiscard]] inline double moment(const Vec<2>& r, const Vec<2>& F) { return r.x() * F.y() - r.y() * F.x(); }
[[nodiscard]] inline Vec<3> moment(const Vec<3>& r, const Vec<3>& F) {
  return {r.y() * F.z() - r.z() * F.y(), r.z() * F.x() - r.x() * F.z(), r.x() * F.y() - r.y() * F.x()};
}
}  // namespace detail

}  // namespace dalembert

#include <dalembert/core/mat.h>
