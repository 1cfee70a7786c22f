#include "dalembert/solvers/equilibrium/mass_metric.h"

#include <dalembert/solvers/base/numbers.h>

#include <cmath>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

/// The place of a coordinate among those considered; -1: not among them.
std::vector<Index> places(std::size_t all, std::span<const std::size_t> coordinates) {
  std::vector<Index> place(all, -1);
  for (std::size_t k = 0; k < coordinates.size(); ++k) place[coordinates[k]] = static_cast<Index>(k);
  return place;
}

/// `read` reads a number of the entries: as it is, or its size.
MatrixXd scaled(
    const LinearTerms::Entries& entries, std::span<const Index> place, const VectorXd& root,
    double (*read)(double) = [](double x) { return x; }) {
  MatrixXd dense = MatrixXd::Zero(root.size(), root.size());
  for (const auto& entry : entries) {
    const Index i = place[entry.row()], j = place[entry.col()];
    if (i >= 0 && j >= 0) dense(i, j) += read(entry.value()) * root[i] * root[j];
  }
  return dense;
}

VectorXd scaled_row(const System& system, std::span<const double> values, std::size_t r,
                    std::span<const Index> place, const VectorXd& root) {
  VectorXd row = VectorXd::Zero(root.size());
  for (const std::size_t k : system.row(r)) {
    const Index i = place[system.w_columns()[k]];
    if (i >= 0) row[i] += values[k] * root[i];
  }
  return row;
}

}  // namespace

MassMetric::MassMetric(const System& system, const LinearTerms& terms,
                       std::span<const std::size_t> coordinates, std::span<const std::size_t> rows)
    : root(static_cast<Index>(coordinates.size())) {
  const auto place = places(system.coordinates(), coordinates);
  for (std::size_t k = 0; k < coordinates.size(); ++k)
    root[static_cast<Index>(k)] = 1.0 / std::sqrt(system.masses()[coordinates[k]]);
  K = scaled(terms.stiffness, place, root);
  K_terms = scaled(terms.stiffness, place, root, [](double x) { return std::abs(x); });
  C = scaled(terms.damping, place, root);
  W = E = MatrixXd::Zero(static_cast<Index>(rows.size()), root.size());
  Index rigid = 0;
  for (const std::size_t r : rows) {
    const VectorXd w = scaled_row(system, terms.w, r, place, root);
    if (system.law(r).compliant()) {
      const MatrixXd spring = w * (w / system.law(r).compliance).transpose();
      K += spring;
      K_terms += spring.cwiseAbs();
      continue;
    }
    const double length = w.norm();
    W.row(rigid) = w.transpose() / length;
    E.row(rigid++) = scaled_row(system, terms.e, r, place, root).transpose() / length;
    if (r < system.holonomic_rows()) ++holonomic;
  }
  W.conservativeResize(rigid, Eigen::NoChange);
  E.conservativeResize(rigid, Eigen::NoChange);
}

Sparse circulatory(const LinearTerms& terms, std::size_t coordinates) {
  constexpr double cancelled = 10.0;
  const auto n = static_cast<Index>(coordinates);
  LinearTerms::Entries sizes;
  for (const auto& entry : terms.stiffness) {
    sizes.emplace_back(entry.row(), entry.col(), std::abs(entry.value()));
    sizes.emplace_back(entry.col(), entry.row(), std::abs(entry.value()));
  }
  Sparse K(n, n), size(n, n);
  K.setFromTriplets(terms.stiffness.begin(), terms.stiffness.end());
  size.setFromTriplets(sizes.begin(), sizes.end());
  const VectorXd own = VectorXd(size.diagonal()).cwiseSqrt();
  Sparse skew = K - Sparse(K.transpose());
  skew.prune([&](Index i, Index j, double value) {
    return std::abs(value) >
           epsilon * terms.roundings * (roundings_of_a_sum * size.coeff(i, j) + cancelled * own[i] * own[j]);
  });
  return skew;
}

}  // namespace dalembert
