#include "equations.h"

#include <dalembert/testing/laws.h>

#include <gtest/gtest.h>

#include <numeric>

namespace dalembert {

ActiveRows all_rows(const System& system) {
  ActiveRows rows{std::vector<std::size_t>(system.rows()), system.holonomic_rows()};
  std::iota(rows.rows.begin(), rows.rows.end(), std::size_t{0});
  return rows;
}

Eigen::MatrixXd masses(const System& system) { return vector(system.masses()).asDiagonal(); }

Eigen::MatrixXd by_rows(const System& system, std::span<const double> w) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(index(system.rows()), index(system.coordinates()));
  for (std::size_t r = 0; r < system.rows(); ++r) {
    for (const std::size_t k : system.row(r)) dense(index(r), index(system.w_columns()[k])) += w[k];
  }
  return dense;
}

Eigen::MatrixXd by_entries(Eigen::Index n, std::span<const MatrixEntry> pattern,
                           std::span<const double> values) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t k = 0; k < pattern.size(); ++k)
    dense(index(pattern[k].row), index(pattern[k].column)) += values[k];
  return dense;
}

Values values(const System& system, const State& s) {
  auto e = system.evaluation();
  std::vector<double> gamma(system.rows());
  system.evaluate(s.instant(), e);
  system.bias(s.instant(), gamma);
  return {vector(e.force), vector(e.g), vector(e.psi), vector(gamma), by_rows(system, e.w)};
}

Eigen::VectorXd friction(const System& system, const State& s, const Eigen::VectorXd& lambda) {
  Eigen::VectorXd F = Eigen::VectorXd::Zero(index(system.coordinates()));
  system.forces().add_friction(s.instant(), {lambda.data(), static_cast<std::size_t>(lambda.size())},
                               {F.data(), static_cast<std::size_t>(F.size())});
  return F;
}

Derivatives derivatives(const System& system, const State& s, const Eigen::VectorXd& lambda) {
  auto d = system.linearisation();
  system.linearise(s.instant(), {lambda.data(), static_cast<std::size_t>(lambda.size())}, d);
  const Eigen::Index n = index(system.coordinates());
  Eigen::MatrixXd by_lambda = Eigen::MatrixXd::Zero(n, index(system.rows()));
  for (std::size_t k = 0; k < d.friction.size(); ++k)
    by_lambda(index(system.forces().friction_pattern()[k].row),
              index(system.forces().friction_pattern()[k].column)) += d.friction[k];
  return {by_rows(system, d.psi_q), by_entries(n, system.stiffness_pattern(), d.stiffness),
          by_entries(n, system.forces().damping_pattern(), d.damping), by_lambda};
}

void expect_consistent(const System& system, const State& at, const Eigen::VectorXd& lambda) {
  EXPECT_EQ(broken_laws(system, at.instant(), {lambda.data(), static_cast<std::size_t>(lambda.size())}), "");
}

}  // namespace dalembert
