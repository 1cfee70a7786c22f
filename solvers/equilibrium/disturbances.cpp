#include "dalembert/solvers/equilibrium/disturbances.h"

#include <dalembert/solvers/equilibrium/equilibrium.h>
#include <dalembert/solvers/equilibrium/mass_metric.h>
#include <dalembert/solvers/linear/dense.h>

#include <array>
#include <cmath>
#include <numeric>
#include <sstream>
#include <utility>
#include <vector>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Radau IIA of three stages, order 5 (Hairer, Wanner, Solving ODEs II, table IV.5.6); its last stage is the
/// end of the step.
const double r6 = std::sqrt(6.0);
const std::array<double, 3> c{(4.0 - r6) / 10.0, (4.0 + r6) / 10.0, 1.0};
const Eigen::Matrix3d a{
    {(88.0 - 7.0 * r6) / 360.0, (296.0 - 169.0 * r6) / 1800.0, (-2.0 + 3.0 * r6) / 225.0},
    {(296.0 + 169.0 * r6) / 1800.0, (88.0 + 7.0 * r6) / 360.0, (-2.0 - 3.0 * r6) / 225.0},
    {(16.0 - r6) / 36.0, (16.0 + r6) / 36.0, 1.0 / 9.0},
};

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

std::span<const double> radau_nodes() { return c; }

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

MatrixXd Disturbances::basis() const {
  const Index n = coordinates();
  MatrixXd rows = MatrixXd::Zero(G.rows() + W.rows(), 2 * n);
  rows.topLeftCorner(G.rows(), n) = G;
  rows.bottomLeftCorner(W.rows(), n) = E;
  rows.bottomRightCorner(W.rows(), n) = W;
  return orthogonal_complement(rows.transpose(), of_full_rank);
}

/// With (u, w) of stage i, and y, z there times h,
///
///   u_i - h sum a_ij w_j - sum a_ij G_j^T z_j = u
///   w_i + h sum a_ij (K_j u_j + C_j w_j) - sum a_ij W_j^T y_j = w.
MatrixXd radau_step(std::span<const Disturbances> nodes, double h, const MatrixXd& x) {
  const Index n = nodes[0].coordinates(), m = nodes[0].W.rows(), mh = nodes[0].G.rows(),
              size = 2 * n + m + mh;
  MatrixXd A = MatrixXd::Zero(3 * size, 3 * size), b = MatrixXd::Zero(3 * size, x.cols());
  for (Index i = 0; i < 3; ++i) {
    const Index row = i * size;
    b.block(row, 0, 2 * n, x.cols()) = x;
    A.block(row, row, 2 * n, 2 * n).setIdentity();
    for (Index j = 0; j < 3; ++j) {
      const Disturbances& node = nodes[static_cast<std::size_t>(j)];
      const double a_ij = a(i, j);
      const Index column = j * size;
      A.block(row, column + n, n, n).diagonal().array() -= h * a_ij;
      A.block(row, column + 2 * n + m, n, mh) -= a_ij * node.G.transpose();
      A.block(row + n, column, n, n) += h * a_ij * node.K;
      A.block(row + n, column + n, n, n) += h * a_ij * node.C;
      A.block(row + n, column + 2 * n, n, m) -= a_ij * node.W.transpose();
    }
    const Disturbances& own = nodes[static_cast<std::size_t>(i)];
    A.block(row + 2 * n, row, m, n) = own.E;
    A.block(row + 2 * n, row + n, m, n) = own.W;
    A.block(row + 2 * n + m, row, mh, n) = own.G;
  }
  return dense::solve(A, b).middleRows(2 * size, 2 * n);
}

}  // namespace dalembert
