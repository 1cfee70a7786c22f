#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/balance.h>
#include <dalembert/solvers/equilibrium/branches.h>
#include <dalembert/solvers/equilibrium/tangent_modes.h>

#include <Eigen/Core>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace DALEMBERT_HIDDEN dalembert {

/// One point of a branch as numbers: x = (q in units of the scene's scales, p in units of the range).
struct Node {
  Eigen::VectorXd x{};
  std::vector<double> lambda{};
  FlatEquilibrium state{};
  TangentStiffness stiffness{};
  std::vector<Vibration> vibrations{};

  [[nodiscard]] double fraction() const { return x[x.size() - 1]; }
  [[nodiscard]] auto growing() const { return std::ranges::count_if(vibrations, &Vibration::grows); }
};

/// Newton's iteration for a point of a branch in the hyperplane through the guess across `normal`:
///
///   R1(q, lambda, p) = 0,   R2(q, lambda, p) = 0,   normal . (x - x_guess) = 0.                       (1)
///
/// Derivatives by q and lambda are those of Balance, by p difference quotients; corrections are of least
/// norm, so that free motions do no harm. No scene is built outside of the range of p: there are no points
/// there.
class Corrector {
 public:
  /// Begins at the equilibrium of options.from. Throws like `find_equilibrium`.
  Corrector(std::function<PosedSystem(double)> pose, const BranchOptions& options);

  [[nodiscard]] const Node& begin() const { return begin_; }
  /// Nothing if the iteration does not converge.
  [[nodiscard]] std::optional<Node> correct(const Node& guess, const Eigen::VectorXd& normal) const;
  /// The point at x and lambda as they are, if that is one to the accuracy asked of an equilibrium.
  [[nodiscard]] std::optional<Node> finished(Node guess) const;
  /// Why the last correction failed.
  [[nodiscard]] const std::string& why() const { return why_; }
  [[nodiscard]] double parameter(const Node& node) const { return value(node.x[node.x.size() - 1]); }
  /// The unit tangent of the branch at a point, towards options.to; none at a fold. It has no component along
  /// free motions.
  [[nodiscard]] std::optional<Eigen::VectorXd> tangent(const Node& node) const;
  /// The part of the residual's derivative by p along the left eigenvector of an eigenvalue of K, over that
  /// derivative. At a singular point it is 0 at a bifurcation (the derivative is in the range of the
  /// equations), not 0 at a fold.
  [[nodiscard]] double range_defect(const Node& node, Eigen::Index shape) const;
  /// The direction of an eigenvector in x, of length 1.
  [[nodiscard]] Eigen::VectorXd direction(const Eigen::VectorXd& shape) const;

 private:
  struct Here {
    std::shared_ptr<const System> system;
    Balance balance;
    Turning<3> turning;
  };
  [[nodiscard]] Here at(double p, const Eigen::VectorXd& x) const;
  [[nodiscard]] Balance::State state(const Here& here, const Node& node) const;
  [[nodiscard]] Eigen::VectorXd residual(double p, const Node& node, const ActiveRows& rows) const;
  [[nodiscard]] Eigen::VectorXd slope_by_parameter(const Node& node, const ActiveRows& rows) const;
  [[nodiscard]] double value(double fraction) const { return from_ + range_ * fraction; }
  [[nodiscard]] Eigen::MatrixXd jacobian(const Here& here, const Balance::State& s, const Node& node,
                                         const ActiveRows& rows) const;
  void newton_step(const Here& here, const Balance::State& s, double off, const Eigen::VectorXd& normal,
                   Node& node) const;
  void finish(const Here& here, const Balance::State& s, Node& node) const;

  std::function<PosedSystem(double)> pose_;
  double from_, range_;
  std::vector<double> scale_;  // of each coordinate
  Node begin_{};
  mutable std::string why_{};
};

}  // namespace dalembert
