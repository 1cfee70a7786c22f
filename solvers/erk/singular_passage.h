#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/erk/node.h>
#include <dalembert/solvers/erk/verner.h>
#include <dalembert/solvers/run/singular_extrapolation.h>

#include <array>
#include <limits>
#include <span>

namespace DALEMBERT_HIDDEN dalembert {

/// Passes isolated singular positions.
///
/// Where constraints become linearly dependent for an instant, sin ~ |t - t*|, the motion is smooth but the
/// accelerations computed from a state off the manifold by e are wrong by e/sin^2, and no step with stages
/// close to t* is accurate. So the position is passed on the polynomial through the last accelerations, see
/// SingularExtrapolation, to the mirror image of the last node beyond t*, and projected there. Steps towards
/// t* go at most half of the way. The polynomial through one node less estimates the error: at first that
/// falls with each step, as a high power of the distance; if round-off makes it grow before it is within the
/// tolerance, the best passage so far is taken.
///
/// Where constraints are redundant, rows that become dependent are replaced (see Manifold): nothing is
/// singular until others are no better.
class ErkStepper::SingularPassage {
 public:
  SingularPassage(RungeKutta& method, std::size_t coordinates);

  /// The outcome of an attempt.
  enum class Outcome { none, ahead, passed };
  /// Before a step: passes a position in front of the last node, into `next`, or shortens the next step.
  [[nodiscard]] Outcome attempt();
  /// After each step, and before the first: the accelerations at t.
  void remember(double t, std::span<const double> a) { extrapolation_.remember(t, a); }
  /// Forgets accelerations that the next ones do not continue.
  void forget() { extrapolation_.forget(); }
  /// In a step that passed one: between the nodes on both sides.
  void read(double t, std::span<double> q, std::span<double> v) const;

  /// A step starts at a node; its stage i is at t.
  void start_step(const Node& start);
  void note_angle(std::size_t i, double t);
  /// The least angle at the stages of the last attempt.
  [[nodiscard]] const Angle& least_angle() const { return least_; }
  /// Whether a long step may have crossed a singular position that was not in sight where it began.
  [[nodiscard]] bool may_have_passed() const;
  /// How many have been passed.
  [[nodiscard]] int passed() const { return singular_positions_; }

 private:
  static constexpr double none_yet = std::numeric_limits<double>::infinity();

  [[nodiscard]] double time_left() const;
  [[nodiscard]] double least_between_stages() const;
  [[nodiscard]] double find_singular(double& t);
  [[nodiscard]] bool take(double singular);
  [[nodiscard]] bool passes_beside(double singular);
  [[nodiscard]] bool worth_taking(double error);
  /// From the last node to t, see SingularExtrapolation.
  void extrapolate(std::size_t nodes, double t, Node& out);

  RungeKutta& rk_;
  SingularExtrapolation extrapolation_;
  std::size_t extrapolation_nodes_ = 0;          // of the step that passed a singular position
  std::array<Angle, verner87.stages> angles_{};  // at the stages of an attempt, since other rows took over,
  Angle least_{};                                // and the least of them
  long rows_of_angles_ = 0;
  bool only_close_ = false;               // the constraints, not dependent, where the angle falls now
  double next_attempt_ = none_yet;        // the distance from which it is worth another attempt
  double best_extrapolation_ = none_yet;  // error over the tolerance, of
  Node best_extrapolated_;                // a passage that was not taken yet
  int singular_positions_ = 0;
};

}  // namespace dalembert
