#include "dalembert/core/linear/dense.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <complex>

namespace dalembert::dense {

using Eigen::MatrixXd;
using Eigen::VectorXcd;

SymmetricEigen symmetric_eigen(const MatrixXd& A) {
  if (A.size() == 0) return {Eigen::VectorXd(0), MatrixXd(0, 0)};
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

ComplexEigen complex_eigen(const MatrixXd& A) {
  const Eigen::EigenSolver<MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

VectorXcd eigenvalues(const MatrixXd& A) { return Eigen::EigenSolver<MatrixXd>(A, false).eigenvalues(); }

/// Neighbours on the diagonal change places by one rotation (LAPACK's ztrexc).
Schur ordered_schur(const MatrixXd& A) {
  const Eigen::ComplexSchur<MatrixXd> schur(A);
  Schur s{schur.matrixT(), schur.matrixU()};
  const Eigen::Index n = A.rows();
  for (Eigen::Index sorted = 1; sorted < n; ++sorted) {
    for (Eigen::Index k = sorted; k > 0 && std::abs(s.T(k, k)) > std::abs(s.T(k - 1, k - 1)); --k) {
      const std::complex<double> first = s.T(k - 1, k - 1), second = s.T(k, k);
      Eigen::JacobiRotation<std::complex<double>> rotation;
      rotation.makeGivens(s.T(k - 1, k), second - first);
      s.T.applyOnTheLeft(k - 1, k, rotation.adjoint());
      s.T.applyOnTheRight(k - 1, k, rotation);
      s.U.applyOnTheRight(k - 1, k, rotation);
      s.T(k, k - 1) = 0.0;
      s.T(k - 1, k - 1) = second;
      s.T(k, k) = first;
    }
  }
  return s;
}

}  // namespace dalembert::dense
