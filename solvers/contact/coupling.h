#pragma once

#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/linear/problem.h>

#include <Eigen/Core>

#include <memory>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The coupling of touching contacts at an instant (Delassus matrix S): rates U_i = s_i dg_i/dt respond to
/// impulses P_j by
///
///   U+ = U- + S P,   S_ij = s_i W_i X_j,   [ M  -W_b^T ] [ X_j ]   [ s_j W_j^T ]
///                                          [ W_b  0    ] [ Y_j ] = [    0      ]             (1)
///
/// with W_b an independent set of the rows of all other constraints, s the sign of each contact. The same S
/// gives accelerations by forces.
class Coupling {
 public:
  /// `system` has the contacts with these numbers, and all other constraints, in force. Throws EquationFault,
  /// StepFailure where the others are dependent.
  Coupling(std::shared_ptr<const System> system, const std::vector<std::size_t>& contacts, const Instant& at);

  [[nodiscard]] const Eigen::MatrixXd& S() const { return S_; }
  /// Of the state that it was made for, whose velocities these are; 0 where they are round-off.
  [[nodiscard]] Eigen::VectorXd rates(std::span<const double> v) const;
  /// Of the contacts' rates, with the given velocities, if they exert no force. (M a - W_b^T lambda_b = F.)
  [[nodiscard]] Eigen::VectorXd accelerations_without(const Instant& at);
  /// Adds what impulses change to velocities; and to `impulses`, one per row of the system, what they are.
  void apply_impulses(const Eigen::VectorXd& P, std::span<double> v, std::span<double> impulses) const;

 private:
  [[nodiscard]] double along(std::size_t contact, std::span<const double> x) const;

  std::shared_ptr<const System> system_;
  System::Evaluation e_;
  std::vector<std::size_t> rows_;  // of the contacts
  std::vector<double> signs_;
  ActiveRows others_;
  SaddleMatrix matrix_;
  std::vector<std::vector<double>> responses_;  // X_j, Y_j
  Eigen::MatrixXd S_;
};

}  // namespace dalembert
