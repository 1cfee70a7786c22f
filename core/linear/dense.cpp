#include "dalembert/core/linear/dense.h"

#include <Eigen/LU>
#include <Eigen/QR>

#include <cmath>

namespace dalembert::dense {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

struct OrthogonalDecomposition::Factors {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> qr;
};

OrthogonalDecomposition::OrthogonalDecomposition() : factors_(std::make_unique<Factors>()) {}
OrthogonalDecomposition::OrthogonalDecomposition(const MatrixXd& A, double threshold)
    : OrthogonalDecomposition() {
  compute(A, threshold);
}
OrthogonalDecomposition::OrthogonalDecomposition(OrthogonalDecomposition&&) noexcept = default;
OrthogonalDecomposition& OrthogonalDecomposition::operator=(OrthogonalDecomposition&&) noexcept = default;
OrthogonalDecomposition::~OrthogonalDecomposition() = default;

void OrthogonalDecomposition::compute(const MatrixXd& A, double threshold) {
  factors_->qr.setThreshold(threshold);
  factors_->qr.compute(A);
}

Eigen::Index OrthogonalDecomposition::rank() const { return factors_->qr.rank(); }

std::span<const int> OrthogonalDecomposition::order() const {
  const auto& order = factors_->qr.colsPermutation().indices();
  return {order.data(), static_cast<std::size_t>(order.size())};
}

double OrthogonalDecomposition::pivot(Eigen::Index k) const {
  return std::abs(factors_->qr.matrixQTZ()(k, k));
}

MatrixXd OrthogonalDecomposition::Q() const { return factors_->qr.householderQ(); }

MatrixXd OrthogonalDecomposition::solve(const MatrixXd& b) const { return factors_->qr.solve(b); }

VectorXd OrthogonalDecomposition::solve_transposed(const VectorXd& b) const {
  return factors_->qr.transpose().solve(b);
}

MatrixXd OrthogonalDecomposition::pseudo_inverse() const { return factors_->qr.pseudoInverse(); }

struct TriangularDecomposition::Factors {
  Eigen::FullPivLU<MatrixXd> lu;
};

TriangularDecomposition::TriangularDecomposition(const MatrixXd& A, double threshold)
    : factors_(std::make_unique<Factors>()) {
  factors_->lu.setThreshold(threshold);
  factors_->lu.compute(A);
}
TriangularDecomposition::TriangularDecomposition(TriangularDecomposition&&) noexcept = default;
TriangularDecomposition& TriangularDecomposition::operator=(TriangularDecomposition&&) noexcept = default;
TriangularDecomposition::~TriangularDecomposition() = default;

bool TriangularDecomposition::regular() const { return factors_->lu.isInvertible(); }
MatrixXd TriangularDecomposition::kernel() const {
  const auto& lu = factors_->lu;
  return lu.dimensionOfKernel() == 0 ? MatrixXd(lu.cols(), 0) : MatrixXd(lu.kernel());
}
VectorXd TriangularDecomposition::solve(const VectorXd& b) const { return factors_->lu.solve(b); }
double TriangularDecomposition::determinant() const { return factors_->lu.determinant(); }

MatrixXd orthonormal(const MatrixXd& columns, Eigen::Index rank) {
  return OrthogonalDecomposition(columns, 0.0).Q().leftCols(rank);
}

MatrixXd least_squares(const MatrixXd& A, const MatrixXd& b, double threshold) {
  return OrthogonalDecomposition(A, threshold).solve(b);
}

MatrixXd solve(const MatrixXd& A, const MatrixXd& b) { return A.partialPivLu().solve(b); }
VectorXcd solve(const MatrixXcd& A, const VectorXcd& b) { return A.partialPivLu().solve(b); }
MatrixXcd inverse(const MatrixXcd& A) { return A.inverse(); }

MatrixXd kernel(const MatrixXd& A, double threshold) {
  if (A.cols() == 0 || A.isZero(0.0)) return MatrixXd::Identity(A.cols(), A.cols());
  return TriangularDecomposition(A, threshold).kernel();
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
