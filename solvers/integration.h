#pragma once

#include <dalembert/solvers/run/accumulated_error.h>
#include <dalembert/solvers/run/comparisons.h>
#include <dalembert/solvers/run/kept_steps.h>
#include <dalembert/solvers/run/segment.h>
#include <dalembert/solvers/run/singularity.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

namespace DALEMBERT_HIDDEN dalembert {

/// A system integrated through time, in segments. Each has its own stepper: the one that the options ask for
/// or, close to an isolated singular position, the explicit one. A segment ends where other rows must take
/// over, where an equation switches, and where constraints change. All that is read lies on the constraints.
class Integration {
 public:
  /// From a consistent start, on the sides of an Opening. Throws StepFailure, EquationFault.
  Integration(const Problem& problem, Start start, const Branches::Sides& sides, const Options& options);

  /// Where the last step ended, or where it came to a switch of the equations.
  [[nodiscard]] double time() const { return switch_ ? switch_->at.t : segment_->stepper->time(); }
  /// Where the run ends.
  [[nodiscard]] double end() const { return options_.t_end; }
  [[nodiscard]] bool at_end() const { return time() >= end(); }
  [[nodiscard]] const Problem& problem() const { return segment_->problem; }
  /// The one whose equations are stepped.
  [[nodiscard]] const System& system() const { return problem().system(); }
  [[nodiscard]] const std::shared_ptr<const System>& shared_system() const {
    return problem().shared_system();
  }
  /// See TimeStepper.
  [[nodiscard]] int degree() const { return segment_->stepper->degree(); }
  [[nodiscard]] double tolerance() const { return options_.tolerance; }
  /// Throws StepFailure, EquationFault.
  void step(double wanted);
  /// Whether the last step ended at a switch of the equations, or the run begins at one. The next step goes
  /// on behind it.
  [[nodiscard]] bool at_switch() const { return switch_.has_value(); }
  /// The same at a time that is not told from its own.
  [[nodiscard]] bool at_switch(double t) const { return switch_ && t >= switch_->at.t - switch_->ahead; }
  /// What is read at this time from here on is behind the switch. Returns whether the motion goes on there as
  /// it is: if not, a constraint that holds only at times has no velocity that satisfies it on both sides,
  /// and others must take over. Throws StepFailure where that is one that always holds; EquationFault.
  bool go_behind_switch();
  /// The sides behind the switch that has been left last.
  [[nodiscard]] const Branches::Sides& behind_switch() const { return behind_->sides; }
  /// Calls f with the equations as they are read at this time: at a switch, as far as times are not told from
  /// its own, before it, and behind it once it has been left.
  template <class F>
  decltype(auto) as_read(double t, const F& f) const {
    const bool before = switch_ && t <= switch_->at.t && t >= switch_->at.t - switch_->ahead;
    const bool behind = behind_ && t >= behind_->t && t <= behind_->checked;
    if (!before && !behind) return f();
    const Branches holding = segment_->hold();
    return f();
  }
  /// A new segment from a time inside the last step, with constraints that changed and velocities that may
  /// have. Throws StepFailure, EquationFault; then the last segment goes on.
  void restart_with_constraints(double t, std::shared_ptr<const System> system, std::span<const double> q,
                                std::span<const double> v);
  /// Counts that positions are moved by this distance, onto what is imposed.
  void displace(double distance) { error_.displace(distance); }
  /// Everything at a time inside the last step (or at the start, before the first). Throws StepFailure,
  /// EquationFault.
  void read(double t, OutputState& m);
  /// The same a while after the start of the segment, by its velocities and accelerations instead of steps.
  void read_ahead(double while_after, OutputState& m);

  /// The stepper's own velocities where the last step ended.
  [[nodiscard]] std::span<const double> velocities() { return interpolate(time()).v; }
  /// Of the current segment.
  [[nodiscard]] const Start& start() const { return segment_->start; }
  /// Those of the scene at a time inside the last step: a length of its path grows.
  [[nodiscard]] Scales scales(double t) const;
  /// The same where the last step began.
  [[nodiscard]] const Scales& scales_at_step() const { return scales_at_step_; }
  /// When the last step began.
  [[nodiscard]] double start_of_step() const { return from_; }
  /// The constraint whose force has grown without bound where the last step ended, in words; empty if there
  /// is none.
  [[nodiscard]] std::string unbounded_multiplier();
  /// The force that holds the motion where the last step ended, in steps of this length, see
  /// dalembert::chattering_force.
  [[nodiscard]] std::string chattering_force(double step);
  /// All steps, of the last one what lies before `end`, if the options ask to keep them; else null.
  [[nodiscard]] std::shared_ptr<const DenseOutput> dense(double end);
  /// Of all its steppers up to a time inside the last step, without the run time.
  [[nodiscard]] Statistics statistics(double until) const;
  /// What positions may be off by at a time inside the last step, a part of the scene's length. Events have
  /// moved them by so much and no more: what counted that several times would let each miss by more than the
  /// one before.
  [[nodiscard]] double error_of_position(double t) const;

 private:
  /// A state of the stepper's own, not put onto the constraints.
  struct State {
    std::vector<double> q, v;
  };
  const State& interpolate(double t);
  [[nodiscard]] const CompliantMultipliers* compliant_multipliers_at(double t);

  void extend_path(Scales& scales, double t, State& at) const;
  [[nodiscard]] Start start_of_rest(double t) const;
  [[nodiscard]] Options options_from(double t, Stepper by) const;
  [[nodiscard]] std::optional<Comparisons::Behind> behind_at(const System& system, double t) const;
  [[nodiscard]] std::unique_ptr<Segment> make_segment(const Problem& problem, Start start, double t,
                                                      Stepper by) const;
  [[nodiscard]] std::unique_ptr<Segment> make_segment(const Problem& problem, Start start, double t,
                                                      Stepper by, Comparisons comparisons) const;
  void enter_segment(std::unique_ptr<Segment> next);
  [[nodiscard]] KeptSteps& own_steps();
  void keep_step(double from);
  void exchange_rows();

  [[nodiscard]] bool lost_to_round_off(double sine) const;
  void watch_sine();
  void hand_over(double sine);
  void watch_sliding();
  void restart_with_rows(Stepper by);
  void find_switch(double from);
  void project_onto_compliant(double t, State& now);
  void stepper_at(double t, std::span<double> q, std::span<double> v);

  Options options_;
  std::unique_ptr<Segment> segment_;
  std::vector<double> lambda_at_start_;
  std::shared_ptr<KeptSteps> kept_;  // if the options ask for it

  AccumulatedError error_;
  std::optional<Comparisons::Switch> switch_;  // at which the last step ends
  std::optional<Comparisons::Behind> behind_;  // the last one that was left
  double last_switch_ = 0.0;
  int switches_at_once_ = 0;  // in a row
  long steps_ = 0;
  Scales scales_at_step_;  // where the last step began
  double from_ = 0.0;      // when that was
  Angle angle_;            // at the last step
  double sine_at_handover_ = 0.0;

  CompliantMultipliers compliant_;  // of the implicit stepper's state, if any constraint is compliant
  State state_;
  Statistics past_;  // of the steppers and readers before
};

}  // namespace dalembert
