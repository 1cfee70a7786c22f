#pragma once

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

/// A matrix or an expression of Eigen, known by its members: nothing of Eigen is included.
template <class E>
concept OfEigen = requires(const E& e) {
  E::RowsAtCompileTime;
  E::ColsAtCompileTime;
  typename E::PlainObject;
  e.eval();
};
/// One that is a column, or a row, of N numbers.
template <class E, int N>
concept ColumnOfEigen = OfEigen<E> &&((E::RowsAtCompileTime == N && E::ColsAtCompileTime == 1) ||
                                      (E::RowsAtCompileTime == 1 && E::ColsAtCompileTime == N));

/// A vector as a row, for a stream.
template <class S, int N>
struct Row {
  VecOf<S, N> column;
};

/// v << 1, 2, 3;
template <class S, int N>
class Filling {
 public:
  explicit Filling(S* place) : place_(place) {}
  Filling& operator,(const S& x) {
    *place_++ = x;
    return *this;
  }
  template <int M>
  Filling& operator,(const VecOf<S, M>& x) {
    for (int i = 0; i < M; ++i) *place_++ = x[i];
    return *this;
  }

 private:
  S* place_;
};

}  // namespace detail

/// A column of N numbers of type S: positions, velocities and forces, and what a constraint's equation
/// computes with, S being `double` or a number that carries derivatives. Its functions have the names that
/// they have in Eigen, to and from whose fixed vectors it converts; every result is a vector, no expression.
/// Like a number, one without a value is not set to 0.
template <class S, int N>
struct VecOf {
  static_assert(N > 0);
  using Scalar = S;
  static constexpr int RowsAtCompileTime = N;

  S e[N];

  VecOf() = default;
  VecOf(const VecOf&) = default;
  /// Not to what a function has returned, a `tail` for one: it would be lost.
  VecOf& operator=(const VecOf&) & = default;
  explicit constexpr VecOf(const S& x) requires(N == 1) : e{x} {}
  template <class X, class Y>
    requires(N == 2 && std::convertible_to<X, S> && std::convertible_to<Y, S>)
  constexpr VecOf(const X& x, const Y& y) : e{S(x), S(y)} {}
  template <class X, class Y, class Z>
    requires(N == 3 && std::convertible_to<X, S> && std::convertible_to<Y, S> && std::convertible_to<Z, S>)
  constexpr VecOf(const X& x, const Y& y, const Z& z) : e{S(x), S(y), S(z)} {}
  template <class... T>
    requires(N > 3 && sizeof...(T) == N && (std::convertible_to<T, S> && ...))
  constexpr VecOf(const T&... x) : e{S(x)...} {}

  /// From and to what Eigen calls a vector of N numbers.
  template <detail::ColumnOfEigen<N> E>
  VecOf(const E& of_eigen) {  // NOLINT(google-explicit-constructor)
    const auto& from = of_eigen.eval();
    for (int i = 0; i < N; ++i) e[i] = S(from.coeff(i));
  }
  /// Of one whose size only the running program knows, N.
  template <detail::OfEigen E>
    requires(E::RowsAtCompileTime == -1 && E::ColsAtCompileTime == 1)
  explicit VecOf(const E& of_eigen) {
    const auto& from = of_eigen.eval();
    for (int i = 0; i < N; ++i) e[i] = S(from.coeff(i));
  }
  template <detail::OfEigen E>
    requires(std::same_as<E, typename E::PlainObject>&& E::ColsAtCompileTime == 1 &&
             (E::RowsAtCompileTime == N || E::RowsAtCompileTime == -1))
  operator E() const {  // NOLINT(google-explicit-constructor)
    E to;
    if constexpr (E::RowsAtCompileTime == -1) to.resize(N);
    for (int i = 0; i < N; ++i) to.coeffRef(i) = e[i];
    return to;
  }

  constexpr S& operator[](int i) { return e[i]; }
  constexpr const S& operator[](int i) const { return e[i]; }
  constexpr S& operator()(int i) { return e[i]; }
  constexpr const S& operator()(int i) const { return e[i]; }
  S& x() { return e[0]; }
  const S& x() const { return e[0]; }
  S& y() requires(N > 1) { return e[1]; }
  const S& y() const requires(N > 1) { return e[1]; }
  S& z() requires(N > 2) { return e[2]; }
  const S& z() const requires(N > 2) { return e[2]; }
  [[nodiscard]] static constexpr int size() { return N; }
  S* data() { return e; }
  const S* data() const { return e; }
  S* begin() { return e; }
  S* end() { return e + N; }
  const S* begin() const { return e; }
  const S* end() const { return e + N; }
  /// Itself: equations may be written for Eigen's vectors, too.
  const VecOf& eval() const { return *this; }

  /// The N numbers from a place in memory on.
  [[nodiscard]] DALEMBERT_INLINE static VecOf from(const S* x) {
    VecOf r;
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r.e[i] = x[i];
    return r;
  }
  [[nodiscard]] static constexpr VecOf Constant(const S& s) {
    VecOf r{};
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r.e[i] = s;
    return r;
  }
  [[nodiscard]] static constexpr VecOf Zero() { return Constant(S(0.0)); }
  [[nodiscard]] static constexpr VecOf Ones() { return Constant(S(1.0)); }
  [[nodiscard]] static constexpr VecOf Unit(int k) {
    VecOf r = Zero();
    r.e[k] = S(1.0);
    return r;
  }
  [[nodiscard]] static constexpr VecOf UnitX() { return Unit(0); }
  [[nodiscard]] static constexpr VecOf UnitY() requires(N > 1) { return Unit(1); }
  [[nodiscard]] static constexpr VecOf UnitZ() requires(N > 2) { return Unit(2); }
  void setZero() & { *this = Zero(); }
  void setConstant(const S& s) & { *this = Constant(s); }
  detail::Filling<S, N> operator<<(const S& x) & { return detail::Filling<S, N>(e), x; }
  template <int M>
  detail::Filling<S, N> operator<<(const VecOf<S, M>& x) & {
    return detail::Filling<S, N>(e), x;
  }

  /// With every component as a T.
  template <class T>
  [[nodiscard]] DALEMBERT_INLINE VecOf<T, N> cast() const {
    if constexpr (std::is_same_v<T, S>) {
      return *this;
    } else {
      VecOf<T, N> r;
      DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r.e[i] = T(e[i]);
      return r;
    }
  }
  /// M components from number `first` on.
  template <int M>
  [[nodiscard]] DALEMBERT_INLINE VecOf<S, M> segment(int first) const {
    VecOf<S, M> r;
    DALEMBERT_UNROLL for (int i = 0; i < M; ++i) r.e[i] = e[first + i];
    return r;
  }
  template <int M>
  [[nodiscard]] VecOf<S, M> head() const {
    return segment<M>(0);
  }
  template <int M>
  [[nodiscard]] VecOf<S, M> tail() const {
    return segment<M>(N - M);
  }

  DALEMBERT_INLINE VecOf& operator+=(const VecOf& b) & {
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) e[i] += b.e[i];
    return *this;
  }
  DALEMBERT_INLINE VecOf& operator-=(const VecOf& b) & {
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) e[i] -= b.e[i];
    return *this;
  }
  DALEMBERT_INLINE VecOf& operator*=(const S& b) & {
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) e[i] *= b;
    return *this;
  }
  DALEMBERT_INLINE VecOf& operator/=(const S& b) & {
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) e[i] /= b;
    return *this;
  }
  DALEMBERT_INLINE VecOf operator-() const {
    VecOf r;
    DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r.e[i] = -e[i];
    return r;
  }
  template <class T>
  [[nodiscard]] DALEMBERT_INLINE auto dot(const VecOf<T, N>& b) const {
    auto s = e[0] * b.e[0];
    DALEMBERT_UNROLL for (int i = 1; i < N; ++i) s += e[i] * b.e[i];
    return s;
  }
  template <class T>
  [[nodiscard]] DALEMBERT_INLINE auto cross(const VecOf<T, N>& b) const requires(N == 3) {
    using R = decltype(e[0] * b.e[0]);
    return VecOf<R, 3>(e[1] * b.e[2] - e[2] * b.e[1], e[2] * b.e[0] - e[0] * b.e[2],
                       e[0] * b.e[1] - e[1] * b.e[0]);
  }
  template <detail::ColumnOfEigen<N> E>
  [[nodiscard]] auto dot(const E& b) const {
    return dot(VecOf<typename E::Scalar, N>(b));
  }
  template <detail::ColumnOfEigen<N> E>
  [[nodiscard]] auto cross(const E& b) const requires(N == 3) {
    return cross(VecOf<typename E::Scalar, N>(b));
  }
  [[nodiscard]] DALEMBERT_INLINE S squaredNorm() const { return dot(*this); }
  [[nodiscard]] DALEMBERT_INLINE S norm() const {
    using std::sqrt;
    return sqrt(squaredNorm());
  }
  [[nodiscard]] DALEMBERT_INLINE VecOf normalized() const { return *this / norm(); }
  void normalize() { *this = normalized(); }
  [[nodiscard]] S sum() const {
    S s = e[0];
    DALEMBERT_UNROLL for (int i = 1; i < N; ++i) s += e[i];
    return s;
  }
  [[nodiscard]] S maxCoeff() const {
    S most = e[0];
    for (int i = 1; i < N; ++i)
      if (most < e[i]) most = e[i];
    return most;
  }
  [[nodiscard]] S minCoeff() const { return -(-*this).maxCoeff(); }
  [[nodiscard]] VecOf cwiseAbs() const {
    using std::abs;
    VecOf r;
    for (int i = 0; i < N; ++i) r.e[i] = abs(e[i]);
    return r;
  }
  [[nodiscard]] VecOf cwiseAbs2() const { return cwiseProduct(*this); }
  [[nodiscard]] VecOf cwiseInverse() const { return Ones().cwiseQuotient(*this); }
  [[nodiscard]] VecOf cwiseProduct(const VecOf& b) const {
    VecOf r;
    for (int i = 0; i < N; ++i) r.e[i] = e[i] * b.e[i];
    return r;
  }
  [[nodiscard]] VecOf cwiseQuotient(const VecOf& b) const {
    VecOf r;
    for (int i = 0; i < N; ++i) r.e[i] = e[i] / b.e[i];
    return r;
  }
  [[nodiscard]] bool allFinite() const {
    using std::isfinite;
    for (int i = 0; i < N; ++i)
      if (!isfinite(e[i])) return false;
    return true;
  }
  /// |a - b| <= precision min(|a|, |b|).
  [[nodiscard]] bool isApprox(const VecOf& b, double precision = 1e-12) const {
    const S least = norm() < b.norm() ? norm() : b.norm();
    return (*this - b).norm() <= precision * least;
  }
  __attribute__((unavailable("include <dalembert/eigen.h> and write eigen(v).asDiagonal()"))) void
  asDiagonal() const;
  /// Whether no component is larger than that.
  [[nodiscard]] bool isZero(double precision = 1e-12) const {
    for (int i = 0; i < N; ++i)
      if (!(-precision <= e[i] && e[i] <= precision)) return false;
    return true;
  }
  /// As a row, to be written to a stream.
  [[nodiscard]] detail::Row<S, N> transpose() const { return {*this}; }
  friend bool operator==(const VecOf& a, const VecOf& b) {
    for (int i = 0; i < N; ++i)
      if (!(a.e[i] == b.e[i])) return false;
    return true;
  }
};

template <class A, class B, int N>
DALEMBERT_INLINE auto operator+(const VecOf<A, N>& a, const VecOf<B, N>& b) {
  VecOf<decltype(a.e[0] + b.e[0]), N> r;
  DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r.e[i] = a.e[i] + b.e[i];
  return r;
}
template <class A, class B, int N>
DALEMBERT_INLINE auto operator-(const VecOf<A, N>& a, const VecOf<B, N>& b) {
  VecOf<decltype(a.e[0] - b.e[0]), N> r;
  DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r.e[i] = a.e[i] - b.e[i];
  return r;
}
template <class A, class B, int N>
requires detail::is_scalar<B> DALEMBERT_INLINE auto operator*(const VecOf<A, N>& a, const B& b) {
  VecOf<std::remove_cvref_t<decltype(a.e[0] * b)>, N> r;
  DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r.e[i] = a.e[i] * b;
  return r;
}
template <class A, class B, int N>
requires detail::is_scalar<A> DALEMBERT_INLINE auto operator*(const A& a, const VecOf<B, N>& b) {
  VecOf<std::remove_cvref_t<decltype(a * b.e[0])>, N> r;
  DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r.e[i] = a * b.e[i];
  return r;
}
template <class A, class B, int N>
requires detail::is_scalar<B> DALEMBERT_INLINE auto operator/(const VecOf<A, N>& a, const B& b) {
  VecOf<std::remove_cvref_t<decltype(a.e[0] / b)>, N> r;
  DALEMBERT_UNROLL for (int i = 0; i < N; ++i) r.e[i] = a.e[i] / b;
  return r;
}

// With vectors of Eigen on one side: the result is one of ours.
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
template <class A, int N, detail::ColumnOfEigen<N> E>
bool operator==(const VecOf<A, N>& a, const E& b) {
  return a == VecOf<A, N>(b);
}
template <detail::OfEigen E, class S, int N>
  requires requires(E& e) { e.coeffRef(0) = S(); }
E& operator+=(E& a, const VecOf<S, N>& b) {
  for (int i = 0; i < N; ++i) a.coeffRef(i) += b[i];
  return a;
}
template <detail::OfEigen E, class S, int N>
  requires requires(E& e) { e.coeffRef(0) = S(); }
E& operator-=(E& a, const VecOf<S, N>& b) { return a += -b; }
/// A matrix of Eigen, with a fixed number of rows, times a vector.
template <detail::OfEigen M, class S, int N>
  requires(M::ColsAtCompileTime == N && M::RowsAtCompileTime > 0)
auto operator*(const M& matrix, const VecOf<S, N>& x) {
  const auto& m = matrix.eval();
  using R = std::remove_cvref_t<decltype(m.coeff(0, 0) * x.e[0])>;
  VecOf<R, M::RowsAtCompileTime> r;
  for (int i = 0; i < M::RowsAtCompileTime; ++i) {
    r.e[i] = m.coeff(i, 0) * x.e[0];
    for (int k = 1; k < N; ++k) r.e[i] += m.coeff(i, k) * x.e[k];
  }
  return r;
}

/// Eigen's rotations (quaternions, angle and axis) and transformations of a vector.
template <class R, class S, int N>
  requires requires(const R& r) { r.toRotationMatrix() * r.inverse().toRotationMatrix(); }
auto operator*(const R& rotation, const VecOf<S, N>& x) { return rotation.toRotationMatrix() * x; }
template <class T, class S, int N>
  requires requires(const T& t) {
    t.linear();
    t.translation();
  }
auto operator*(const T& transformation, const VecOf<S, N>& x) {
  return transformation.linear() * x + transformation.translation();
}

namespace detail {
/// matrix << x, y, z; as Eigen fills it: columns beside each other as long as there is room, then below.
template <class M>
class ColumnFilling {
 public:
  explicit ColumnFilling(M& matrix) : matrix_(&matrix) {}
  template <class S, int N>
  ColumnFilling& operator,(const VecOf<S, N>& x) {
    for (int i = 0; i < N; ++i) matrix_->coeffRef(row_ + i, column_) = x[i];
    if (++column_ == matrix_->cols()) {
      column_ = 0;
      row_ += N;
    }
    return *this;
  }
  template <OfEigen E>
    requires(E::ColsAtCompileTime == 1 && E::RowsAtCompileTime > 0)
  ColumnFilling& operator,(const E& x) { return *this, VecOf<typename E::Scalar, E::RowsAtCompileTime>(x); }
  [[nodiscard]] M& finished() const { return *matrix_; }

 private:
  M* matrix_;
  int row_ = 0, column_ = 0;
};
}  // namespace detail
template <detail::OfEigen M, class S, int N>
detail::ColumnFilling<M> operator<<(M& matrix, const VecOf<S, N>& x) {
  return detail::ColumnFilling<M>(matrix), x;
}
template <detail::OfEigen M, class S, int N>
detail::ColumnFilling<M> operator<<(M&& matrix, const VecOf<S, N>& x) {
  return detail::ColumnFilling<M>(matrix), x;
}

/// Components below each other, those of a `transpose()` beside each other. (A template: what writes nothing
/// includes no streams.)
template <class Stream, class S, int N>
  requires requires(Stream& out, const S& s) { out << s << ' '; }
Stream& operator<<(Stream& out, const VecOf<S, N>& v) {
  for (int i = 0; i < N; ++i) {
    if (i > 0) out << '\n';
    out << v.e[i];
  }
  return out;
}
template <class Stream, class S, int N>
  requires requires(Stream& out, const S& s) { out << s << ' '; }
Stream& operator<<(Stream& out, const detail::Row<S, N>& v) {
  for (int i = 0; i < N; ++i) {
    if (i > 0) out << ' ';
    out << v.column.e[i];
  }
  return out;
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
