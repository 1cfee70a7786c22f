#pragma once

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/manifold/manifold.h>
#include <dalembert/solvers/manifold/start.h>
#include <dalembert/solvers/run/sticking.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The equations of a scene on given sides of what they compare, and how two sides differ.
class ComparedEquations {
 public:
  ComparedEquations(const Problem& problem, const Start& start, double tolerance);
  /// Once anything is compared: what follows needs accelerations. (Where forces read multipliers `record`
  /// does, and this is done already.)
  void start_listening(const Problem& problem, const Start& start);

  [[nodiscard]] const System& system() const { return *system_; }
  /// What is compared at an instant, on the sides held, or, without, where it is. False if an equation fails.
  [[nodiscard]] bool record(const Instant& at, const Branches::Sides* held, Branches::Sides& out);
  /// Sets the accelerations on these sides; false if that fails.
  [[nodiscard]] bool accelerate(Motion& at, const Branches::Sides& held);
  /// Evaluates where the motion is; throws what fails there.
  void evaluate(const Instant& at);

  /// Whether the accelerations on two sides differ there by more than the tolerance of speeds in the scene's
  /// own time; or the forces of constraint, which events and conditions read.
  [[nodiscard]] bool differ(const Motion& there, const Branches::Sides& before,
                            const Branches::Sides& behind);
  /// The row of a rigid constraint that jumps from one side to the other, or whose velocity does, if one
  /// does: of those that always hold before those that hold only at times.
  [[nodiscard]] std::optional<std::size_t> corner(const Instant& at, const Branches::Sides& before,
                                                  const Branches::Sides& behind);
  /// The batch of forces, by its number among all, that follow from a Lagrangian in which something jumps
  /// that must not, see StatedByLagrangians, if one does. `ahead` is behind the switch.
  [[nodiscard]] std::optional<std::size_t> impulse(const Motion& there, const Instant& ahead,
                                                   const Branches::Sides& before,
                                                   const Branches::Sides& behind) const;
  [[nodiscard]] bool holds_at_times(std::size_t row) const {
    return std::ranges::find(conditional_, row) != conditional_.end();
  }
  /// The friction that is reversed from one side to the other, in words, if one is.
  [[nodiscard]] std::optional<std::string> would_stick(const Motion& there, const Branches::Sides& before,
                                                       const Branches::Sides& behind);

 private:
  const System* system_;
  Scales scales_;
  double tolerance_;
  std::optional<Manifold> manifold_;  // if anything is compared, or read from it
  System::Evaluation e_;
  std::vector<double> lambda_, a_;
  std::vector<std::size_t> conditional_;  // rows in force of constraints that hold only at times
};

}  // namespace dalembert
