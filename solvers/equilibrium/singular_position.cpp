#include "dalembert/solvers/equilibrium/singular_position.h"

#include <dalembert/solvers/equilibrium/linear_terms.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// -sum lambda g_qq and all that does not depend on lambda, in the mass metric.
MatrixXd stiffness(const System& system, const RotatingFrame& frame, const Instant& at,
                   std::span<const double> lambda) {
  const LinearTerms terms = linear_terms(system, frame, at, lambda);
  const auto n = static_cast<Index>(system.coordinates());
  MatrixXd K = MatrixXd::Zero(n, n);
  for (const auto& k : terms.stiffness) {
    const double masses = system.masses()[k.row()] * system.masses()[k.col()];
    K(static_cast<Index>(k.row()), static_cast<Index>(k.col())) += k.value() / std::sqrt(masses);
  }
  return K;
}

}  // namespace

bool is_singular_position(const System& system, const RotatingFrame& frame, const Instant& at) {
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
  const MatrixXd without = stiffness(system, frame, at, mu);
  Eigen::VectorXd curvature(W.rows());  // of each row of unit length
  for (Index k = 0; k < W.rows(); ++k) {
    double& own = mu[rigid[static_cast<std::size_t>(k)]];
    own = 1.0 / length[k];
    curvature[k] = (stiffness(system, frame, at, mu) - without).norm();
    own = 0.0;
  }
  // Positions are known to rank_threshold at best, and so is the residue of a sum that is 0; dependences are
  // known to rank_threshold, also of rows that have no part in them.
  const double known = std::sqrt(rank_threshold);
  for (const auto dependence : dependences.colwise()) {
    for (Index k = 0; k < W.rows(); ++k) mu[rigid[static_cast<std::size_t>(k)]] = dependence[k] / length[k];
    const MatrixXd K = stiffness(system, frame, at, mu) - without;
    const MatrixXd left = N.transpose() * K * N;
    if (left.norm() > known * dependence.cwiseAbs().cwiseMax(rank_threshold).dot(curvature)) return true;
  }
  return false;
}

}  // namespace dalembert
