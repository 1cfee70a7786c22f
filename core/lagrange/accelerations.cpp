#include "dalembert/core/lagrange/accelerations.h"

#include <dalembert/core/analysis/rank.h>

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace dalembert::detail {

namespace {

/// Entries of M are known to some roundings each, and elimination adds one for each row: a pivot below this
/// many for each row is 0. (A larger number rejects what is as many roundings from singular, where
/// accelerations have no digits.)
constexpr double elimination = 16.0 * std::numeric_limits<double>::epsilon();

/// Of each coordinate the unit in which the inertia of its row is 1.
SmallVector units(const SmallMatrix& M) {
  SmallVector unit(M.rows());
  for (Eigen::Index i = 0; i < M.rows(); ++i) {
    const double inertia = M.row(i).cwiseAbs().maxCoeff();
    unit[i] = inertia > 0.0 ? 1.0 / std::sqrt(inertia) : 1.0;
  }
  return unit;
}

}  // namespace

Accelerations accelerations(const SmallMatrix& M, const SmallVector& f, const SmallMatrix& A,
                            const SmallVector& gamma) {
  const Eigen::Index n = M.rows();
  const SmallVector unit = units(M);
  const SmallMatrix scaled = unit.asDiagonal() * M * unit.asDiagonal();
  SmallMatrix Q = SmallMatrix::Identity(n, n);
  SmallVector a = SmallVector::Zero(n);
  Eigen::Index rank = 0;
  if (A.rows() > 0) {
    SmallMatrix columns = unit.asDiagonal() * A.transpose();
    SmallVector bias = gamma;
    for (Eigen::Index r = 0; r < columns.cols(); ++r) {
      const double length = columns.col(r).norm();
      if (length == 0.0) continue;
      columns.col(r) /= length;
      bias[r] /= length;
    }
    Eigen::ColPivHouseholderQR<SmallMatrix> qr(columns.rows(), columns.cols());
    qr.setThreshold(rank_threshold);
    qr.compute(columns);
    rank = qr.rank();
    Q = qr.householderQ();
    const SmallVector first = -(qr.colsPermutation().transpose() * bias).head(rank);
    a = Q.leftCols(rank) * qr.matrixR()
                               .topLeftCorner(rank, rank)
                               .transpose()
                               .template triangularView<Eigen::Lower>()
                               .solve(first);
  }
  if (rank < n) {
    const SmallMatrix Z = Q.rightCols(n - rank), inertia = Z.transpose() * scaled * Z;
    Eigen::FullPivLU<SmallMatrix> lu(n - rank, n - rank);
    lu.setThreshold(elimination * static_cast<double>(n));
    lu.compute(inertia);
    if (!lu.isInvertible()) {
      const SmallMatrix kernel = lu.kernel();
      const SmallVector direction = Z * kernel.col(0);
      return {a, unit.asDiagonal() * direction, 0};
    }
    const SmallVector rest = Z.transpose() * (unit.asDiagonal() * f - scaled * a);
    const SmallVector z = lu.solve(rest);
    a += Z * z;
    return {unit.asDiagonal() * a, {}, lu.determinant() < 0.0 ? -1 : 1};
  }
  return {unit.asDiagonal() * a, {}, 1};
}

SolvedMultipliers multipliers(const SmallMatrix& A, const SmallVector& r) {
  if (A.rows() == 0) return {SmallVector(0), 1.0, 0};
  SmallMatrix columns = A.transpose();
  SmallVector length(A.rows());
  for (Eigen::Index k = 0; k < A.rows(); ++k) {
    length[k] = columns.col(k).norm();
    if (length[k] > 0.0) columns.col(k) /= length[k];
  }
  Eigen::CompleteOrthogonalDecomposition<SmallMatrix> qr(columns.rows(), columns.cols());
  qr.setThreshold(rank_threshold);
  qr.compute(columns);
  SolvedMultipliers found{qr.solve(r), 1.0, qr.rank()};
  for (Eigen::Index k = 0; k < found.rank; ++k)
    found.sine = std::min(found.sine, std::abs(qr.matrixQTZ()(k, k)));
  for (Eigen::Index k = 0; k < A.rows(); ++k)
    found.lambda[k] = length[k] > 0.0 ? found.lambda[k] / length[k] : 0.0;
  return found;
}

Rows rows_of(const System& constraints, const Instant& at) {
  const auto m = static_cast<Eigen::Index>(constraints.rows()),
             n = static_cast<Eigen::Index>(constraints.coordinates());
  auto e = constraints.evaluation();
  std::vector<double> bias(constraints.rows());
  constraints.evaluate_with_bias(at, e, bias);
  Rows rows{SmallMatrix::Zero(m, n), Eigen::Map<const Eigen::VectorXd>(bias.data(), m)};
  for (std::size_t r = 0; r < bias.size(); ++r) {
    for (const std::size_t k : constraints.row(r))
      rows.A(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(constraints.w_columns()[k])) += e.w[k];
  }
  return rows;
}

namespace {
const Eigen::IOFormat in_a_row(6, Eigen::DontAlignCols, ", ", ", ");
}

std::string no_inertia(const SmallVector& q, const SmallVector& direction) {
  std::ostringstream what;
  what << "gives no acceleration: d^2L/dv^2 is singular at q = (" << q.transpose().format(in_a_row)
       << "), motion along (" << (direction / direction.cwiseAbs().maxCoeff()).transpose().format(in_a_row)
       << ") has no inertia; give it some, constrain it, or choose other coordinates";
  return what.str();
}

std::string inertia_lost(const SmallVector& q) {
  std::ostringstream what;
  what << "gives no motion to q = (" << q.transpose().format(in_a_row)
       << "): on the way there d^2L/dv^2 is singular and accelerations are unbounded; end the run before, or "
          "choose other coordinates";
  return what.str();
}

}  // namespace dalembert::detail
