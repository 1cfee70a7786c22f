#pragma once

#include <dalembert/core/autodiff/derivatives.h>

#include <Eigen/Core>

/// For programs that use Eigen. Vectors and matrices of the library become Eigen's, and Eigen's become the
/// library's, without this header; it is for what the compiler does not convert by itself.
/// Include it before the first equation: Eigen asks for the properties of numbers with derivatives once.
namespace dalembert {

/// @{
/// As one of Eigen's, for the functions of Eigen's vectors, and to write to a part of one:
/// `n.dot(eigen(r - p))`, `m.col(0) = eigen(run.position(bob, i))`.
template <class S, int N>
[[nodiscard]] Eigen::Matrix<S, N, 1> eigen(const VecOf<S, N>& x) {
  return x;
}
template <class S, int Rows, int Cols>
[[nodiscard]] Eigen::Matrix<S, Rows, Cols> eigen(const MatOf<S, Rows, Cols>& m) {
  return m;
}
/// @}

}  // namespace dalembert

namespace Eigen {

/// @cond
// Matrices of numbers that carry derivatives.
template <dalembert::Differentiated S>
struct NumTraits<S> : NumTraits<double> {
  using Real = S;
  using NonInteger = S;
  using Nested = S;
  using Literal = S;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 8,
    AddCost = 16,
    MulCost = 32
  };
};
/// @endcond
template <dalembert::Differentiated S, class Op>
struct ScalarBinaryOpTraits<S, double, Op> {
  using ReturnType = S;
};
template <dalembert::Differentiated S, class Op>
struct ScalarBinaryOpTraits<double, S, Op> {
  using ReturnType = S;
};

}  // namespace Eigen
