#pragma once

#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/scene/system.h>

#include <Eigen/Core>

#include <string>
#include <vector>

/// The equations of a System as dense matrices, and what must hold between them.
namespace dalembert {

struct State {
  double t;
  Eigen::VectorXd q, v;

  [[nodiscard]] Instant instant() const {
    const auto n = static_cast<std::size_t>(q.size());
    return {t, {q.data(), n}, {v.data(), n}};
  }
};

inline Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

inline Eigen::VectorXd vector(std::span<const double> x) {
  return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

ActiveRows all_rows(const System& system);

Eigen::MatrixXd masses(const System& system);

Eigen::MatrixXd by_rows(const System& system, std::span<const double> w);

Eigen::MatrixXd by_entries(Eigen::Index n, std::span<const MatrixEntry> pattern,
                           std::span<const double> values);

struct Values {
  Eigen::VectorXd F, g, psi, gamma;
  Eigen::MatrixXd W;
};

Values values(const System& system, const State& s);

/// The forces that read multipliers.
Eigen::VectorXd friction(const System& system, const State& s, const Eigen::VectorXd& lambda);

struct Derivatives {
  Eigen::MatrixXd psi_q, stiffness, damping, friction;
};

Derivatives derivatives(const System& system, const State& s, const Eigen::VectorXd& lambda);

/// Every derivative that a System gives, against central differences of what it is the derivative of.
void expect_consistent(const System& system, const State& at, const Eigen::VectorXd& lambda);

}  // namespace dalembert
