#pragma once

#include <dalembert/core/linear/dense.h>

#include <concepts>

namespace dalembert {

/// Products of whole dense matrices and vectors: with this header `A * B`, `A.transpose() * B` and
/// `A * B.transpose()` call functions that are compiled once (dense.h). Eigen's own product takes up to half
/// a second to compile, wherever it stands, and is left to blocks and other expressions.
namespace products {
template <class T, class... Of>
concept OneOf = (std::same_as<T, Of> || ...);
template <class T>
concept Matrix = OneOf<T, Eigen::MatrixXd, Eigen::MatrixXcd>;
template <class T>
concept Factor = Matrix<T> || OneOf<T, Eigen::VectorXd, Eigen::VectorXcd>;
template <class T>
concept Transposed = OneOf<T, Eigen::Transpose<Eigen::MatrixXd>, Eigen::Transpose<const Eigen::MatrixXd>>;
}  // namespace products

[[nodiscard]] auto operator*(const products::Matrix auto& A, const products::Factor auto& B) {
  return dense::product(A, B);
}
[[nodiscard]] auto operator*(const products::Transposed auto& A, const products::Factor auto& B) {
  return dense::transposed_product(A.nestedExpression(), B);
}
[[nodiscard]] auto operator*(const products::Matrix auto& A, const products::Transposed auto& B) {
  return dense::product_transposed(A, B.nestedExpression());
}

}  // namespace dalembert
