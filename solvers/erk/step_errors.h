#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/erk/node.h>
#include <dalembert/solvers/erk/round_off.h>
#include <dalembert/solvers/erk/stages.h>
#include <dalembert/solvers/run/accumulated_error.h>

#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// What a step errs by, and what it may: differences d_i of positions and velocities have the size
///
///   |d| = sqrt(sum_i (w_i d_i)^2 / 2n),   1/w_i = tolerance x scale + round-off,
///
/// at most 1 for a step that is accepted (Hairer, Norsett, Wanner, Solving ODEs I, II.4).
class ErkStepper::StepErrors {
 public:
  /// A step by h, and the derivatives at its stages.
  struct Step {
    const Node& start;
    const Node& end;
    double h;
    const Stages::Derivatives& k;
  };

  StepErrors(const System& system, const Start& start, const Options& options);

  [[nodiscard]] double tolerance() const { return tolerance_; }
  /// Of the step that is tried.
  [[nodiscard]] const Scales& scales() const { return scales_; }
  [[nodiscard]] std::span<const double> lengths() const { return lengths_; }  // see Scales
  void measure_round_off(const Node& at, Manifold& manifold, FrictionSwitches& switching) {
    round_off_.measure(at, *system_, lengths_, manifold, switching);
  }

  /// Another step is tried.
  void start_attempt() { scales_.extent = covered_; }
  /// Its error over the tolerance, estimated from its stages; where that is doubtful, over a part of it.
  /// `equations` are those at the last stage.
  [[nodiscard]] double error(const Step& step, double doubt, const System::Evaluation& equations);
  /// What was tried is the last step now.
  void accept() {
    covered_ = scales_.extent;
    reached_ = estimated_;
  }

  /// The size of what moves a to b, weighed there;
  [[nodiscard]] double distance(const Node& a, const Node& b);
  /// how far a node has moved since it was kept;
  void keep(const Node& node);
  [[nodiscard]] double moved(const Node& node) const;
  /// the change of velocity in h by the change of acceleration from a to b;
  [[nodiscard]] double of_jump(double h, const Node& a, const Node& b) const;
  /// the difference of the derivatives of the last stage and of those at the end of a step, times the step,
  /// as a fraction of the scene's size.
  [[nodiscard]] double disagreement(const Step& step) const;

  /// Of the step that is tried: an error that is known, as a fraction of the scene's size.
  void estimate_as(double error) {
    estimated_ = {.position = error * scales_.length, .velocity = error * scales_.speed()};
  }
  /// Its end has been put off.
  void put_off(double by) { estimated_.late += by; }
  /// Of the last step.
  [[nodiscard]] const StepError& reached() const { return reached_; }

 private:
  void adopt(const PathExtent& extent);
  void weigh(const Node& at, double h, double allowed);
  template <class Difference>
  [[nodiscard]] double size(const Difference& d) const;
  [[nodiscard]] double root_mean(double sum) const;
  [[nodiscard]] std::array<double, 4> estimates(const Step& step);
  void estimate(const Step& step, double of_order_8);
  [[nodiscard]] double error_of_compliant_forces(const Node& end, const System::Evaluation& equations) const;

  const System* system_;
  double tolerance_;
  Scales scales_;
  std::vector<double> lengths_;
  PathExtent covered_;  // by the steps taken; `scales_` may be those of one that is tried
  RoundOff round_off_;
  std::vector<double> weight_, of_order_7_, kept_;  // of positions and velocities
  std::vector<double> force_of_spring_;             // per row, 0 in rigid ones; empty if all are
  StepError estimated_, reached_;                   // of an attempt; of the last step
};

}  // namespace dalembert
