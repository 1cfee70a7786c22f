#include "dalembert/solvers/equilibrium/singular_position.h"

#include <dalembert/core/analysis/rank.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// -sum mu g_qq in the mass metric. (Of the constraints alone: as a difference of stiffnesses it would be
/// known to round-off of that of the forces, which has another unit.)
MatrixXd curvature_by(const System& system, const Instant& at, std::span<const double> mu) {
  auto slopes = system.linearisation();
  system.linearise_constraints(at, mu, slopes);
  const auto n = static_cast<Index>(system.coordinates());
  MatrixXd K = MatrixXd::Zero(n, n);
  for (std::size_t k = 0; k < system.stiffness_of_constraints(); ++k) {
    const auto [row, column] = system.stiffness_pattern()[k];
    K(static_cast<Index>(row), static_cast<Index>(column)) -=
        slopes.stiffness[k] / std::sqrt(system.masses()[row] * system.masses()[column]);
  }
  return K;
}

}  // namespace

bool is_singular_position(const System& system, const Instant& at) {
  auto e = system.evaluation();
  system.evaluate(at, e);
  if (independent_rows(system, e.w).size() == system.rows()) return false;
  std::vector<std::size_t> rigid;
  for (std::size_t r = 0; r < system.holonomic_rows(); ++r)
    if (!system.law(r).compliant()) rigid.push_back(r);
  MatrixXd W = MatrixXd::Zero(static_cast<Index>(rigid.size()), static_cast<Index>(system.coordinates()));
  Eigen::VectorXd length(W.rows());
  for (Index k = 0; k < W.rows(); ++k) {
    for (const std::size_t place : system.row(rigid[static_cast<std::size_t>(k)])) {
      const std::size_t i = system.w_columns()[place];
      W(k, static_cast<Index>(i)) += e.w[place] / std::sqrt(system.masses()[i]);
    }
    length[k] = W.row(k).norm();
    W.row(k) /= length[k];
  }
  const MatrixXd N = orthogonal_complement(W.transpose()), dependences = orthogonal_complement(W);
  std::vector<double> mu(system.rows(), 0.0);
  Eigen::VectorXd curvature(W.rows());  // of each row of unit length
  for (Index k = 0; k < W.rows(); ++k) {
    double& own = mu[rigid[static_cast<std::size_t>(k)]];
    own = 1.0 / length[k];
    curvature[k] = curvature_by(system, at, mu).norm();
    own = 0.0;
  }
  // Positions are known to rank_threshold at best, and so is the residue of a sum that is 0; dependences are
  // known to rank_threshold, also of rows that have no part in them.
  const double known = std::sqrt(rank_threshold);
  for (const auto dependence : dependences.colwise()) {
    for (Index k = 0; k < W.rows(); ++k) mu[rigid[static_cast<std::size_t>(k)]] = dependence[k] / length[k];
    const MatrixXd left = N.transpose() * curvature_by(system, at, mu) * N;
    if (left.norm() > known * dependence.cwiseAbs().cwiseMax(rank_threshold).dot(curvature)) return true;
  }
  return false;
}

}  // namespace dalembert
