#include "dalembert/core/lagrange/accelerations.h"

#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/linear/dense.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace dalembert::detail {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd vector(std::span<const double> x) {
  return Eigen::Map<const VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}
/// The rows of constraints as columns.
MatrixXd columns_of(const ConstraintRows& rows, Eigen::Index coordinates) {
  return Eigen::Map<const MatrixXd>(rows.A.data(), coordinates, rows.count());
}
Accelerations found(const VectorXd& a, bool determined, int sign) {
  Accelerations result{.a = {}, .determined = determined, .sign = sign};
  std::copy_n(a.data(), a.size(), result.a.begin());
  return result;
}

/// Entries of M are known to some roundings each, and elimination adds one for each row: a pivot below this
/// many for each row is 0. (A larger number rejects what is as many roundings from singular, where
/// accelerations have no digits.)
constexpr double elimination = 16.0 * std::numeric_limits<double>::epsilon();

/// Of each coordinate the unit in which the inertia of its row is 1.
VectorXd units(const MatrixXd& M) {
  VectorXd unit(M.rows());
  for (Eigen::Index i = 0; i < M.rows(); ++i) {
    const double inertia = M.row(i).cwiseAbs().maxCoeff();
    unit[i] = inertia > 0.0 ? 1.0 / std::sqrt(inertia) : 1.0;
  }
  return unit;
}

}  // namespace

Accelerations accelerations(std::span<const double> inertia_of_all, std::span<const double> force,
                            const ConstraintRows& rows) {
  const auto n = static_cast<Eigen::Index>(force.size());
  const MatrixXd M = Eigen::Map<const MatrixXd>(inertia_of_all.data(), n, n);
  const VectorXd f = vector(force);
  const VectorXd unit = units(M);
  const MatrixXd scaled = unit.asDiagonal() * M * unit.asDiagonal();
  MatrixXd Q = MatrixXd::Identity(n, n);
  VectorXd a = VectorXd::Zero(n);
  Eigen::Index rank = 0;
  if (rows.count() > 0) {
    MatrixXd columns = unit.asDiagonal() * columns_of(rows, n);
    VectorXd bias = vector(rows.gamma);
    for (Eigen::Index r = 0; r < columns.cols(); ++r) {
      const double length = columns.col(r).norm();
      if (length == 0.0) continue;
      columns.col(r) /= length;
      bias[r] /= length;
    }
    const dense::OrthogonalDecomposition qr(columns, rank_threshold);
    rank = qr.rank();
    Q = qr.Q();
    a = -qr.solve_transposed(bias);
  }
  if (rank < n) {
    const MatrixXd Z = Q.rightCols(n - rank);
    const dense::TriangularDecomposition inertia(dense::restricted(Z, scaled),
                                                 elimination * static_cast<double>(n));
    if (!inertia.regular()) {
      const VectorXd direction = Z * inertia.kernel().col(0);
      return found(unit.asDiagonal() * direction, false, 0);
    }
    const VectorXd rest = unit.asDiagonal() * f - scaled * a;
    a += Z * inertia.solve(Z.transpose() * rest);
    return found(unit.asDiagonal() * a, true, inertia.determinant() < 0.0 ? -1 : 1);
  }
  return found(unit.asDiagonal() * a, true, 1);
}

SolvedMultipliers multipliers(const ConstraintRows& rows, std::span<const double> r) {
  if (rows.count() == 0) return {{}, 1.0, 0};
  MatrixXd columns = columns_of(rows, static_cast<Eigen::Index>(r.size()));
  VectorXd length(rows.count());
  for (Eigen::Index k = 0; k < rows.count(); ++k) {
    length[k] = columns.col(k).norm();
    if (length[k] > 0.0) columns.col(k) /= length[k];
  }
  const dense::OrthogonalDecomposition qr(columns, rank_threshold);
  SolvedMultipliers solved{{}, 1.0, static_cast<int>(qr.rank())};
  for (Eigen::Index k = 0; k < qr.rank(); ++k) solved.sine = std::min(solved.sine, qr.pivot(k));
  const VectorXd lambda = qr.solve(vector(r));
  for (Eigen::Index k = 0; k < rows.count(); ++k)
    solved.lambda.push_back(length[k] > 0.0 ? lambda[k] / length[k] : 0.0);
  return solved;
}

ConstraintRows rows_of(const System& constraints, const Instant& at) {
  const std::size_t m = constraints.rows(), n = constraints.coordinates();
  auto e = constraints.evaluation();
  ConstraintRows rows{std::vector<double>(m * n), std::vector<double>(m)};
  constraints.evaluate_with_bias(at, e, rows.gamma);
  for (std::size_t r = 0; r < m; ++r) {
    for (const std::size_t k : constraints.row(r))
      rows.A[r * n + static_cast<std::size_t>(constraints.w_columns()[k])] += e.w[k];
  }
  return rows;
}

namespace {
std::string in_a_row(std::span<const double> x, double unit = 1.0) {
  std::ostringstream all;
  for (std::size_t k = 0; k < x.size(); ++k) all << (k == 0 ? "" : ", ") << x[k] / unit;
  return all.str();
}
}  // namespace

std::string no_inertia(std::span<const double> q, std::span<const double> direction) {
  std::ostringstream what;
  what << "gives no acceleration: d^2L/dv^2 is singular at q = (" << in_a_row(q) << "), motion along ("
       << in_a_row(direction, vector(direction).cwiseAbs().maxCoeff())
       << ") has no inertia; give it some, constrain it, or choose other coordinates";
  return what.str();
}

std::string inertia_lost(std::span<const double> q) {
  std::ostringstream what;
  what << "gives no motion to q = (" << in_a_row(q)
       << "): on the way there d^2L/dv^2 is singular and accelerations are unbounded; end the run before, or "
          "choose other coordinates";
  return what.str();
}

}  // namespace dalembert::detail
