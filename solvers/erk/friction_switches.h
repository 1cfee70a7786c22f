#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/erk/node.h>
#include <dalembert/solvers/run/sticking.h>
#include <dalembert/solvers/run/switches.h>

#include <optional>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Ends steps in front of switches of friction laws and takes the next one over them, see Switches.
class ErkStepper::FrictionSwitches {
 public:
  FrictionSwitches(RungeKutta& method, const System& system);
  /// Once the nodes of the method are there, so that no step allocates.
  void make_room(const Problem& problem, const Start& start);

  /// Before the first step: on which side it starts. A friction law has no direction where nothing slides
  /// yet.
  void find_first_side();
  /// Of the last node, where no attempt has led.
  void find_side_again();

  /// Whether friction may turn, or what slides come to rest.
  [[nodiscard]] bool any() const { return switches_.any() || switches_.any_slides(); }
  /// An attempt starts.
  void start_attempt() { passed_switch_ = passed_several_ = passed_rest_ = false; }
  /// Of its stage i, at t; if there are `any`.
  void check_switch(std::size_t i, double t);
  /// The most that a switch between two nodes, crossed in one step, may contribute to its error, over the
  /// tolerance.
  [[nodiscard]] double effect_of_switch(const Node& a, const Node& b, double step);
  /// After a projection: what a switch that was passed may have done to the step, over the tolerance.
  [[nodiscard]] double error_of_switch(double step);
  /// Whether friction at a state beside the last node, at which the manifold was, is on other sides or has
  /// none.
  [[nodiscard]] bool differs(const Instant& at);

  /// After a step that failed: if it passed a switch, finds by bisection the longest one in front of it, and
  /// how far it is from there to behind it. True if `next` is then the end of a step.
  [[nodiscard]] bool stop_short(double step);
  /// After a step: if it led over a switch, the next one is as long as usual, or the run ends.
  void go_on_behind_switch();

  double over = 0.0;               ///< the step to take next, over a switch
  std::optional<StepFailure> end;  ///< what the run ends with where the last step ended

 private:
  void find_side(Node& node);
  [[nodiscard]] bool failed_behind_switch();
  [[nodiscard]] StepFailure why_not_over(Node& before);
  [[nodiscard]] bool driven_back();
  void read(const Node& node, Motion& out) const;

  RungeKutta& rk_;
  Switches switches_;
  std::optional<Sticking> sticking_;      // if there are any
  std::vector<double> multipliers_;       // work
  Motion before_switch_, behind_switch_;  // work
  Slope stage_side_, behind_side_;        // of stages, the latter behind a switch
  bool passed_switch_ = false;            // by the last attempt,
  bool passed_several_ = false;           // and more than one;
  bool passed_rest_ = false;              // and a rest of what slides
  Node short_of_, beyond_;                // where steps end in front of a switch, and behind it
};

}  // namespace dalembert
