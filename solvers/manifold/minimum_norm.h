#pragma once

#include <dalembert/core/linear/dense.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/linear/rows.h>
#include <dalembert/solvers/manifold/friction_shares.h>

#include <Eigen/Core>

#include <functional>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Forces of dependent constraints. Where rows of W depend on each other, W^T lambda is unique but lambda
/// is not. With a an independent set of rows, d the others, and N a basis of the null space of W^T,
///
///   N_d = 1,   W_a^T N_a = -W_d^T            by solves of the KKT matrix                       (1)
///   lambda = lambda_0 + N z                  gives the same force for any z                    (2)
///   |D (lambda_0 + N z)| = min               least squares, by QR                              (3)
///
/// D gives the forces at the points that the user stated the constraints for (detail::forces_at_points), and
/// nothing for the rods inside bodies. So the forces of the stated constraints are those of least norm, and
/// neither the choice of a, nor how equations are scaled, nor what bodies are made of shows in them.
///
/// One-sided constraints do not pull if some z lets all push: then (3) is that of least norm among these.
/// With A their rows of N, in the direction in which they push, p what they push by (3), and P the
/// pseudo-inverse of D N, the conditions of Karush, Kuhn and Tucker are
///
///   z += P P^T A^T y,   w = A P P^T A^T y + p >= 0,   y >= 0,   w^T y = 0.                     (4)
///
/// If there is no such z, as where one is about to open, they pull as little as can be.
///
/// Those of dry friction that sticks are then moved within their bounds, see FrictionShares, and with them
/// what shares with them.
///
/// A multiplier is determined by the motion if its row of N is zero, which is asked as exactly as the
/// positions are known: (1) is corrected by what is left of W^T N a rounding of the positions away, and
/// what changes by no more than a few times the largest such correction is zero.
class MinimumNorm {
 public:
  using Solve = std::function<void(std::span<double>)>;

  /// `active` are the independent rows; `lengths` as in Violation.
  MinimumNorm(const System& system, const ActiveRows& active, std::vector<double> lengths);

  [[nodiscard]] bool needed() const { return !dropped_.empty(); }
  /// Spreads lambda (one per row of the system, zero for dropped ones) by (1)-(4); `e` holds the equations
  /// at the state, `solve` solves [M -W^T; W 0] of the active rows there in place. Throws EquationFault.
  void spread(const Solve& solve, const Instant& at, const System::Evaluation& e, std::span<double> lambda);
  /// N, after `spread`.
  [[nodiscard]] const Eigen::MatrixXd& null_space() const { return N_; }
  /// Per row of the system, after `spread`: 1 if its multiplier is determined by the motion.
  [[nodiscard]] std::span<const char> unique() const { return unique_; }

 private:
  /// A constraint that the user stated: its rows, and where its part of U and of D N begins.
  struct Stated {
    Eigen::Index row, rows, inputs, first, force;
    /// One equation's force has one size, whatever its direction.
    [[nodiscard]] Eigen::Index forces() const { return rows == 1 ? 1 : inputs; }
  };

  void place(const System& system);
  void measure(std::span<const double> w);
  void evaluate_nearby(const Instant& at, const System::Evaluation& e);
  void find_null_space(const Solve& solve, std::span<const double> w);
  void solve_for_correction(const Solve& solve, std::span<const double> w, Eigen::Index j);
  void mark_unique();
  void weigh(const Eigen::MatrixXd& multipliers, Eigen::MatrixXd& forces) const;
  void minimise();
  [[nodiscard]] std::vector<SharedContact> sharing() const;
  void keep_pushing(const std::vector<SharedContact>& sharing, std::span<double> lambda) const;

  const System* system_;
  std::vector<double> lengths_;
  std::vector<Eigen::Index> active_, dropped_;
  std::vector<Stated> stated_;
  std::vector<SharedContact> one_sided_;
  std::vector<char> unique_;
  std::vector<double> x_, U_, nudge_, q_nearby_;
  System::Evaluation nearby_;
  Eigen::VectorXd size_;    // of each row's force, for a multiplier of 1
  Eigen::MatrixXd N_, DN_;  // one column per dropped row
  Eigen::VectorXd zero_;    // what counts as such in each column of N, as a force
  Eigen::VectorXd scale_, z_;
  Eigen::MatrixXd lambda_, right_;  // one column
  dense::OrthogonalDecomposition qr_;
  FrictionShares shares_;
};

}  // namespace dalembert
