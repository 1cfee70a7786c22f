#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <Eigen/SparseCore>

#include <complex>
#include <memory>

namespace DALEMBERT_HIDDEN dalembert {

/// A sparse complex matrix, factored once by SuiteSparse's KLU.
class ComplexLU {
 public:
  using Matrix = Eigen::SparseMatrix<std::complex<double>>;

  explicit ComplexLU(Matrix A);
  ComplexLU(ComplexLU&&) noexcept;
  ~ComplexLU();

  /// False if a pivot vanishes; then nothing can be solved.
  [[nodiscard]] bool regular() const;
  /// A x = b.
  [[nodiscard]] Eigen::VectorXcd solve(Eigen::VectorXcd b) const;
  /// A^H x = b.
  [[nodiscard]] Eigen::VectorXcd solve_adjoint(Eigen::VectorXcd b) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace dalembert
