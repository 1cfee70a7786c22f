#include "dalembert/core/analysis/integrability.h"

#include <dalembert/core/analysis/disjoint_sets.h>
#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/errors.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

namespace {

/// Entries of (1) below this fraction of the derivatives they come from are round-off.
constexpr double rounding_of_derivatives = 1e-10;

/// Rows as one-forms over (q, t), and for each nonholonomic row its J.
struct Forms {
  Eigen::MatrixXd all;                      // rows of W with psi at rest in the last column
  std::vector<Eigen::MatrixXd> derivative;  // J of each nonholonomic row
};

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

Eigen::MatrixXd dense(const System& system, std::span<const double> w) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(index(system.rows()), index(system.coordinates()));
  for (std::size_t r = 0; r < system.rows(); ++r) {
    for (const std::size_t k : system.row(r)) rows(index(r), index(system.w_columns()[k])) += w[k];
  }
  return rows;
}

/// d psi/dq and the bias gamma for given velocities.
struct Slopes {
  Eigen::MatrixXd psi_q;
  std::vector<double> gamma;
};
Slopes slopes(const System& system, const Instant& at) {
  auto linear = system.linearisation();
  std::vector<double> gamma(system.rows());
  system.linearise(at, gamma, linear);
  system.bias(at, gamma);
  return {dense(system, linear.psi_q), std::move(gamma)};
}

/// The slopes for a unit of velocity k, forwards or, where a one-sided equation (Pursuit) refuses
/// that, backwards; `sign` says which.
Slopes unit_slopes(const System& system, double t, std::span<const double> q, std::size_t k, double& sign) {
  std::vector<double> v(q.size(), 0.0);
  for (sign = 1.0;; sign = -1.0) {
    v[k] = sign;
    try {
      return slopes(system, {t, q, v});
    } catch (const EquationFault&) {
      if (sign < 0.0) throw;
    }
  }
}

/// psi = A v + a is linear in v, so its derivatives at rest and for unit velocities v = s e_k, s = +-1,
/// give those of A and a: with psi_q(v) and gamma(v) = psi_q v + A_t v + a_t,
///   a_q = psi_q(0),   (A_k)_q = s (psi_q(v) - psi_q(0)),   (A_k)_t = s (gamma(v) - gamma(0)) - psi_q(v) e_k.
Forms forms(const System& system, double t, std::span<const double> q) {
  const Eigen::Index n = index(system.coordinates());
  const std::vector<double> v(q.size(), 0.0);
  auto e = system.evaluation();
  system.evaluate({t, q, v}, e);
  Forms result;
  result.all.resize(index(system.rows()), n + 1);
  result.all.leftCols(n) = dense(system, e.w);
  result.all.col(n) = Eigen::Map<const Eigen::VectorXd>(e.psi.data(), index(system.rows()));

  const Slopes rest = slopes(system, {t, q, v});
  const std::size_t first = system.holonomic_rows();
  result.derivative.assign(system.rows() - first, Eigen::MatrixXd::Zero(n + 1, n + 1));
  for (Eigen::Index k = 0; k < n; ++k) {
    double sign = 1.0;
    const Slopes unit = unit_slopes(system, t, q, static_cast<std::size_t>(k), sign);
    for (std::size_t r = first; r < system.rows(); ++r) {
      auto& J = result.derivative[r - first];
      J.col(k).head(n) = sign * (unit.psi_q.row(index(r)) - rest.psi_q.row(index(r))).transpose();
      J(n, k) = sign * (unit.gamma[r] - rest.gamma[r]) - unit.psi_q(index(r), k);
    }
  }
  for (std::size_t r = first; r < system.rows(); ++r)
    result.derivative[r - first].col(n).head(n) = rest.psi_q.row(index(r)).transpose();
  return result;
}

/// Sets of rows that share coordinates, also through other rows; each sorted. Compliant rows remove no degree
/// of freedom, and are left out.
std::vector<std::vector<std::size_t>> connected_rows(const System& system) {
  const auto first_column = [&system](std::size_t r) { return system.w_columns()[system.row(r).front()]; };
  const auto rigid = [&system](std::size_t r) { return !system.law(r).compliant(); };
  DisjointSets coordinates(system.coordinates());
  for (std::size_t r = 0; r < system.rows(); ++r) {
    if (!rigid(r)) continue;
    for (const std::size_t k : system.row(r)) coordinates.join(first_column(r), system.w_columns()[k]);
  }
  std::vector<std::vector<std::size_t>> sets;
  std::vector<std::size_t> roots;
  for (std::size_t r = 0; r < system.rows(); ++r) {
    if (!rigid(r)) continue;
    const std::size_t mine = coordinates.root(first_column(r));
    const auto known = std::ranges::find(roots, mine);
    if (known == roots.end()) sets.emplace_back();
    const auto set = static_cast<std::size_t>(known - roots.begin());
    if (known == roots.end()) roots.push_back(mine);
    sets[set].push_back(r);
  }
  return sets;
}

/// Directions that the given rows allow, as orthonormal columns.
Eigen::MatrixXd allowed(const Eigen::MatrixXd& all, const std::vector<std::size_t>& rows) {
  Eigen::MatrixXd I(std::ssize(rows), all.cols());
  for (Eigen::Index r = 0; r < I.rows(); ++r) I.row(r) = all.row(index(rows[static_cast<std::size_t>(r)]));
  return orthogonal_complement(I.transpose());
}

/// (1) for the nonholonomic rows among `rows`.
bool integrable(const Forms& forms, const std::vector<std::size_t>& rows, std::size_t holonomic) {
  const Eigen::MatrixXd X = allowed(forms.all, rows);
  return std::ranges::all_of(rows, [&](std::size_t r) {
    if (r < holonomic) return true;
    const Eigen::MatrixXd& J = forms.derivative[r - holonomic];
    const Eigen::MatrixXd B = X.transpose() * (J - J.transpose()) * X;
    return B.size() == 0 ||
           B.cwiseAbs().maxCoeff() <= rounding_of_derivatives * std::max(J.cwiseAbs().maxCoeff(), 1e-300);
  });
}

}  // namespace

std::vector<Integrability> integrability(const System& system, double t, std::span<const double> q) {
  std::vector<Integrability> verdicts;
  if (system.rows() == system.holonomic_rows()) return verdicts;
  const Forms at = forms(system, t, q);
  const std::size_t holonomic = system.holonomic_rows();
  for (const auto& set : connected_rows(system)) {
    if (set.back() < holonomic) continue;
    const auto first = std::ranges::lower_bound(set, holonomic);
    const std::vector<std::size_t> velocity(first, set.end());
    Integrability verdict;
    for (const std::size_t r : velocity) verdict.constraints.push_back(system.row_label(r));
    verdict.holonomic = integrable(at, set, holonomic);
    for (const std::size_t r : velocity) {
      if (verdict.holonomic) break;
      std::vector<std::size_t> alone(set.begin(), first);
      alone.push_back(r);
      if (integrable(at, alone, holonomic)) verdict.integrable_alone.push_back(system.row_label(r));
    }
    verdicts.push_back(std::move(verdict));
  }
  return verdicts;
}

}  // namespace dalembert
