#include "dalembert/solvers/linear/dense.h"

#include <Eigen/LU>
#include <Eigen/QR>

namespace dalembert::dense {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

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
