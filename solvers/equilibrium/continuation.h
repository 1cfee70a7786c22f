#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/balance.h>
#include <dalembert/solvers/equilibrium/branches.h>

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <optional>

namespace DALEMBERT_HIDDEN dalembert {

/// One point of a branch as numbers: x = (q in units of the scene's scales, p in units of the range).
struct Node {
  Eigen::VectorXd x{};
  std::vector<double> lambda{};
  FlatEquilibrium state{};
  Eigen::VectorXd stiffness{};  ///< eigenvalues of K on the tangent space, increasing
  Eigen::MatrixXd shapes{};     ///< theirs, in x without p, each of length 1

  [[nodiscard]] Eigen::Index softer() const {
    return (stiffness.array() < 0.0).count();
  }  ///< eigenvalues < 0
};

/// Newton's iteration for a point of a branch in the plane through `x` across `normal`:
///
///   R1(q, lambda, p) = 0,   R2(q, lambda, p) = 0,   normal . (x - x_guess) = 0.                       (1)
///
/// Derivatives by q and lambda are those of Balance, by p they are differences; corrections are the least
/// that do, so that free motions are no harm. No scene is asked for outside of the range of p: a point there
/// is none.
class Corrector {
 public:
  /// Begins at the equilibrium of options.from. Throws like `find_equilibrium`.
  Corrector(std::function<PosedSystem(double)> pose, const BranchOptions& options);

  [[nodiscard]] const Node& begin() const { return begin_; }
  /// Nothing if the iteration does not converge.
  [[nodiscard]] std::optional<Node> correct(const Node& guess, const Eigen::VectorXd& normal) const;
  [[nodiscard]] double parameter(const Node& node) const { return value(node.x[node.x.size() - 1]); }
  /// The direction of the branch through a point towards options.to, of length 1; nothing at a fold. Of the
  /// directions of free motions it has none.
  [[nodiscard]] std::optional<Eigen::VectorXd> tangent(const Node& node) const;
  /// The force along one of its shapes by which a change of p unbalances a state, over the forces that
  /// balance: none at a bifurcation, some at a fold.
  [[nodiscard]] double push(const Node& node, Eigen::Index shape) const;

 private:
  struct Here {
    std::unique_ptr<const System> system;
    Balance balance;
    Turning<3> turning;
  };
  [[nodiscard]] Here at(double p, const Eigen::VectorXd& x) const;
  [[nodiscard]] Balance::State state(const Here& here, const Node& node) const;
  [[nodiscard]] Eigen::VectorXd residual(double p, const Node& node, const ActiveRows& rows) const;
  [[nodiscard]] Eigen::VectorXd slope_by_parameter(const Node& node, const ActiveRows& rows) const;
  [[nodiscard]] double value(double progress) const { return from_ + range_ * progress; }
  [[nodiscard]] Eigen::MatrixXd jacobian(const Here& here, const Balance::State& s, const Node& node,
                                         const ActiveRows& rows) const;
  void newton_step(const Here& here, const Balance::State& s, double off, const Eigen::VectorXd& normal,
                   Node& node) const;
  void finish(const Here& here, const Balance::State& s, Node& node) const;

  std::function<PosedSystem(double)> pose_;
  double from_, range_;
  std::vector<double> scale_;  // of each coordinate
  Node begin_{};
};

}  // namespace dalembert
