#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/erk/erk.h>
#include <dalembert/solvers/manifold/manifold.h>

#include <random>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// What round-off does to the accelerations at the last node, and to positions and velocities where they are
/// projected: all are found again after a rounding of time, positions and velocities, up or down by chance
/// (the stochastic arithmetic of Vignes, Math. Comput. Simulation 35 (1993) 233-261). That shows what cancels
/// in the user's own equations, too. One sample may be small by chance: earlier ones are not forgotten at
/// once.
class ErkStepper::RoundOff {
 public:
  explicit RoundOff(std::size_t coordinates) : q_(coordinates), v_(q_), a_(q_), of_accelerations_(q_) {}

  /// Another sample. `lengths` are those of `Scales`.
  void measure(const Node& at, const System& system, std::span<const double> lengths, Manifold& manifold,
               FrictionSwitches& switching);

  [[nodiscard]] double of_acceleration(std::size_t i) const { return of_accelerations_[i]; }
  /// Of the projection of positions and of velocities, as lengths.
  [[nodiscard]] double of_positions() const { return of_positions_; }
  [[nodiscard]] double of_velocities() const { return of_velocities_; }

 private:
  std::minstd_rand chance_;
  std::vector<double> q_, v_, a_;  // beside the node
  std::vector<double> of_accelerations_;
  double of_positions_ = 0.0, of_velocities_ = 0.0;
};

}  // namespace dalembert
