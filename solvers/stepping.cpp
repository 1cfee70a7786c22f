#include "dalembert/solvers/stepping.h"

#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/erk/erk.h>
#include <dalembert/solvers/ida/ida.h>
#include <dalembert/solvers/run/diagnosis.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

namespace {

std::unique_ptr<TimeStepper> make_stepper(const Problem& problem, const Start& start,
                                          const Options& options) {
  if (options.stepper == Stepper::erk) return std::make_unique<ErkStepper>(problem, start, options);
  return std::make_unique<IdaStepper>(problem, start, options);
}

}  // namespace

Start first_start(const Problem& problem, std::span<const double> q, std::span<const double> v,
                  const Options& options, double nearest_contact) {
  Start start = consistent_start(problem, q, v, options, nearest_contact);
  if (!start.scales.of_path) return start;
  try {
    ErkStepper first(problem, start, options);
    first.step(options.t_end);
    const Scales& scales = first.scales();
    start.scales.of_path = scales.way.length > Scales::least;  // else it rests, and any length will do
    if (start.scales.of_path) start.scales.take(scales.way);
  } catch (const StepFailure&) {
    start.scales.of_path = false;  // the run will stop, and say why
  }
  return start;
}

Stepping::Stepping(std::shared_ptr<const System> of, std::span<const double> q, std::span<const double> v,
                   const Options& options, double nearest_contact)
    : problem_(std::move(of)),
      options_(options),
      start_(first_start(problem_, q, v, options, nearest_contact)),
      lambda_at_start_(start_.lambda),
      state_{start_.q, start_.v} {
  if (system().compliant()) springs_ = Springs(start_.lambda.size());
  const auto number = [](std::size_t equations) { return static_cast<int>(equations); };
  past_.degrees_of_freedom =
      number(system().coordinates() + system().compliant_rows()) - number(start_.rows.size());
  past_.redundant_equations = number(system().rows_in_force() - start_.rows.size());
  if (options.dense) kept_ = std::make_shared<KeptSteps>(shared_system(), options.tolerance);
  begin(options_);
  unkept_ = options.t_start;
  keep_step();
}

/// At options.t_start, from start_. If that fails, what there was still tells how far the run has come.
void Stepping::begin(const Options& options) {
  Reader reader(problem_, start_, options.t_start, options_.tolerance);
  auto stepper = make_stepper(problem_, start_, options);
  std::optional<Sticking> sticking;
  if (system().frictional() && options_.stepper == Stepper::ida)
    sticking.emplace(problem_, start_, options.t_start, options_.tolerance);
  reader_.emplace(std::move(reader));
  stepper_ = std::move(stepper);
  sticking_.reset();
  if (sticking) sticking_.emplace(std::move(*sticking));
  angle_ = {options.t_start, 1.0};
  if (kept_) own_steps().begin(start_, options.t_start);
}

/// What was handed out stays as it is.
KeptSteps& Stepping::own_steps() {
  if (kept_.use_count() > 1) kept_ = std::make_shared<KeptSteps>(*kept_);
  return *kept_;
}

void Stepping::keep_step() {
  if (!kept_ || !unkept_) return;
  own_steps().add(*stepper_, *unkept_, steps_);
  unkept_.reset();
}

void Stepping::step(double wanted) {
  keep_step();  // if it could not be kept before
  // Before a step, so that all output within the last has been read from the stepper that took it.
  exchange_rows();
  if (options_.stepper == Stepper::ida) watch_sine();
  if (steps_++ == 0) watch_sliding();
  try {
    const double from = time();
    stepper_->step(wanted);
    unkept_ = from;
  } catch (const StepFailure&) {
    // Newton's iteration may fail anywhere; where the constraints are close to dependent the explicit
    // stepper goes on.
    if (handed_over_ || options_.stepper == Stepper::erk || !(stepper_->sine() < constants.handover_sine))
      throw;
    hand_over();
  }
  keep_step();
  watch_sliding();
}

void Stepping::read(double t, Moment& m) {
  keep_step();  // if it could not be kept before
  m.t = t;
  stepper_->interpolate(t, m.q, m.v);
  reader_->read(m, springs_at(t), steps_);
  past_.residual_position = std::max(past_.residual_position, m.position.size);
  past_.residual_velocity = std::max(past_.residual_velocity, m.velocity.size);
  past_.correction = std::max(past_.correction, m.correction);
}

/// The stepper's state, with the forces that it has found for compliant constraints.
const Stepping::State& Stepping::interpolate(double t) {
  stepper_->interpolate(t, state_.q, state_.v);
  if (const Springs* const springs = springs_at(t)) reader_->manifold().follow(*springs);
  return state_;
}

/// If they are part of the stepper's state.
const Springs* Stepping::springs_at(double t) {
  return system().compliant() && stepper_->springs(t, springs_) ? &springs_ : nullptr;
}

/// The rows in use are independent at the start of the run; on the way they may come to depend on each
/// other while others do not.
void Stepping::exchange_rows() {
  if (start_.rows.size() == system().rows_in_force()) return;
  const State& now = interpolate(time());
  if (reader_->better_rows({time(), now.q, now.v})) restart(handed_over_ ? Stepper::erk : options_.stepper);
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

void Stepping::begin_changed(double t, std::shared_ptr<const System> system, std::span<const double> q,
                             std::span<const double> v) {
  keep_step();  // if it could not be kept before
  Problem problem(std::move(system));
  Start start = dalembert::begin_changed(problem, start_, t, q, v, options_.tolerance);
  if (start.scales.of_path) {  // a first step, see IdaStepper, must advance the time
    const double rounding = constants.roundings_of_path * epsilon * std::abs(t);
    Way way = start.scales.way;
    way.length = std::max(
        way.length, way.speed * rounding / (constants.first_implicit_step * std::sqrt(options_.tolerance)));
    start.scales.take(way);
  }
  past_ = statistics();
  past_.advice.clear();
  start_ = std::move(start);
  handed_over_ = false;
  Options from_here = options_;
  from_here.t_start = t;
  if (kept_) own_steps().change(t, problem.shared_system());
  problem_ = std::move(problem);
  begin(from_here);
}

/// A fresh choice of rows and a fresh stepper where the present one stands.
void Stepping::restart(Stepper kind) {
  const double t = time();
  State now = interpolate(t);
  // The explicit stepper takes -g/C for the forces of compliant constraints: g must be as exact.
  if (system().compliant())
    reader_->manifold().project_positions(t, now.q, now.v, 0.1 * start_.scales.rounding(now.q));
  past_ = statistics();
  past_.advice.clear();  // of a crossing it would be about the wrong stepper
  Options from_here = options_;
  from_here.t_start = t;
  from_here.stepper = kind;
  // Close to a singular position a step of the explicit stepper is to err by no more than one of the other.
  if (kind != options_.stepper)
    from_here.tolerance =
        std::max(tolerance_of_a_step(options_.stepper, options_.tolerance), smallest_tolerance);
  start_ = begin_anew(problem_, start_, t, now.q, now.v);
  begin(from_here);
}

Statistics Stepping::statistics() const {
  Statistics s = past_;
  stepper_->count(s);
  reader_->count(s);
  if (handed_over_) s.advice.clear();
  return s;
}

std::string Stepping::unbounded_multiplier() {
  try {
    State now = interpolate(time());
    std::vector<double> a(now.q.size()), lambda(lambda_at_start_.size());
    Manifold& manifold = reader_->manifold();
    if (!manifold.solve_motion(time(), now.q, now.v, a, lambda)) return {};
    return dalembert::unbounded_multiplier(system(), start_.scales, manifold.equations().w, lambda,
                                           lambda_at_start_);
  } catch (const std::exception&) {
    return {};  // the run is stopping: what stops it is known already
  }
}

}  // namespace dalembert
