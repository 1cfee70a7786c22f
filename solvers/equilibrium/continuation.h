#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/branches.h>
#include <dalembert/solvers/equilibrium/equilibrium_solver.h>
#include <dalembert/solvers/equilibrium/symmetries.h>
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
  /// Whether a point persists as time passes; if not, see `why`.
  [[nodiscard]] virtual bool lasts(const Node& node) const = 0;
  /// Why the last correction failed, or the last point does not persist.
  [[nodiscard]] const std::string& why() const { return why_; }
  [[nodiscard]] double parameter(const Node& node) const { return value(node.fraction()); }
  /// The unit tangent of the branch at a point, towards options.to; none at a fold. It has no component along
  /// free motions.
  [[nodiscard]] virtual std::optional<Eigen::VectorXd> tangent(const Node& node) const = 0;
  /// By how much the parameter changes along the branch per unit across a hyperplane, at a point that is not
  /// singular.
  [[nodiscard]] virtual double parameter_slope(const Node& node, const Eigen::VectorXd& normal) const = 0;
  /// Whether an eigenvector of K, whose eigenvalue vanishes at a node between a and b, leads to other
  /// equilibria: not where the equations are regular, and only what nonholonomic rows let move is not stiff.
  [[nodiscard]] virtual bool is_singular(const Node& node, Eigen::Index shape, const Node& a,
                                         const Node& b) const = 0;
  /// Eigenvectors of K by their places, which symmetries that leave the point as it is carry into each other.
  struct Orbit {
    std::vector<Eigen::Index> shapes;
    bool one_branch;  ///< every direction that they span is carried into every other
  };
  [[nodiscard]] virtual std::vector<Orbit> orbits(const Node&,
                                                  const std::vector<Eigen::Index>& shapes) const {
    std::vector<Orbit> each;
    for (const Eigen::Index shape : shapes) each.push_back({{shape}, false});
    return each;
  }
  /// The direction of an eigenvector in x, of length 1.
  [[nodiscard]] Eigen::VectorXd direction(const Eigen::VectorXd& shape) const;

 protected:
  Corrector(std::function<PosedSystem(double)> pose, const BranchOptions& options)
      : pose_(std::move(pose)), from_(options.from), range_(options.to - options.from) {}
  /// Throws Error only, and says at which value of the parameter what else a scene's builder throws.
  [[nodiscard]] PosedSystem pose(double p) const;
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
///   R1(q, lambda, p) = 0,   R2(q, lambda, p) = 0,   normal . (x - x_guess) = 0,   X(q)^T dx = 0.        (1)
///
/// Derivatives by q and lambda are those of EquilibriumSolver, by p difference quotients; corrections are of
/// least norm, so that free motions do no harm. X are the displacements by symmetries of the scene that its
/// frame keeps: they carry an equilibrium into others of the same p, and the last of (1) chooses one of them.
/// No scene is built outside of the range of p: there are no points there.
class EquilibriumCorrector final : public Corrector {
 public:
  /// Begins at the equilibrium of options.from. Throws like `find_equilibrium`.
  EquilibriumCorrector(std::function<PosedSystem(double)> pose, const BranchOptions& options);

  [[nodiscard]] std::optional<Node> correct(const Node& guess, const Eigen::VectorXd& normal) const override;
  [[nodiscard]] std::optional<Node> finished(Node guess) const override;
  [[nodiscard]] bool lasts(const Node& node) const override;
  [[nodiscard]] std::optional<Eigen::VectorXd> tangent(const Node& node) const override;
  [[nodiscard]] double parameter_slope(const Node& node, const Eigen::VectorXd& normal) const override;
  [[nodiscard]] bool is_singular(const Node& node, Eigen::Index shape, const Node& a,
                                 const Node& b) const override;
  [[nodiscard]] std::vector<Orbit> orbits(const Node& node,
                                          const std::vector<Eigen::Index>& shapes) const override;

 private:
  struct Here {
    std::shared_ptr<const System> system;
    Problem problem;
    EquilibriumSolver balance;
    UniformRotation<3> turning;
  };
  [[nodiscard]] Here at(double p, const Eigen::VectorXd& x) const;
  [[nodiscard]] EquilibriumSolver::State state(const Here& here, const Node& node) const;
  [[nodiscard]] Eigen::VectorXd residual(double p, const Node& node, const ActiveRows& rows) const;
  [[nodiscard]] Eigen::MatrixXd sizes_of_stiffness(const Node& node) const;
  [[nodiscard]] Eigen::VectorXd slope_by_parameter(const Node& node, const ActiveRows& rows) const;
  /// (1), linearised, without the hyperplane: [R_q R_lambda R_p] in the units of x, and X^T. Forces are
  /// measured by the largest that acts, that a unit of x changes or that the range of p does; constraints by
  /// their gradients.
  struct Linear {
    Eigen::MatrixXd A;
    double force;           ///< the unit of lambda
    Eigen::VectorXd units;  ///< of each row
    Eigen::VectorXd sizes;  ///< the same, by the forces of its own uncoupled part of the scene
  };
  [[nodiscard]] Linear linear(const Here& here, const EquilibriumSolver::State& s, const Node& node,
                              const ActiveRows& rows) const;
  /// The shortest (dx, dlambda, dp) of (1) for a right-hand side, in the units of `linear`.
  [[nodiscard]] static Eigen::VectorXd solution(const Linear& all, const Eigen::VectorXd& normal,
                                                const Eigen::VectorXd& right, double across);
  [[nodiscard]] Eigen::VectorXd positions(const Eigen::VectorXd& x) const;
  /// By the symmetries that the frame keeps: columns.
  [[nodiscard]] Eigen::MatrixXd displacements(const Eigen::VectorXd& x) const;
  void find_symmetries();
  /// The largest of what is left of R1 and R2, in the sizes of `linear`.
  [[nodiscard]] static double unbalanced(const EquilibriumSolver::State& s, const ActiveRows& rows,
                                         const Linear& all);
  void finish(const Here& here, const EquilibriumSolver::State& s, Node& node) const;

  double length_ = 0.0;  // of the scene where the branch begins
  std::optional<Symmetries> symmetries_{};
  Eigen::MatrixXd kept_{};  // coefficients of those that the frame keeps, columns
};

}  // namespace dalembert
