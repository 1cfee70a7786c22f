#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/continuation.h>
#include <dalembert/solvers/equilibrium/steady_branches.h>

namespace DALEMBERT_HIDDEN dalembert {

/// Steady motions at the parameter of a guess: that of its hyperplane across the parameter, whatever
/// `normal`. The statement there is corrected by what the guess's own point was corrected by.
class SteadyCorrector final : public Corrector {
 public:
  /// Begins at the steady motion of options.from. Throws like `find_steady`.
  SteadyCorrector(std::function<PosedSystem(double)> pose, const BranchOptions& options);

  [[nodiscard]] std::optional<Node> correct(const Node& guess, const Eigen::VectorXd& normal) const override;
  [[nodiscard]] std::optional<Node> finished(Node guess) const override;
  /// Points are found by what makes them last.
  [[nodiscard]] bool lasts(const Node&) const override { return true; }
  [[nodiscard]] std::optional<Eigen::VectorXd> tangent(const Node& node) const override;
  [[nodiscard]] double parameter_slope(const Node&, const Eigen::VectorXd&) const override { return 1.0; }
  /// Eigenvalues of K decide nothing here.
  [[nodiscard]] bool is_singular(const Node&, Eigen::Index, const Node&, const Node&) const override {
    return false;
  }

 private:
  [[nodiscard]] Node point(double fraction, std::span<const double> beside) const;

  Scales scales_{};  // where the branch begins
};

}  // namespace dalembert
