#include "dalembert/solvers/equilibrium/disturbances.h"

#include <dalembert/core/linear/products.h>
#include <dalembert/solvers/equilibrium/equilibrium.h>
#include <dalembert/solvers/equilibrium/mass_metric.h>

#include <cmath>
#include <numeric>
#include <sstream>
#include <utility>
#include <vector>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr auto stages = static_cast<Index>(radau_nodes.size());

/// The inverse of Runge's matrix: sum_j a_ij c_j^(k-1) = c_i^k/k for k = 1, ..., 5.
MatrixXd inverse_of_a() {
  MatrixXd powers(stages, stages), integrals(stages, stages);
  for (Index i = 0; i < stages; ++i) {
    double power = 1.0;
    for (Index k = 0; k < stages; ++k) {
      const double c = radau_nodes[static_cast<std::size_t>(i)];
      powers(i, k) = power;
      integrals(i, k) = (power *= c) / static_cast<double>(k + 1);
    }
  }
  const MatrixXd of = integrals.transpose(), right = powers.transpose();
  return dense::solve(of, right).transpose();  // powers integrals^-1
}

/// The multipliers of a sample. Where positions give a spring's force too roughly to be read it is good
/// enough here: its error enters K by no more than its stiffness times their round-off.
std::vector<double> multipliers(const System& system, const FlatSample& at) {
  std::vector<double> lambda(at.lambda.begin(), at.lambda.end());
  auto e = system.evaluation();
  system.evaluate({at.time, at.q, at.v}, e);
  for (std::size_t r = 0; r < lambda.size(); ++r) {
    if (std::isfinite(lambda[r])) continue;
    if (!system.law(r).compliant()) {
      std::ostringstream what;
      what << "The force of " << system.row_label(r) << " is not determined at t = " << at.time
           << ", so neither is the growth of disturbances there";
      throw NoEquilibrium(what.str());
    }
    lambda[r] = system.law(r).multiplier(e.g[r]);
  }
  return lambda;
}

}  // namespace

Disturbances::Disturbances(const System& system, const ActiveRows& rows, const FlatSample& at,
                           double unit_of_time) {
  const RotatingFrame rest(*system.layout(), {});
  const LinearTerms terms = linear_terms(system, rest, {at.time, at.q, at.v}, multipliers(system, at));
  std::vector<std::size_t> all(system.coordinates());
  std::iota(all.begin(), all.end(), std::size_t{0});
  MassMetric metric(system, terms, all, rows.rows);
  K = unit_of_time * unit_of_time * metric.K;
  C = unit_of_time * metric.C;
  W = std::move(metric.W);
  E = unit_of_time * metric.E;
  G = W.topRows(metric.holonomic);
}

FreeDisturbances::FreeDisturbances(const Disturbances& all) {
  const Index n = all.coordinates(), m = all.W.rows(), holonomic = all.G.rows();
  MatrixXd rows = MatrixXd::Zero(holonomic + m, 2 * n);
  rows.topLeftCorner(holonomic, n) = all.G;
  rows.bottomLeftCorner(m, n) = all.E;
  rows.bottomRightCorner(m, n) = all.W;
  basis = orthogonal_complement(rows.transpose(), of_full_rank);
  across = MatrixXd::Zero(2 * n, 2 * n - holonomic - m);
  if (across.cols() == 0) return;  // nothing can move
  across.topLeftCorner(n, n - holonomic) = orthogonal_complement(all.G.transpose(), of_full_rank);
  across.bottomRightCorner(n, n - m) = orthogonal_complement(all.W.transpose(), of_full_rank);
  MatrixXd x_rate(2 * n, basis.cols());
  x_rate << basis.bottomRows(n), -all.K * basis.topRows(n) - all.C * basis.bottomRows(n);
  rate = across.transpose() * x_rate;
}

/// With the inverse b of Runge's matrix, and multipliers gone,
///
///   N_k^T sum_i b_ki (B_i c_i - B_0 c_0) = h N_k^T A_k B_k c_k,   k = 1, ..., 5.
MatrixXd radau_step(const FreeDisturbances& start, std::span<const FreeDisturbances> nodes, double h) {
  const MatrixXd b = inverse_of_a();
  const Index d = start.basis.cols();
  MatrixXd A(stages * d, stages * d), right(stages * d, d);
  for (Index k = 0; k < stages; ++k) {
    const FreeDisturbances& own = nodes[static_cast<std::size_t>(k)];
    for (Index i = 0; i < stages; ++i) {
      A.block(k * d, i * d, d, d) =
          b(k, i) * own.across.transpose() * nodes[static_cast<std::size_t>(i)].basis;
    }
    A.block(k * d, k * d, d, d) -= h * own.rate;
    right.middleRows(k * d, d) = b.row(k).sum() * own.across.transpose() * start.basis;
  }
  return dense::solve(A, right).bottomRows(d);
}

}  // namespace dalembert
