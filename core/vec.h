#pragma once

#include <Eigen/Core>

#include <cmath>
#include <concepts>
#include <type_traits>

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

namespace detail {

/// What multiplies a vector: a number, or one that carries derivatives.
template <class T>
inline constexpr bool is_scalar = std::is_arithmetic_v<T>;

template <class T>
inline constexpr bool is_vector = false;
template <class S, int N>
inline constexpr bool is_vector<VecOf<S, N>> = true;

template <class E>
void take_matrix(const Eigen::MatrixBase<E>&);
/// A matrix or an expression of Eigen, no vector of the library. (A VectorBlock is one whose MatrixBase is
/// that of a Block.)
template <class E>
concept OfEigen = !is_vector<E> && requires(const E& e) {
  take_matrix(e);
};
/// One that is a column of N numbers.
template <class E, int N>
concept ColumnOfEigen = OfEigen<E> &&(E::RowsAtCompileTime == N && E::ColsAtCompileTime == 1);

}  // namespace detail

/// A column of N numbers of type S: positions, velocities and forces, and what a constraint's equation
/// computes with, S being `double` or a number that carries derivatives. It is one of Eigen's, so that all of
/// Eigen takes it; but sums, products and what else equations consist of are vectors, loops over components:
/// Eigen's expressions refer to what may be gone, and cost a compiler much more for every equation.
template <class S, int N>
struct VecOf : Eigen::Matrix<S, N, 1> {
  static_assert(N > 0);
  using Base = Eigen::Matrix<S, N, 1>;  ///< what Eigen takes it for

  VecOf() = default;
  /// @{
  /// Of its components, or of a column of Eigen's.
  DALEMBERT_INLINE explicit VecOf(const S& x) requires(N == 1) { at(0) = x; }
  template <class... T>
    requires(N > 1 && sizeof...(T) == N && (std::convertible_to<T, S> && ...))
  DALEMBERT_INLINE VecOf(const T&... x) {
    S* place = this->data();
    ((*place++ = S(x)), ...);
  }
  VecOf(const Base& of_eigen) : Base(of_eigen) {}  // NOLINT(google-explicit-constructor)
  template <class E>
    requires(std::convertible_to<typename E::Scalar, S>)
  VecOf(const Eigen::MatrixBase<E>& of_eigen) : Base(of_eigen) {}  // NOLINT(google-explicit-constructor)
  /// @}

  /// @{
  /// A component, not checked; of a vector that is about to go by value.
  DALEMBERT_INLINE S& operator[](Eigen::Index i) & { return at(i); }
  DALEMBERT_INLINE const S& operator[](Eigen::Index i) const& { return at(i); }
  DALEMBERT_INLINE S operator[](Eigen::Index i) && { return at(i); }
  DALEMBERT_INLINE S& operator()(Eigen::Index i) & { return at(i); }
  DALEMBERT_INLINE const S& operator()(Eigen::Index i) const& { return at(i); }
  DALEMBERT_INLINE S operator()(Eigen::Index i) && { return at(i); }
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
  /// Some of the components: a place to write to, or else by value, so that of a sum they may be kept.
  template <int M>
  [[nodiscard]] auto head() & {
    return Base::template head<M>();
  }
  template <int M>
  [[nodiscard]] VecOf<S, M> head() const& {
    return VecOf<S, M>::from(this->data());
  }
  template <int M>
  [[nodiscard]] auto tail() & {
    return Base::template tail<M>();
  }
  template <int M>
  [[nodiscard]] VecOf<S, M> tail() const& {
    return VecOf<S, M>::from(this->data() + N - M);
  }
  template <int M>
  [[nodiscard]] auto segment(Eigen::Index first) & {
    return Base::template segment<M>(first);
  }
  template <int M>
  [[nodiscard]] VecOf<S, M> segment(Eigen::Index first) const& {
    return VecOf<S, M>::from(this->data() + first);
  }
  /// @}
  /// @{
  /// As a row; of a vector that is about to go by value.
  [[nodiscard]] auto transpose() & { return Base::transpose(); }
  [[nodiscard]] auto transpose() const& { return Base::transpose(); }
  [[nodiscard]] Eigen::Matrix<S, 1, N> transpose() && { return Base::transpose(); }
  /// @}
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
  [[nodiscard]] VecOf cwiseAbs() const {
    using std::abs;
    VecOf r;
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r.at(i) = abs(at(i));
    return r;
  }
  /// @}
  /// Itself: equations may be written for Eigen's expressions, too.
  [[nodiscard]] DALEMBERT_INLINE VecOf eval() const { return *this; }

  /// The N numbers from a place in memory on.
  [[nodiscard]] DALEMBERT_INLINE static VecOf from(const S* x) {
    VecOf r;
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r.at(i) = x[i];
    return r;
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
  [[nodiscard]] static VecOf Unit(Eigen::Index k) {
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
  DALEMBERT_INLINE VecOf& operator+=(const VecOf& b) {
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) at(i) += b.at(i);
    return *this;
  }
  DALEMBERT_INLINE VecOf& operator-=(const VecOf& b) {
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) at(i) -= b.at(i);
    return *this;
  }
  DALEMBERT_INLINE VecOf& operator*=(S b) {  // by value: r *= r.x()
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) at(i) *= b;
    return *this;
  }
  DALEMBERT_INLINE VecOf& operator/=(S b) {
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) at(i) /= b;
    return *this;
  }
  DALEMBERT_INLINE VecOf operator-() const {
    VecOf r;
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r.at(i) = -at(i);
    return r;
  }
  template <class T>
  [[nodiscard]] DALEMBERT_INLINE auto dot(const VecOf<T, N>& b) const {
    auto s = at(0) * b.at(0);
    DALEMBERT_UNROLL for (int i = 1; i < N; ++i) s += at(i) * b.at(i);
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
  [[nodiscard]] DALEMBERT_INLINE S squaredNorm() const { return dot(*this); }
  [[nodiscard]] DALEMBERT_INLINE S norm() const {
    using std::sqrt;
    return sqrt(squaredNorm());
  }
  /// @}
  /// Of 0 itself, as in Eigen.
  [[nodiscard]] DALEMBERT_INLINE VecOf normalized() const {
    using std::sqrt;
    const S square = squaredNorm();
    if (square > 0.0) return *this / sqrt(square);
    return *this;
  }
  /// Of 0 likewise.
  void normalize() { *this = normalized(); }
  /// Of the components.
  [[nodiscard]] S sum() const {
    S s = at(0);
    DALEMBERT_UNROLL for (int i = 1; i < N; ++i) s += at(i);
    return s;
  }

 private:
  template <class T, int M>
  friend struct VecOf;
  DALEMBERT_INLINE S& at(Eigen::Index i) { return this->data()[i]; }
  DALEMBERT_INLINE const S& at(Eigen::Index i) const { return this->data()[i]; }
};

/// @{
/// Vectors by value, of the type of numbers that holds both.
template <class A, class B, int N>
DALEMBERT_INLINE auto operator+(const VecOf<A, N>& a, const VecOf<B, N>& b) {
  VecOf<decltype(a[0] + b[0]), N> r;
  DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r[i] = a[i] + b[i];
  return r;
}
template <class A, class B, int N>
DALEMBERT_INLINE auto operator-(const VecOf<A, N>& a, const VecOf<B, N>& b) {
  VecOf<decltype(a[0] - b[0]), N> r;
  DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r[i] = a[i] - b[i];
  return r;
}
template <class A, class B, int N>
requires detail::is_scalar<B> DALEMBERT_INLINE auto operator*(const VecOf<A, N>& a, const B& b) {
  VecOf<std::remove_cvref_t<decltype(a[0] * b)>, N> r;
  DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r[i] = a[i] * b;
  return r;
}
template <class A, class B, int N>
requires detail::is_scalar<A> DALEMBERT_INLINE auto operator*(const A& a, const VecOf<B, N>& b) {
  VecOf<std::remove_cvref_t<decltype(a * b[0])>, N> r;
  DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r[i] = a * b[i];
  return r;
}
template <class A, class B, int N>
requires detail::is_scalar<B> DALEMBERT_INLINE auto operator/(const VecOf<A, N>& a, const B& b) {
  VecOf<std::remove_cvref_t<decltype(a[0] / b)>, N> r;
  DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r[i] = a[i] / b;
  return r;
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

namespace detail {
/// A row times a column: a number, and as in Eigen a matrix of one.
template <class S>
struct InnerProduct : VecOf<S, 1> {
  using VecOf<S, 1>::VecOf;
  operator const S&() const { return this->data()[0]; }  // NOLINT(google-explicit-constructor)
};
template <class S>
inline constexpr bool is_vector<InnerProduct<S>> = true;
}  // namespace detail

/// A matrix of Eigen, with a fixed number of rows, times a vector.
template <detail::OfEigen M, class S, int N>
  requires(M::ColsAtCompileTime == N && M::RowsAtCompileTime > 0)
auto operator*(const M& matrix, const VecOf<S, N>& x) {
  constexpr int rows = M::RowsAtCompileTime;
  const auto& m = matrix.eval();
  using R = std::remove_cvref_t<decltype(m.coeff(0, 0) * x[0])>;
  std::conditional_t<rows == 1, detail::InnerProduct<R>, VecOf<R, rows>> r;
  for (int i = 0; i < rows; ++i) {
    r[i] = m.coeff(i, 0) * x[0];
    for (int k = 1; k < N; ++k) r[i] += m.coeff(i, k) * x[k];
  }
  return r;
}
/// A column times a row.
template <class S, int N, detail::OfEigen M>
  requires(M::RowsAtCompileTime == 1 && M::ColsAtCompileTime > 1)
auto operator*(const VecOf<S, N>& x, const M& row) {
  const auto& m = row.eval();
  using R = std::remove_cvref_t<decltype(x[0] * m.coeff(0, 0))>;
  Eigen::Matrix<R, N, M::ColsAtCompileTime> r;
  for (int i = 0; i < N; ++i)
    for (int k = 0; k < M::ColsAtCompileTime; ++k) r(i, k) = x[i] * m.coeff(0, k);
  return r;
}

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

namespace Eigen::internal {
// For a Map of one.
template <class S, int N>
struct traits<dalembert::VecOf<S, N>> : traits<Matrix<S, N, 1>> {};
template <class S, int N>
struct evaluator<dalembert::VecOf<S, N>> : evaluator<Matrix<S, N, 1>> {
  using evaluator<Matrix<S, N, 1>>::evaluator;
};
}  // namespace Eigen::internal
