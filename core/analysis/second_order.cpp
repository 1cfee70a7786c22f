#include "dalembert/core/analysis/second_order.h"

#include <dalembert/core/linear/products.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The holonomic rows that others already imply to first order.
std::vector<std::size_t> implied_rows(const System& system, const ActiveRows& independent) {
  std::vector<std::size_t> rows;
  for (std::size_t r = 0; r < system.holonomic_rows(); ++r)
    if (system.in_force(r) && !system.law(r).compliant() && !std::ranges::binary_search(independent.rows, r))
      rows.push_back(r);
  return rows;
}

/// Of each row in the metric of the masses.
std::vector<double> lengths(const System& system, std::span<const double> w) {
  std::vector<double> lengths(system.rows());
  for (std::size_t r = 0; r < system.rows(); ++r) {
    double square = 0.0;
    for (const std::size_t k : system.row(r)) square += w[k] * w[k] / system.masses()[system.w_columns()[k]];
    lengths[r] = std::sqrt(square);
  }
  return lengths;
}

/// Q in the metric of the masses, and its size if none of its parts cancelled.
struct Curvature {
  MatrixXd Q;
  double size;
};

Curvature curvature(const System& system, const Instant& at, const std::vector<double>& s) {
  auto change = system.linearisation();
  const auto n = static_cast<Index>(system.coordinates());
  Curvature its{MatrixXd::Zero(n, n), 0.0};
  std::vector<double> of_row(s.size());
  for (std::size_t r = 0; r < s.size(); ++r) {
    if (s[r] == 0.0) continue;
    std::ranges::fill(of_row, 0.0);
    of_row[r] = s[r];
    system.linearise_constraints(at, of_row, change);
    MatrixXd Q = MatrixXd::Zero(n, n);
    for (std::size_t k = 0; k < system.stiffness_of_constraints(); ++k) {
      const auto [i, j] = system.stiffness_pattern()[k];
      const double mass = std::sqrt(system.masses()[i] * system.masses()[j]);
      Q(static_cast<Index>(i), static_cast<Index>(j)) += change.stiffness[k] / mass;
    }
    its.size = std::max(its.size, Q.norm());
    its.Q += Q;
  }
  return its;
}

/// The part of a basis of velocities that Q does not hold: all of it unless Q has one sign there.
MatrixXd left_free(const Curvature& its, const MatrixXd& basis) {
  if (basis.cols() == 0) return basis;
  const auto [values, vectors] = dense::symmetric_eigen(dense::restricted(basis, its.Q));
  const double none = std::sqrt(rank_threshold) * its.size;  // as positions and derivatives are known
  if (values.minCoeff() < -none && values.maxCoeff() > none) return basis;
  std::vector<Index> free;
  for (Index i = 0; i < values.size(); ++i)
    if (std::abs(values[i]) <= none) free.push_back(i);
  return basis * MatrixXd(vectors(Eigen::all, free));
}

}  // namespace

std::size_t held_to_second_order(const System& system, double t, std::span<const double> q,
                                 const ActiveRows& independent) {
  const auto implied = implied_rows(system, independent);
  if (implied.empty()) return 0;
  const std::vector<double> at_rest(q.size(), 0.0);
  const Instant at{t, q, at_rest};
  auto e = system.evaluation();
  system.evaluate(at, e);
  const MatrixXd rows = rows_in_mass_metric(system, e.w);
  MatrixXd used(rows.rows(), static_cast<Index>(independent.holonomic));
  for (Index j = 0; j < used.cols(); ++j)
    used.col(j) = rows.col(static_cast<Index>(independent.rows[static_cast<std::size_t>(j)]));
  MatrixXd basis = orthogonal_complement(used);
  const Index before = basis.cols();
  const dense::OrthogonalDecomposition qr(used, 0.0);
  const std::vector<double> length = lengths(system, e.w);
  for (const std::size_t r : implied) {
    const VectorXd share = qr.solve(rows.col(static_cast<Index>(r)));
    std::vector<double> s(system.rows());
    s[r] = 1.0 / length[r];
    for (Index j = 0; j < share.size(); ++j) {
      const std::size_t other = independent.rows[static_cast<std::size_t>(j)];
      if (std::abs(share[j]) > rank_threshold) s[other] = -share[j] / length[other];
    }
    basis = left_free(curvature(system, at, s), basis);
  }
  return static_cast<std::size_t>(before - basis.cols());
}

}  // namespace dalembert
