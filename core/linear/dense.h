#pragma once

#include <Eigen/Core>

#include <memory>
#include <span>

namespace dalembert {
/// Products and decompositions of dense matrices by Eigen: each takes up to some seconds to compile, here
/// once.
namespace dense {

/// A B; A^T B; A B^T; and N^T X N, X restricted to the span of the columns of N. As operators: products.h.
[[nodiscard]] Eigen::MatrixXd product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
[[nodiscard]] Eigen::VectorXd product(const Eigen::MatrixXd& A, const Eigen::VectorXd& x);
[[nodiscard]] Eigen::MatrixXcd product(const Eigen::MatrixXd& A, const Eigen::MatrixXcd& B);
[[nodiscard]] Eigen::VectorXcd product(const Eigen::MatrixXd& A, const Eigen::VectorXcd& x);
[[nodiscard]] Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
[[nodiscard]] Eigen::VectorXd transposed_product(const Eigen::MatrixXd& A, const Eigen::VectorXd& x);
[[nodiscard]] Eigen::MatrixXd product_transposed(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
[[nodiscard]] Eigen::MatrixXcd adjoint_product(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B);
[[nodiscard]] Eigen::MatrixXd restricted(const Eigen::MatrixXd& N, const Eigen::MatrixXd& X);
/// A, then B, below each other.
[[nodiscard]] Eigen::MatrixXd below(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
/// Beside each other.
[[nodiscard]] Eigen::MatrixXd beside(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
/// Each absolute value.
[[nodiscard]] Eigen::MatrixXd sizes(const Eigen::MatrixXd& A);

/// Eigenvalues, increasing, and orthonormal eigenvectors of a symmetric matrix.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
[[nodiscard]] SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& A);

/// Those of any square matrix; eigenvectors of length 1.
struct ComplexEigen {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};
[[nodiscard]] ComplexEigen complex_eigen(const Eigen::MatrixXd& A);
[[nodiscard]] Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A);

/// A = U T U^H with T upper triangular and |t_11| >= |t_22| >= ...: the first columns of U span an invariant
/// subspace each.
struct Schur {
  Eigen::MatrixXcd T, U;
};
[[nodiscard]] Schur ordered_schur(const Eigen::MatrixXd& A);
/// An orthonormal basis of the span of some columns, of known rank.
[[nodiscard]] Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns, Eigen::Index rank);

/// The shortest x of those for which |A x - b| is least; what makes a smaller part of A's largest pivot than
/// `threshold` counts as dependent.
[[nodiscard]] Eigen::MatrixXd least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b,
                                            double threshold);

/// A x = b of a regular matrix.
[[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b);
[[nodiscard]] Eigen::VectorXcd solve(const Eigen::MatrixXcd& A, const Eigen::VectorXcd& b);
[[nodiscard]] Eigen::MatrixXcd inverse(const Eigen::MatrixXcd& A);

/// A P = Q R Z by Householder's reflections with pivoting of columns: what makes a smaller part of A's
/// largest pivot than `threshold` counts as dependent on the columns before it.
class OrthogonalDecomposition {
 public:
  OrthogonalDecomposition();
  OrthogonalDecomposition(const Eigen::MatrixXd& A, double threshold);
  OrthogonalDecomposition(OrthogonalDecomposition&&) noexcept;
  OrthogonalDecomposition& operator=(OrthogonalDecomposition&&) noexcept;
  ~OrthogonalDecomposition();

  void compute(const Eigen::MatrixXd& A, double threshold);

  [[nodiscard]] Eigen::Index rank() const;
  /// The columns' numbers in the order in which they were taken: `rank()` independent ones first.
  [[nodiscard]] std::span<const int> order() const;
  /// Of the column taken as the k-th, the length across those before it.
  [[nodiscard]] double pivot(Eigen::Index k) const;
  /// A square matrix: `rank()` orthonormal columns that span A's, and those across them.
  [[nodiscard]] Eigen::MatrixXd Q() const;
  /// The shortest x of those for which |A x - b| is least.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  /// The shortest of those x for which |A^T x - b| is least.
  [[nodiscard]] Eigen::VectorXd solve_transposed(const Eigen::VectorXd& b) const;
  /// `solve` as a matrix.
  [[nodiscard]] Eigen::MatrixXd pseudo_inverse() const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

/// P A Q = L U with pivoting of rows and columns: a pivot that is a smaller part of the largest than
/// `threshold` counts as 0.
class TriangularDecomposition {
 public:
  TriangularDecomposition(const Eigen::MatrixXd& A, double threshold);
  TriangularDecomposition(TriangularDecomposition&&) noexcept;
  TriangularDecomposition& operator=(TriangularDecomposition&&) noexcept;
  ~TriangularDecomposition();

  [[nodiscard]] bool regular() const;
  /// A basis of A x = 0; no columns where A is regular.
  [[nodiscard]] Eigen::MatrixXd kernel() const;
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  [[nodiscard]] double determinant() const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

/// A basis of A x = 0, as far as can be told to `threshold`.
[[nodiscard]] Eigen::MatrixXd kernel(const Eigen::MatrixXd& A, double threshold);
/// Orthonormal columns that span those x for which A x is not 0, as far as can be told to the root of
/// `threshold`.
[[nodiscard]] Eigen::MatrixXd row_space(const Eigen::MatrixXd& A, double threshold);
/// The same as `kernel` of numbers known to `round_off`, however small the largest of them is.
[[nodiscard]] Eigen::MatrixXd kernel_within(const Eigen::MatrixXd& A, double round_off);

}  // namespace dense
}  // namespace dalembert
