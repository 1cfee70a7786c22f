#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/rough_state.h>
#include <dalembert/solvers/contact/slip_coupling.h>
#include <dalembert/solvers/manifold/scales.h>

#include <Eigen/Core>

#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The equations of a scene with friction in given modes, at an instant at which constraints with some
/// numbers are open. Throws EquationFault, StepFailure where constraints are dependent.
class FrictionEquations {
 public:
  using Open = std::vector<std::size_t>;

  FrictionEquations(std::shared_ptr<const System> stated, const Scales& scales, double tolerance)
      : stated_(std::move(stated)), scales_(scales), lengths_(scales.lengths()), tolerance_(tolerance) {}
  [[nodiscard]] const std::shared_ptr<const System>& stated() const { return stated_; }
  [[nodiscard]] const Scales& scales() const { return scales_; }
  [[nodiscard]] double tolerance() const { return tolerance_; }
  void replace_system(std::shared_ptr<const System> stated) { stated_ = std::move(stated); }
  void adopt(const Scales& scales) {
    scales_ = scales;
    lengths_ = scales.lengths();
  }

  /// The system with what sticks and what slides, without what is open, contacts or frictions.
  [[nodiscard]] std::shared_ptr<const System> with_modes(std::span<const RoughState> all,
                                                         const Open& open) const;
  /// Accelerations and multipliers with the modes as they are.
  struct Motion {
    std::vector<double> a, lambda;
    std::vector<char> unique{};
  };
  [[nodiscard]] Motion solve(std::span<const RoughState> all, const Open& open, const Instant& at) const;
  /// Those nearest to the ones of an instant that leave what sticks no slip.
  [[nodiscard]] std::vector<double> velocities_at_rest(std::span<const RoughState> all, const Open& open,
                                                       const Instant& at) const;
  /// u' = W v' + gamma; 0 where it is round-off of its terms, of what slides also of what its friction alone
  /// would do, or below the root of the tolerance as forces are.
  [[nodiscard]] Eigen::VectorXd slip_acceleration(const RoughState& rough, const Instant& at,
                                                  const Motion& motion) const;
  /// These, numbers among all, without their friction.
  [[nodiscard]] SlipCoupling released(std::span<const RoughState> all, const std::vector<std::size_t>& which,
                                      const Open& open, const Instant& at) const;
  /// Round-off of its own force and of what it shares with others, of the inertia of the lightest that it
  /// acts on, and of springs; never 0.
  [[nodiscard]] double round_off_of(std::span<const RoughState> all, const RoughState& rough,
                                    std::span<const double> a, std::span<const double> lambda) const;

 private:
  std::shared_ptr<const System> stated_;
  Scales scales_;
  std::vector<double> lengths_;  // as in Scales
  double tolerance_;
};

}  // namespace dalembert
