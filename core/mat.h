#pragma once

#include <dalembert/core/vec.h>

namespace dalembert {

namespace detail {

template <class T>
inline constexpr bool is_matrix = false;
template <class S, int Rows, int Cols>
inline constexpr bool is_matrix<MatOf<S, Rows, Cols>> = true;

template <class E, int Rows, int Cols>
concept MaybeMatrixOfEigen = OfEigen<E> &&((E::RowsAtCompileTime == Rows || E::RowsAtCompileTime == -1) &&
                                           (E::ColsAtCompileTime == Cols || E::ColsAtCompileTime == -1));

}  // namespace detail

/// A matrix of fixed size: the axes of a body as its columns, say. Like vectors, those of Eigen become ones
/// of these, and these become matrices of Eigen.
template <class S, int Rows, int Cols>
struct MatOf {
  static_assert(Rows > 0 && Cols > 0);
  using Scalar = S;  ///< of its entries
  /// Eigen's of this shape.
  using OfEigen = Eigen::Matrix<S, Rows, Cols, (Rows == 1 && Cols > 1), Rows, Cols>;
  static constexpr int RowsAtCompileTime = Rows;  ///< as Eigen says it
  static constexpr int ColsAtCompileTime = Cols;  ///< as Eigen says it

  MatOf() = default;
  MatOf(const MatOf&) = default;  ///< A copy.
  /// Not of what a function returned.
  MatOf& operator=(const MatOf&) & = default;
  /// Of one of Eigen's.
  template <detail::MaybeMatrixOfEigen<Rows, Cols> E>
    requires(std::convertible_to<typename E::Scalar, S>)
  MatOf(const E& of_eigen) {  // NOLINT(google-explicit-constructor)
    const auto& x = of_eigen.eval();
    assert(x.rows() == Rows && x.cols() == Cols);
    for (int k = 0; k < Cols; ++k)
      for (int i = 0; i < Rows; ++i) (*this)(i, k) = S(x.coeff(i, k));
  }
  /// Of its columns.
  template <class... Column>
    requires(Cols > 1 && sizeof...(Column) == Cols && (std::convertible_to<Column, VecOf<S, Rows>> && ...))
  explicit MatOf(const Column&... column) {
    int k = 0;
    (set_col(k++, column), ...);
  }
  /// Of its rows: `Mat<2, 2>({{a, b}, {c, d}})`.
  explicit MatOf(const S (&rows)[Rows][Cols]) {
    for (int k = 0; k < Cols; ++k)
      for (int i = 0; i < Rows; ++i) (*this)(i, k) = rows[i][k];
  }
  /// As one of Eigen's, for who has included Eigen.
  operator OfEigen() const { return OfEigen(c_); }  // NOLINT(google-explicit-constructor)
  friend bool operator==(const MatOf& a, const MatOf& b) {
    for (int i = 0; i < Rows * Cols; ++i)
      if (!(a.c_[i] == b.c_[i])) return false;
    return true;
  }

  /// @{
  /// An entry, not checked; in a row also by one number.
  DALEMBERT_INLINE S& operator()(std::ptrdiff_t i, std::ptrdiff_t k) { return c_[k * Rows + i]; }
  DALEMBERT_INLINE const S& operator()(std::ptrdiff_t i, std::ptrdiff_t k) const { return c_[k * Rows + i]; }
  DALEMBERT_INLINE S& operator[](std::ptrdiff_t k) requires(Rows == 1) { return c_[k]; }
  DALEMBERT_INLINE const S& operator[](std::ptrdiff_t k) const requires(Rows == 1) { return c_[k]; }
  /// @}
  /// @{
  /// Where its numbers are, column after column.
  [[nodiscard]] S* data() { return c_; }
  [[nodiscard]] const S* data() const { return c_; }
  /// @}
  /// @{
  /// How many rows and columns it has.
  [[nodiscard]] static constexpr int rows() { return Rows; }
  [[nodiscard]] static constexpr int cols() { return Cols; }
  /// @}
  /// A column, by value.
  [[nodiscard]] VecOf<S, Rows> col(std::ptrdiff_t k) const { return VecOf<S, Rows>::from(c_ + k * Rows); }
  /// Takes a column.
  void set_col(std::ptrdiff_t k, const VecOf<S, Rows>& column) {
    for (int i = 0; i < Rows; ++i) (*this)(i, k) = column[i];
  }
  /// A row, by value.
  [[nodiscard]] MatOf<S, 1, Cols> row(std::ptrdiff_t i) const {
    MatOf<S, 1, Cols> r;
    for (int k = 0; k < Cols; ++k) r(0, k) = (*this)(i, k);
    return r;
  }
  /// The transpose; of a row a vector.
  [[nodiscard]] auto transpose() const {
    std::conditional_t<Rows == 1, VecOf<S, Cols>, MatOf<S, Cols, Rows>> r;
    for (int k = 0; k < Cols; ++k)
      for (int i = 0; i < Rows; ++i) r.data()[i * Cols + k] = (*this)(i, k);
    return r;
  }
  /// Itself: equations may be written for Eigen's expressions, too.
  [[nodiscard]] MatOf eval() const { return *this; }
  /// With every entry as a T.
  template <class T>
  [[nodiscard]] MatOf<T, Rows, Cols> cast() const {
    MatOf<T, Rows, Cols> r;
    for (int i = 0; i < Rows * Cols; ++i) r.data()[i] = T(c_[i]);
    return r;
  }

  /// @{
  /// As those of Eigen.
  [[nodiscard]] static MatOf Zero() {
    MatOf r;
    for (S& x : r.c_) x = S(0.0);
    return r;
  }
  [[nodiscard]] static MatOf Identity() requires(Rows == Cols) {
    MatOf r = Zero();
    for (int i = 0; i < Rows; ++i) r(i, i) = S(1.0);
    return r;
  }
  [[nodiscard]] bool allFinite() const {
    using std::isfinite;
    for (const S& x : c_)
      if (!isfinite(x)) return false;
    return true;
  }
  [[nodiscard]] S squaredNorm() const {
    S s = c_[0] * c_[0];
    for (int i = 1; i < Rows * Cols; ++i) s += c_[i] * c_[i];
    return s;
  }
  [[nodiscard]] S norm() const {
    using std::sqrt;
    return sqrt(squaredNorm());
  }
  [[nodiscard]] S sum() const {
    S s = c_[0];
    for (int i = 1; i < Rows * Cols; ++i) s += c_[i];
    return s;
  }
  MatOf& operator+=(const MatOf& b) & {
    for (int i = 0; i < Rows * Cols; ++i) c_[i] += b.c_[i];
    return *this;
  }
  MatOf& operator-=(const MatOf& b) & {
    for (int i = 0; i < Rows * Cols; ++i) c_[i] -= b.c_[i];
    return *this;
  }
  MatOf& operator*=(S b) & {
    for (S& x : c_) x *= b;
    return *this;
  }
  /// @}
  /// @cond
  friend MatOf operator+(MatOf a, const MatOf& b) { return a += b; }
  friend MatOf operator-(MatOf a, const MatOf& b) { return a -= b; }
  friend MatOf operator-(MatOf a) { return a *= S(-1.0); }
  friend MatOf operator*(MatOf a, const S& b) { return a *= b; }
  friend MatOf operator*(const S& a, MatOf b) { return b *= a; }
  friend MatOf operator/(MatOf a, const S& b) {
    for (S& x : a.c_) x /= b;
    return a;
  }
  /// @endcond

 private:
  S c_[Rows * Cols];
};

/// A matrix of numbers.
template <int Rows, int Cols>
using Mat = MatOf<double, Rows, Cols>;

namespace detail {
/// A row times a column: a number, and as in Eigen a matrix of one.
template <class S>
struct InnerProduct : VecOf<S, 1> {
  using VecOf<S, 1>::VecOf;
  operator S() const { return this->data()[0]; }  // NOLINT(google-explicit-constructor)
};
template <class S>
inline constexpr bool is_vector<InnerProduct<S>> = true;

template <class R, int Rows, class M, class X>
DALEMBERT_INLINE auto times(const M& m, const X& x, int n) {
  std::conditional_t<Rows == 1, InnerProduct<R>, VecOf<R, Rows>> r;
  DALEMBERT_UNROLL for (int i = 0; i < Rows; ++i) {
    r[i] = m(i, 0) * x[0];
    for (int k = 1; k < n; ++k) r[i] += m(i, k) * x[k];
  }
  return r;
}
}  // namespace detail

template <class S, int N>
MatOf<S, 1, N> VecOf<S, N>::transpose() const {
  MatOf<S, 1, N> r;
  for (int k = 0; k < N; ++k) r[k] = at(k);
  return r;
}

/// @{
/// Products.
template <class A, int Rows, int N, class S>
auto operator*(const MatOf<A, Rows, N>& m, const VecOf<S, N>& x) {
  return detail::times<std::remove_cvref_t<decltype(m(0, 0) * x[0])>, Rows>(m, x, N);
}
template <class A, int Rows, int N, class B, int Cols>
auto operator*(const MatOf<A, Rows, N>& a, const MatOf<B, N, Cols>& b) {
  MatOf<std::remove_cvref_t<decltype(a(0, 0) * b(0, 0))>, Rows, Cols> r;
  for (int k = 0; k < Cols; ++k)
    for (int i = 0; i < Rows; ++i) {
      r(i, k) = a(i, 0) * b(0, k);
      for (int j = 1; j < N; ++j) r(i, k) += a(i, j) * b(j, k);
    }
  return r;
}
template <class A, int N, class B, int Cols>
auto operator*(const VecOf<A, N>& a, const MatOf<B, 1, Cols>& b) {
  MatOf<std::remove_cvref_t<decltype(a[0] * b(0, 0))>, N, Cols> r;
  for (int k = 0; k < Cols; ++k)
    for (int i = 0; i < N; ++i) r(i, k) = a[i] * b(0, k);
  return r;
}
/// @}

/// @{
/// With what is of Eigen and of fixed size: products of matrices, a matrix times a vector, a column times a
/// row, and a rotation or another transformation of space.
template <detail::OfEigen M, class S, int N>
  requires(M::ColsAtCompileTime == N && M::RowsAtCompileTime > 0)
auto operator*(const M& matrix, const VecOf<S, N>& x) {
  const auto& m = matrix.eval();
  return detail::times<std::remove_cvref_t<decltype(m(0, 0) * x[0])>, M::RowsAtCompileTime>(m, x, N);
}
template <detail::OfEigen M, class S, int Rows, int Cols>
  requires(M::ColsAtCompileTime == Rows && M::RowsAtCompileTime > 0)
auto operator*(const M& a, const MatOf<S, Rows, Cols>& b) {
  return MatOf<typename M::Scalar, M::RowsAtCompileTime, Rows>(a) * b;
}
template <class S, int Rows, int Cols, detail::OfEigen M>
  requires(M::RowsAtCompileTime == Cols && M::ColsAtCompileTime > 0)
auto operator*(const MatOf<S, Rows, Cols>& a, const M& b) {
  if constexpr (M::ColsAtCompileTime == 1) {
    return a * VecOf<typename M::Scalar, Cols>(b);
  } else {
    return a * MatOf<typename M::Scalar, Cols, M::ColsAtCompileTime>(b);
  }
}
template <class S, int N, detail::OfEigen M>
  requires(M::RowsAtCompileTime == 1 && M::ColsAtCompileTime > 1)
auto operator*(const VecOf<S, N>& x, const M& row) {
  return x * MatOf<typename M::Scalar, 1, M::ColsAtCompileTime>(row);
}
template <class T, class S, int N>
  requires(!detail::OfEigen<T> && T::Dim == N && requires { typename T::Scalar; })
auto operator*(const T& transformation, const VecOf<S, N>& x) {
  return VecOf<S, N>(transformation * Eigen::Matrix<S, N, 1, 0, N, 1>(x));
}
template <class E, class S, int N>
requires detail::MaybeColumnOfEigen<std::remove_cvref_t<E>, N> E& operator+=(E&& a, const VecOf<S, N>& b) {
  assert(a.size() == N);
  for (int i = 0; i < N; ++i) a.coeffRef(i) += b[i];
  return a;
}
template <class E, class S, int N>
requires detail::MaybeColumnOfEigen<std::remove_cvref_t<E>, N> E& operator-=(E&& a, const VecOf<S, N>& b) {
  assert(a.size() == N);
  for (int i = 0; i < N; ++i) a.coeffRef(i) -= b[i];
  return a;
}
/// @}

/// @{
/// `m << r, s;`
template <class E, class S, int N>
  requires detail::OfEigen<std::remove_cvref_t<E>>
auto operator<<(E&& m, const VecOf<S, N>& first) { return m << Eigen::Matrix<S, N, 1, 0, N, 1>(first); }
template <class E, class S, int N>
auto& operator,(Eigen::CommaInitializer<E>& begun, const VecOf<S, N>& next) {
  return begun, Eigen::Matrix<S, N, 1, 0, N, 1>(next);
}
template <class E, class S, int N>
auto& operator,(Eigen::CommaInitializer<E>&& begun, const VecOf<S, N>& next) {
  return begun, Eigen::Matrix<S, N, 1, 0, N, 1>(next);
}
/// @}

/// @{
/// As Eigen prints them: a number after the other down a column, and along a row.
template <class Traits, int N>
std::basic_ostream<char, Traits>& operator<<(std::basic_ostream<char, Traits>& out,
                                             const VecOf<double, N>& x) {
  detail::print(out, x.data(), N, 1);
  return out;
}
template <class Traits, int Rows, int Cols>
std::basic_ostream<char, Traits>& operator<<(std::basic_ostream<char, Traits>& out,
                                             const MatOf<double, Rows, Cols>& m) {
  detail::print(out, m.data(), Rows, Cols);
  return out;
}
/// @}

}  // namespace dalembert
