#pragma once

#include <dalembert/core/linear/dense.h>

#include <concepts>

namespace dalembert {

/// Products of whole dense matrices and vectors. With this header `A * B`, `A.transpose() * B` and
/// `A * B.transpose()` call functions that are compiled once (dense.h): Eigen's own product takes up to half
/// a second to compile wherever it stands. Blocks and other expressions are left to Eigen. The result is a
/// matrix of its own, even behind `noalias`: code that must not allocate leaves this header out.
namespace products {
template <class T, class... Of>
concept OneOf = (std::same_as<T, Of> || ...);
template <class T>
concept Real = OneOf<T, Eigen::MatrixXd, Eigen::VectorXd>;
template <class T>
concept Factor = Real<T> || OneOf<T, Eigen::MatrixXcd, Eigen::VectorXcd>;
template <class T>
concept Transposed = OneOf<T, Eigen::Transpose<Eigen::MatrixXd>, Eigen::Transpose<const Eigen::MatrixXd>>;
}  // namespace products

template <std::same_as<Eigen::MatrixXd> Matrix, products::Factor Other>
[[nodiscard]] auto operator*(const Matrix& A, const Other& B) {
  return dense::product(A, B);
}
template <products::Transposed Matrix, products::Real Other>
[[nodiscard]] auto operator*(const Matrix& A, const Other& B) {
  return dense::transposed_product(A.nestedExpression(), B);
}
template <std::same_as<Eigen::MatrixXd> Matrix, products::Transposed Other>
[[nodiscard]] auto operator*(const Matrix& A, const Other& B) {
  return dense::product_transposed(A, B.nestedExpression());
}

}  // namespace dalembert
