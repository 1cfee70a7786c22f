#include "dalembert/solvers/stepping.h"

#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/erk/erk.h>
#include <dalembert/solvers/ida/ida.h>
#include <dalembert/solvers/run/diagnosis.h>

#include <algorithm>
#include <utility>

namespace dalembert {

namespace {

std::unique_ptr<TimeStepper> make_stepper(const System& system, const Start& start, const Options& options) {
  if (options.stepper == Stepper::erk) return std::make_unique<ErkStepper>(system, start, options);
  return std::make_unique<IdaStepper>(system, start, options);
}

/// The start of a run. What has no length but that of its path gets that of a first explicit step, whose
/// error is within the tolerance of its own length.
Start first_start(const System& system, std::span<const double> q, std::span<const double> v,
                  const Options& options) {
  Start start = consistent_start(system, q, v, options);
  if (!start.scales.of_path) return start;
  try {
    ErkStepper first(system, start, options);
    first.step(options.t_end);
    const Scales& scales = first.scales();
    start.scales.of_path = scales.way.length > Scales::least;  // else it rests, and any length will do
    if (start.scales.of_path) start.scales.take(scales.way);
  } catch (const StepFailure&) {
    start.scales.of_path = false;  // the run will stop, and say why
  }
  return start;
}

void count(const Manifold& manifold, Statistics& statistics) {
  statistics.evaluations += manifold.evaluations();
  statistics.factorisations += manifold.factorisations();
}

}  // namespace

Stepping::Stepping(const System& system, std::span<const double> q, std::span<const double> v,
                   const Options& options)
    : system_(&system),
      options_(options),
      start_(first_start(system, q, v, options)),
      lambda_at_start_(start_.lambda),
      lengths_(start_.scales.lengths()),
      manifold_(std::in_place, system, start_.rows, lengths_),
      stepper_(make_stepper(system, start_, options)),
      recovery_(system, start_, options.tolerance),
      angle_{options.t_start, 1.0},
      state_{start_.q, start_.v} {
  if (system.compliant()) {
    for (auto* numbers : {&springs_.lambda, &springs_.rate, &springs_.second})
      numbers->resize(start_.lambda.size());
  }
  if (system.frictional() && options.stepper == Stepper::ida)
    sticking_.emplace(system, start_, options.t_start, options.tolerance);
  const auto number = [](std::size_t equations) { return static_cast<int>(equations); };
  past_.degrees_of_freedom =
      number(system.coordinates() + system.compliant_rows()) - number(start_.rows.size());
  past_.redundant_equations = number(system.rows() - start_.rows.size());
  compare_rows_from(options.t_start);
}

void Stepping::step(double wanted) {
  // Before a step, so that all output within the last has been read from the stepper that took it.
  exchange_rows();
  if (options_.stepper == Stepper::ida) watch_sine();
  if (steps_++ == 0) watch_sliding();
  try {
    stepper_->step(wanted);
  } catch (const StepFailure&) {
    // Newton's iteration may fail anywhere; where the constraints are close to dependent the explicit
    // stepper goes on.
    if (handed_over_ || options_.stepper == Stepper::erk || !(stepper_->sine() < constants.handover_sine))
      throw;
    hand_over();
  }
  watch_sliding();
}

void Stepping::read(double t, Moment& m) {
  m.t = t;
  stepper_->interpolate(t, m.q, m.v);
  follow_springs(t, *manifold_);
  if (const auto rows = better_rows({t, m.q, m.v})) {
    Manifold other(*system_, *rows, lengths_);
    follow_springs(t, other);
    recovery_.recover(other, m, steps_);
    count(other, past_);
  } else {
    recovery_.recover(*manifold_, m, steps_);
  }
  past_.residual_position = std::max(past_.residual_position, m.position.size);
  past_.residual_velocity = std::max(past_.residual_velocity, m.velocity.size);
  past_.correction = std::max(past_.correction, m.correction);
}

/// The stepper's state, with the forces that it has found for compliant constraints.
const Stepping::State& Stepping::interpolate(double t) {
  stepper_->interpolate(t, state_.q, state_.v);
  follow_springs(t, *manifold_);
  return state_;
}

void Stepping::follow_springs(double t, Manifold& follower) {
  if (system_->compliant() && stepper_->springs(t, springs_)) follower.follow(springs_);
}

void Stepping::compare_rows_from(double t) {
  if (redundant()) best_sine_ = manifold_->sine({t, start_.q, start_.v});
}

/// Rows that make much larger angles at a state than those in use. They are looked for where the angle of
/// these is much less than the best was when last looked for.
std::optional<ActiveRows> Stepping::better_rows(const Instant& at) {
  if (!redundant()) return std::nullopt;
  const double own = manifold_->sine(at);
  if (own >= constants.worn * best_sine_) return std::nullopt;
  ActiveRows rows = independent_rows(*system_, manifold_->equations().w, start_.rows);
  const double best = Manifold(*system_, rows, lengths_).sine(at);
  if (own < constants.worn * best) return rows;
  best_sine_ = std::max(own, best);
  return std::nullopt;
}

/// The rows in use are independent at the start of the run; on the way they may come to depend on each
/// other while others do not.
void Stepping::exchange_rows() {
  if (!redundant()) return;
  const State& now = interpolate(time());
  if (better_rows({time(), now.q, now.v})) restart(handed_over_ ? Stepper::erk : options_.stepper);
}

/// Isolated singular positions are passed by the explicit stepper (see ErkStepper), from where they come in
/// sight until they are as far behind.
void Stepping::watch_sine() {
  const Angle before = std::exchange(angle_, {time(), stepper_->sine()});
  if (!handed_over_) {
    const double left = time_to_singular(before, angle_);
    if (angle_.sine < constants.handover_sine && left < constants.handover_steps * (angle_.t - before.t))
      hand_over();
    return;
  }
  if (angle_.sine <= before.sine || angle_.sine < sine_at_handover_) return;
  handed_over_ = false;
  restart(Stepper::ida);
}

void Stepping::hand_over() {
  handed_over_ = true;
  sine_at_handover_ = angle_.sine;
  restart(Stepper::erk);
}

/// The explicit stepper finds itself where friction sticks.
void Stepping::watch_sliding() {
  if (!sticking_) return;
  const State& now = interpolate(time());
  sticking_->watch(time(), now.q, now.v);
}

/// A fresh choice of rows and a fresh stepper where the present one stands.
void Stepping::restart(Stepper kind) {
  const double t = time();
  State now = interpolate(t);
  // The explicit stepper takes -g/C for the forces of compliant constraints: g must be as exact.
  if (system_->compliant())
    manifold_->project_positions(t, now.q, now.v, 0.1 * start_.scales.rounding(now.q));
  past_ = statistics();
  past_.advice.clear();  // of a crossing it would be about the wrong stepper
  Options from_here = options_;
  from_here.t_start = t;
  from_here.stepper = kind;
  // Close to a singular position a step of the explicit stepper is to err by no more than one of the other.
  if (kind != options_.stepper)
    from_here.tolerance = std::max(constants.share_of_a_step * options_.tolerance, smallest_tolerance);
  start_ = begin_anew(*system_, start_, t, now.q, now.v);
  manifold_.emplace(*system_, start_.rows, lengths_);
  compare_rows_from(t);
  stepper_ = make_stepper(*system_, start_, from_here);
  if (sticking_) sticking_.emplace(*system_, start_, t, options_.tolerance);
  angle_ = {t, 1.0};
}

Statistics Stepping::statistics() const {
  Statistics s = past_;
  stepper_->count(s);
  count(*manifold_, s);
  if (handed_over_) s.advice.clear();
  return s;
}

std::string Stepping::suspect() {
  try {
    State now = interpolate(time());
    std::vector<double> a(now.q.size()), lambda(lambda_at_start_.size());
    if (!manifold_->solve_motion(time(), now.q, now.v, a, lambda)) return {};
    return unbounded_multiplier(*system_, start_.scales, manifold_->equations().w, lambda, lambda_at_start_);
  } catch (const std::exception&) {
    return {};  // the run is stopping: what stops it is known already
  }
}

}  // namespace dalembert
