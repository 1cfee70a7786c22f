#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/branches.h>
#include <dalembert/solvers/equilibrium/equilibrium_solver.h>
#include <dalembert/solvers/equilibrium/tangent_modes.h>

#include <Eigen/Core>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// One point of a branch as numbers: x = (q in units of the scene's scales, p in units of the range).
struct Node {
  Eigen::VectorXd x{};
  std::vector<double> lambda{};
  std::vector<double> beside{};  ///< of a steady motion: (q, v) less what is stated
  FlatEquilibrium state{};
  TangentStiffness stiffness{};         ///< of an equilibrium
  std::vector<Vibration> vibrations{};  ///< of a steady motion: all that may grow, real eigenvalues included

  [[nodiscard]] double fraction() const { return x[x.size() - 1]; }
  [[nodiscard]] auto growing() const { return std::ranges::count_if(vibrations, &Vibration::grows); }
};

/// What finds the points of a branch.
class Corrector {
 public:
  virtual ~Corrector() = default;

  /// The point where the branch begins.
  [[nodiscard]] const Node& begin() const { return begin_; }
  /// The point in the hyperplane through a guess across `normal`; nothing if there is none, see `why`.
  [[nodiscard]] virtual std::optional<Node> correct(const Node& guess,
                                                    const Eigen::VectorXd& normal) const = 0;
  /// The point at x and lambda as they are, if that is one to the accuracy asked of an equilibrium.
  [[nodiscard]] virtual std::optional<Node> finished(Node guess) const = 0;
  /// Why the last correction failed.
  [[nodiscard]] const std::string& why() const { return why_; }
  [[nodiscard]] double parameter(const Node& node) const { return value(node.fraction()); }
  /// The unit tangent of the branch at a point, towards options.to; none at a fold. It has no component along
  /// free motions.
  [[nodiscard]] virtual std::optional<Eigen::VectorXd> tangent(const Node& node) const = 0;
  /// The part of the residual's derivative by p along the left eigenvector of an eigenvalue of K, over that
  /// derivative. At a singular point it is 0 at a bifurcation (the derivative is in the range of the
  /// equations), not 0 at a fold. Nothing where the equations are regular, and only what moves is not stiff.
  [[nodiscard]] virtual std::optional<double> range_defect(const Node& node, Eigen::Index shape) const = 0;
  /// The direction of an eigenvector in x, of length 1.
  [[nodiscard]] Eigen::VectorXd direction(const Eigen::VectorXd& shape) const;

 protected:
  Corrector(std::function<PosedSystem(double)> pose, const BranchOptions& options)
      : pose_(std::move(pose)), from_(options.from), range_(options.to - options.from) {}
  [[nodiscard]] PosedSystem pose(double p) const { return pose_(p); }
  [[nodiscard]] double value(double fraction) const { return from_ + range_ * fraction; }

  std::vector<double> scale_;  // of each coordinate
  Node begin_{};
  mutable std::string why_{};

 private:
  std::function<PosedSystem(double)> pose_;
  double from_, range_;
};

/// Newton's iteration for an equilibrium,
///
///   R1(q, lambda, p) = 0,   R2(q, lambda, p) = 0,   normal . (x - x_guess) = 0.                       (1)
///
/// Derivatives by q and lambda are those of EquilibriumSolver, by p difference quotients; corrections are of
/// least norm, so that free motions do no harm. No scene is built outside of the range of p: there are no
/// points there.
class EquilibriumCorrector final : public Corrector {
 public:
  /// Begins at the equilibrium of options.from. Throws like `find_equilibrium`.
  EquilibriumCorrector(std::function<PosedSystem(double)> pose, const BranchOptions& options);

  [[nodiscard]] std::optional<Node> correct(const Node& guess, const Eigen::VectorXd& normal) const override;
  [[nodiscard]] std::optional<Node> finished(Node guess) const override;
  [[nodiscard]] std::optional<Eigen::VectorXd> tangent(const Node& node) const override;
  [[nodiscard]] std::optional<double> range_defect(const Node& node, Eigen::Index shape) const override;

 private:
  struct Here {
    std::shared_ptr<const System> system;
    EquilibriumSolver balance;
    UniformRotation<3> turning;
  };
  [[nodiscard]] Here at(double p, const Eigen::VectorXd& x) const;
  [[nodiscard]] EquilibriumSolver::State state(const Here& here, const Node& node) const;
  [[nodiscard]] Eigen::VectorXd residual(double p, const Node& node, const ActiveRows& rows) const;
  [[nodiscard]] Eigen::VectorXd slope_by_parameter(const Node& node, const ActiveRows& rows) const;
  [[nodiscard]] Eigen::MatrixXd jacobian(const Here& here, const EquilibriumSolver::State& s,
                                         const Node& node, const ActiveRows& rows) const;
  void newton_step(const Here& here, const EquilibriumSolver::State& s, double off,
                   const Eigen::VectorXd& normal, Node& node) const;
  void finish(const Here& here, const EquilibriumSolver::State& s, Node& node) const;
};

}  // namespace dalembert
