#pragma once

#include <dalembert/core/results/sample.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/manifold/manifold.h>
#include <dalembert/solvers/manifold/start.h>

#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Everything that can be read at one instant.
struct OutputState {
  /// `changes`: constraints may come into force that repeat others.
  OutputState(const System& system, const Start& start, bool changes = false);

  double t = 0.0;
  std::vector<double> q, v, a, lambda, forces;
  double energy = 0.0;
  std::vector<char> unique;  // empty if all multipliers are
  // How well the state keeps the constraints, and how far it was moved for that.
  Violation position, velocity;
  double correction = 0.0;

  [[nodiscard]] FlatSample flat() const { return {t, q, v, a, lambda, forces, energy, unique}; }
};

/// Projects a stepper's state onto the constraint manifold and finds the forces of constraint there.
///
/// A state that is right to the tolerance is moved by about as much, except where the constraints are so
/// close to dependent that they turn its error e into e/sin: there the stepper's own state is the better one
/// and stays as it is, if it obeys the constraints as well as it may be wrong, and no force is determined.
/// That is said of each island (see Islands): a pendulum's force does not depend on a linkage beside it.
///
/// Where they are close to dependent the forces of a state on the constraints, too, may be those of its
/// round-off. What the constraints of an island constrain least is one direction n (see
/// Manifold::weakest_directions). A second state, as far off along n as they do not resolve, shows what that
/// does: a multiplier that differs by more than forces are known to (see Accuracy), relative to the largest
/// determined, is not determined. It is NaN here, and Sample throws where it is read. So are accelerations.
///
/// Nor is that of a compliant constraint if it is read from positions, lambda = -g/C, and C is so small that
/// these do not determine it.
class Recovery {
 public:
  Recovery(const Problem& problem, const Start& start, double tolerance);

  /// At m.t, from the stepper's m.q and m.v after so many steps. Throws StepFailure, EquationFault.
  void recover(Manifold& manifold, OutputState& m, long steps);

 private:
  void project(Manifold& manifold, OutputState& m);
  [[nodiscard]] std::vector<double> violations(const std::vector<double>& residual,
                                               std::span<const double> w) const;
  void find_moved_too_far(const OutputState& m);
  void keep_given(Manifold& manifold, OutputState& m);
  [[nodiscard]] double unnoticed() const;
  void require_agreement(const OutputState& m) const;
  void mark(Manifold& manifold, OutputState& m, long steps);
  void mark_undetermined(Manifold& manifold, OutputState& m);
  [[nodiscard]] bool mark_multipliers(OutputState& m) const;
  void mark_accelerations(OutputState& m) const;
  [[nodiscard]] double largest_force(const Manifold& manifold, const OutputState& m) const;
  [[nodiscard]] std::vector<double> stretches_to_come(const OutputState& m) const;
  [[nodiscard]] double wander(const OutputState& m, long steps) const;
  [[nodiscard]] bool rests_unloaded(const Manifold& manifold, const OutputState& m, long steps) const;
  void mark_compliant(const Manifold& manifold, OutputState& m, long steps) const;
  void require_finite(const OutputState& m) const;
  void leave_forces_out(OutputState& m) const;

  Problem problem_;
  const System* system_;  // points into problem_
  Scales scales_;
  std::vector<double> lengths_;
  Accuracy accuracy_;
  std::vector<char> left_out_;  // per island, whether its forces are not determined
  bool any_left_out_ = false;
  std::vector<double> q_given_, v_given_;       // before projection
  std::vector<double> q_, v_, a_, lambda_, n_;  // of the second state
  std::vector<double> w_, response_;
};

}  // namespace dalembert
