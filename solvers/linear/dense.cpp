#include "dalembert/solvers/linear/dense.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include <cmath>
#include <complex>

namespace dalembert::dense {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

MatrixXd product(const MatrixXd& A, const MatrixXd& B) { return A * B; }
VectorXd product(const MatrixXd& A, const VectorXd& x) { return A * x; }
MatrixXcd product(const MatrixXd& A, const MatrixXcd& B) { return A * B; }
VectorXcd product(const MatrixXd& A, const VectorXcd& x) { return A * x; }
MatrixXd transposed_product(const MatrixXd& A, const MatrixXd& B) { return A.transpose() * B; }
MatrixXcd adjoint_product(const MatrixXcd& A, const MatrixXcd& B) { return A.adjoint() * B; }
MatrixXd restricted(const MatrixXd& N, const MatrixXd& X) { return transposed_product(N, X) * N; }
MatrixXd below(const MatrixXd& A, const MatrixXd& B) {
  MatrixXd both(A.rows() + B.rows(), A.cols());
  both << A, B;
  return both;
}
MatrixXd beside(const MatrixXd& A, const MatrixXd& B) {
  MatrixXd both(A.rows(), A.cols() + B.cols());
  both << A, B;
  return both;
}
MatrixXd sizes(const MatrixXd& A) { return A.cwiseAbs(); }

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

MatrixXd orthonormal(const MatrixXd& columns, Eigen::Index rank) {
  return Eigen::ColPivHouseholderQR<MatrixXd>(columns).householderQ() *
         MatrixXd::Identity(columns.rows(), rank);
}

MatrixXd least_squares(const MatrixXd& A, const MatrixXd& b, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> qr(A.rows(), A.cols());
  qr.setThreshold(threshold);
  qr.compute(A);
  return qr.solve(b);
}

MatrixXd solve(const MatrixXd& A, const MatrixXd& b) { return A.partialPivLu().solve(b); }
VectorXcd solve(const MatrixXcd& A, const VectorXcd& b) { return A.partialPivLu().solve(b); }
MatrixXcd inverse(const MatrixXcd& A) { return A.inverse(); }

MatrixXd kernel(const MatrixXd& A, double threshold) {
  if (A.cols() == 0 || A.isZero(0.0)) return MatrixXd::Identity(A.cols(), A.cols());
  Eigen::FullPivLU<MatrixXd> lu(A.rows(), A.cols());
  lu.setThreshold(threshold);
  lu.compute(A);
  if (lu.dimensionOfKernel() == 0) return MatrixXd(A.cols(), 0);
  return lu.kernel();
}

MatrixXd row_space(const MatrixXd& A, double threshold) {
  const auto its = symmetric_eigen(A.transpose() * A);
  if (its.values.size() == 0) return its.vectors;
  const double least = threshold * its.values.maxCoeff();
  return its.vectors.rightCols((its.values.array() > least).count());
}

MatrixXd kernel_within(const MatrixXd& A, double round_off) {
  const double most = A.size() > 0 ? A.cwiseAbs().maxCoeff() : 0.0;
  return most > round_off ? kernel(A, round_off / most) : MatrixXd::Identity(A.cols(), A.cols());
}

}  // namespace dalembert::dense
