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
/// with W_b an independent set of the rows of all other rigid constraints, s the sign of each contact. The
/// same S gives accelerations by forces. A compliant constraint is a force in both: lambda = -g/C, which no
/// impulse changes, as it does not change g. (A stepper's own multipliers of compliant rows are in g: what is
/// read from it has been projected onto g + C lambda = 0.)
///
/// A contact at a point that the other constraints hold has S_jj = 0, and with it its row and column: no
/// force of its own changes its rate. In numbers S_jj is round-off of W_j M^-1 W_j^T, which it is without the
/// others, and an impulse that is divided by that is arbitrary.
///
/// Contacts of different islands (see Islands) are not coupled: one solution of (1) serves one contact of
/// each.
class Coupling {
 public:
  using Places = std::vector<Eigen::Index>;

  /// `system` has the contacts with these numbers, and all other constraints, in force. Throws EquationFault,
  /// StepFailure where the others are dependent.
  Coupling(std::shared_ptr<const System> system, const std::vector<std::size_t>& contacts, const Instant& at);

  /// The places, among the contacts, of those of each island that has any.
  [[nodiscard]] const std::vector<Places>& islands() const { return islands_; }
  /// S of contacts of one island.
  [[nodiscard]] Eigen::MatrixXd S(const Places& contacts) const;
  /// Whether the other constraints alone determine its rate.
  [[nodiscard]] bool is_held(Eigen::Index contact) const { return held_[static_cast<std::size_t>(contact)]; }
  /// Of the state that it was made for, whose velocities these are; 0 where they are round-off.
  [[nodiscard]] Eigen::VectorXd rates(std::span<const double> v) const;
  /// Of the contacts' rates, with the given velocities, if they exert no force; 0 where they are round-off of
  /// the terms of M a - W_b^T lambda_b = F, however large these are.
  [[nodiscard]] Eigen::VectorXd accelerations_without(const Instant& at);
  /// Adds what impulses change to velocities; and to `impulses`, one per row of the system, what they are.
  void apply_impulses(const Eigen::VectorXd& P, std::span<double> v, std::span<double> impulses) const;

 private:
  void group();
  void respond();
  void find_held(const std::vector<std::size_t>& contacts);
  void add_compliant_forces(std::span<double> force) const;
  [[nodiscard]] double along(std::size_t contact, std::span<const double> x) const;

  std::shared_ptr<const System> system_;
  System::Evaluation e_;
  std::vector<std::size_t> rows_;  // of the contacts
  std::vector<double> signs_;
  Problem problem_;
  ActiveRows others_;
  SaddleMatrix matrix_;
  std::vector<Places> islands_;
  std::vector<std::size_t> turns_;              // of each contact, its place within its island
  std::vector<std::vector<double>> responses_;  // X_j, Y_j of all contacts with one turn
  std::vector<char> held_;
};

}  // namespace dalembert
