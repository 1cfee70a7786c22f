#include "dalembert/solvers/integration.h"

#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/erk/erk.h>
#include <dalembert/solvers/ida/ida.h>
#include <dalembert/solvers/opening.h>
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

Integration::Integration(const Problem& problem, Start start, const Branches::Sides& sides,
                         const Options& options)
    : options_(options) {
  lambda_at_start_ = start.lambda;
  state_ = {start.q, start.v};
  if (problem.system().compliant()) compliant_ = CompliantMultipliers(start.lambda.size());
  const double t = options.t_start;
  Comparisons comparisons(problem, start, t, tolerance_of_a_step(options.stepper, options.tolerance), sides);
  segment_ = make_segment(problem, std::move(start), t, options.stepper, std::move(comparisons));
  if (!sides.empty()) behind_ = {t, t, *segment_->comparisons.held()};
  switch_ = segment_->comparisons.at_start();
  const auto number = [](std::size_t equations) { return static_cast<int>(equations); };
  const auto& rows = this->start().rows.rows;
  const std::size_t active = rows.size();
  const auto rigid = std::ranges::count_if(rows, [&](auto r) { return !system().law(r).compliant(); });
  past_.degrees_of_freedom = number(system().coordinates()) - static_cast<int>(rigid);
  past_.redundant_equations = number(system().rows_in_force() - active);
  angle_ = {options.t_start, 1.0};
  scales_at_step_ = this->start().scales;
  from_ = options.t_start;
  if (options.dense) {
    kept_ = std::make_shared<KeptSteps>(options.tolerance);
    kept_->add_segment(*segment_, options.t_start);
  }
  keep_step(options.t_start);
}

Options Integration::options_from(double t, Stepper by) const {
  Options options = options_;
  options.t_start = t;
  options.stepper = by;
  if (by != options_.stepper) {
    // Close to a singular position a step of the explicit stepper is to err by no more than one of the other,
    // as far as round-off allows that.
    const bool lost = lost_to_round_off(sine_at_handover_);
    const double of_a_step =
        lost ? options_.tolerance : tolerance_of_a_step(options_.stepper, options_.tolerance);
    options.tolerance = std::max(of_a_step, smallest_tolerance);
  }
  return options;
}

/// The sides behind a switch that was left at this time. (What slides may be other batches than before.)
std::optional<Comparisons::Behind> Integration::behind_at(const System& system, double t) const {
  if (!behind_ || behind_->t != t) return std::nullopt;
  Comparisons::Behind behind = *behind_;
  behind.sides.resize(std::min(behind.sides.size(), system.stated_batches()));
  return behind;
}

/// From `start` at time t. Between two sides it waits for go_behind_switch().
std::unique_ptr<Segment> Integration::make_segment(const Problem& problem, Start start, double t,
                                                   Stepper by) const {
  const double tolerance = tolerance_of_a_step(by, options_.tolerance);
  if (auto behind = behind_at(problem.system(), t)) {
    Comparisons there(problem, start, tolerance, *std::move(behind));
    return make_segment(problem, std::move(start), t, by, std::move(there));
  }
  Comparisons comparisons(problem, start, t, tolerance);
  return make_segment(problem, std::move(start), t, by, std::move(comparisons));
}

std::unique_ptr<Segment> Integration::make_segment(const Problem& problem, Start start, double t, Stepper by,
                                                   Comparisons comparisons) const {
  if (!resolves_motion(start.scales, t)) throw StepFailure{coarse_time(start.scales, t), t};
  const Options options = options_from(t, by);
  std::unique_ptr<TimeStepper> stepper;
  {
    const Branches holding(nullptr, comparisons.held());
    if (start.scales.waits_for_path && !comparisons.at_start())
      measure_path(problem, start, options, comparisons.held() ? *comparisons.held() : Branches::Sides{});
    stepper = make_stepper(problem, start, options);
  }
  OutputProjection output(problem, start, options_.tolerance);
  auto made = std::make_unique<Segment>(Segment{problem, std::move(start), std::move(comparisons), by,
                                                std::move(output), std::move(stepper), std::nullopt});
  if (const Branches::Sides* const held = made->comparisons.held()) made->stepper->hold_sides(*held);
  // A run by the explicit stepper finds itself where friction sticks.
  if (problem.system().forces().has_friction() && options_.stepper == Stepper::ida)
    made->sticking.emplace(problem, made->start, options_.tolerance);
  return made;
}

/// With the strong guarantee: what may throw is made before anything here changes.
void Integration::enter_segment(std::unique_ptr<Segment> next) {
  Statistics past = statistics(time());
  past.advice.clear();  // beside a singular position it would be about the wrong stepper
  const double t = next->stepper->time();
  if (kept_) own_steps().add_segment(*next, t);
  past_ = std::move(past);
  angle_ = {t, 1.0};
  segment_ = std::move(next);
  switch_ = segment_->comparisons.at_start();
  scales_at_step_ = start().scales;
  from_ = t;
}

/// What was handed out stays as it is.
KeptSteps& Integration::own_steps() {
  if (kept_.use_count() > 1) kept_ = std::make_shared<KeptSteps>(*kept_);
  return *kept_;
}

std::shared_ptr<const DenseOutput> Integration::dense(double end) {
  if (kept_ && kept_->end() > end) own_steps().end(end);
  return kept_;
}

void Integration::keep_step(double from) {
  const Branches holding = segment_->hold();
  if (kept_) own_steps().add(*segment_->stepper, from, steps_);
}

/// What fails behind a switch, as what throws from a time on, is not reached by the step that ends there.
void Integration::find_switch(double from) try {
  switch_ = segment_->comparisons.leave(*segment_->stepper);
} catch (const EquationFault& fault) {
  throw StepFailure{fault.what(), from};
}

void Integration::step(double wanted) {
  // Before a step, so that all output within the last has been read from the stepper that took it.
  if (switch_) go_behind_switch();
  exchange_rows();
  if (options_.stepper == Stepper::ida) watch_sine();
  if (switch_) go_behind_switch();  // of a segment that was begun between two sides
  if (steps_++ == 0) watch_sliding();
  const double from = time();
  if (scales_at_step_.length_from_path) extend_path(scales_at_step_, from, state_);
  from_ = from;
  try {
    const Branches holding = segment_->hold();
    segment_->stepper->step(wanted);
    error_.add(segment_->stepper->error(), time() - from);
    find_switch(from);
    keep_step(from);
    if (kept_ && switch_) own_steps().ends_at_switch(switch_->at.t - switch_->ahead);
  } catch (const StepFailure&) {
    // Newton's iteration may fail anywhere; where the constraints are close to dependent the explicit
    // stepper goes on.
    const bool singular = segment_->stepper->sine() < constants.handover_sine;
    if (segment_->by == Stepper::erk || !singular) throw;
    hand_over(angle_.sine);
  }
  watch_sliding();
}

void Integration::read(double t, OutputState& m) {
  m.t = t;
  stepper_at(t, m.q, m.v);
  as_read(t, [&] { segment_->output.read(m, compliant_multipliers_at(t), steps_); });
  past_.residual_position = std::max(past_.residual_position, m.position.size);
  past_.residual_velocity = std::max(past_.residual_velocity, m.velocity.size);
  past_.correction = std::max(past_.correction, m.correction);
}

void Integration::read_ahead(double while_after, OutputState& m) {
  const Branches holding = segment_->hold();
  const Start& from = start();
  const double h = while_after;
  m.t = time() + h;
  for (std::size_t i = 0; i < from.q.size(); ++i) {
    m.q[i] = from.q[i] + h * (from.v[i] + 0.5 * h * from.a[i]);
    m.v[i] = from.v[i] + h * from.a[i];
  }
  segment_->output.read(m, nullptr, steps_);
}

/// The stepper's state, with the forces that it has found for compliant constraints.
const Integration::State& Integration::interpolate(double t) {
  stepper_at(t, state_.q, state_.v);
  if (const CompliantMultipliers* const compliant = compliant_multipliers_at(t))
    segment_->output.manifold().use_multipliers(*compliant);
  return state_;
}

/// If they are part of the stepper's state.
const CompliantMultipliers* Integration::compliant_multipliers_at(double t) {
  return system().compliant() && segment_->stepper->compliant_multipliers(t, compliant_) ? &compliant_
                                                                                         : nullptr;
}

/// The implicit stepper's unknowns are the multipliers of the rows that it began with: where others have
/// taken over (see Manifold) it restarts.
void Integration::exchange_rows() {
  if (segment_->by == Stepper::erk || start().rows.size() == system().rows_in_force()) return;
  const State& now = interpolate(time());
  Manifold& manifold = segment_->output.manifold();
  (void)manifold.sine({time(), now.q, now.v});
  if (manifold.rows().rows != start().rows.rows) restart_with_rows(Stepper::ida);
}

/// Whether round-off in the implicit stepper's velocities, see SingularExtrapolation, exceeds the error
/// allowed to its steps: that then decides on their size.
bool Integration::lost_to_round_off(double sine) const {
  return epsilon > sine * sine * tolerance_of_a_step(Stepper::ida, options_.tolerance);
}

/// Isolated singular positions are passed by the explicit stepper (see ErkStepper), from where they come in
/// sight until they are as far behind.
void Integration::watch_sine() {
  const Angle before = angle_, now{time(), segment_->stepper->sine()};
  if (segment_->by == Stepper::ida) {
    const double left = time_to_singular(before, now);
    const bool soon = left < constants.handover_steps * (now.t - before.t);
    if (now.sine < constants.handover_sine && (soon || (std::isfinite(left) && lost_to_round_off(now.sine))))
      return hand_over(now.sine);
  } else if (now.sine > before.sine && now.sine >= sine_at_handover_) {
    return restart_with_rows(Stepper::ida);
  }
  angle_ = now;
}

void Integration::hand_over(double sine) {
  sine_at_handover_ = sine;
  restart_with_rows(Stepper::erk);
}

void Integration::watch_sliding() {
  if (!segment_->sticking) return;
  const State& now = interpolate(time());
  segment_->sticking->watch(time(), now.q, now.v);
}

void Integration::restart_with_constraints(double t, std::shared_ptr<const System> system,
                                           std::span<const double> q, std::span<const double> v) {
  const Problem problem(std::move(system));
  const auto behind = behind_at(problem.system(), t);
  const Branches holding(nullptr, behind ? &behind->sides : nullptr);
  // A path starts again: the shorter flights behind impacts are held to the tolerance as the first ones are.
  Start next = dalembert::restart_with_constraints(problem, start(), t, q, v, options_.tolerance);
  if (next.scales.length_from_path)
    next.scales.adopt_for_first_step(next.scales.extent, t, options_.tolerance);
  enter_segment(make_segment(problem, std::move(next), t, options_.stepper));
}

/// A fresh choice of rows and a fresh stepper where the present one stands.
void Integration::restart_with_rows(Stepper by) {
  const double t = time();
  State now = interpolate(t);
  project_onto_compliant(t, now);
  enter_segment(make_segment(
      problem(), dalembert::restart_with_rows(problem(), start_of_rest(t), t, now.q, now.v), t, by));
}

/// The explicit stepper takes -g/C for the forces of compliant constraints: g must be as exact.
void Integration::project_onto_compliant(double t, State& now) {
  if (!system().compliant()) return;
  segment_->output.manifold().project_positions(t, now.q, now.v, 0.1 * start().scales.rounding(now.q));
}

/// A fresh stepper on the sides behind a switch.
bool Integration::go_behind_switch() {
  const Comparisons::Switch one = *switch_;
  const double t = one.at.t;
  Comparisons& comparisons = segment_->comparisons;
  // Between two of them a motion that is driven back and forth leaves its place by round-off.
  const double brief = std::sqrt(epsilon) * start().scales.time;
  switches_at_once_ = t - std::exchange(last_switch_, t) <= brief ? switches_at_once_ + 1 : 0;
  if (switches_at_once_ > constants.most_at_one_time) comparisons.chatters(one);
  const Comparisons::Behind behind{t, t + one.ahead, one.behind};
  if (const auto row = comparisons.corner(one)) {
    if (!comparisons.holds_at_times(*row)) comparisons.refuse_corner(one, *row);
    behind_ = behind;
    return false;
  }
  comparisons.require_no_impulse(one);
  State now = interpolate(t);
  const Start before = start_of_rest(t);
  {
    // The forces of compliant constraints are those before it, where these have not jumped.
    const Branches before_it = segment_->hold();
    project_onto_compliant(t, now);
  }
  const Branches holding(nullptr, &one.behind);
  Start next = dalembert::restart_with_rows(problem(), before, t, now.q, now.v);
  comparisons.require_leaving(one, next.a);
  Comparisons there(problem(), next, tolerance_of_a_step(segment_->by, options_.tolerance), behind);
  auto made = make_segment(problem(), std::move(next), t, segment_->by, std::move(there));
  made->stepper->starts_at_switch();
  enter_segment(std::move(made));
  behind_ = behind;
  return true;
}

Scales Integration::scales(double t) const {
  Scales now = scales_at_step_;
  State at{start().q, start().v};
  if (now.length_from_path) extend_path(now, t, at);
  return now;
}

/// The way on to a time inside the last step.
void Integration::extend_path(Scales& scales, double t, State& at) const {
  const Branches holding = segment_->hold();
  segment_->stepper->sketch(t, at.q, at.v);
  scales.adopt(scales.extended_by(at.q, at.v, t - from_, options_.tolerance));
}

/// What goes on from there goes on in its scales.
Start Integration::start_of_rest(double t) const {
  Start before = start();
  before.scales = scales(t);
  return before;
}

void Integration::stepper_at(double t, std::span<double> q, std::span<double> v) {
  const Branches holding = segment_->hold();
  segment_->stepper->interpolate(t, q, v);
}

Statistics Integration::statistics(double until) const {
  Statistics s = past_;
  segment_->stepper->count(s);
  const Scales now = scales(until);
  s.length = now.length;
  s.time = now.time;
  segment_->output.count(s);
  if (segment_->by != options_.stepper) s.advice.clear();
  if (s.steps > 0) {
    const auto of_scene = [&](double position, double velocity) {
      return std::max(position / s.length, velocity * s.time / s.length) + error_.shift() / s.time;
    };
    s.accuracy = std::max(options_.tolerance, of_scene(error_.position(), error_.velocity())) +
                 error_.displaced() / s.length;
    s.round_off = of_scene(error_.position_noise(), error_.velocity_noise());
  }
  return s;
}

double Integration::error_of_position(double t) const {
  const Statistics s = statistics(t);
  const double displaced = error_.displaced() / s.length;
  return true_over_estimated * std::max(options_.tolerance, s.accuracy - displaced) + displaced;
}

std::string Integration::chattering_force(double step) {
  const State& now = interpolate(time());
  return dalembert::chattering_force(system(), scales(time()), {time(), now.q, now.v}, step,
                                     options_.tolerance);
}

std::string Integration::unbounded_multiplier() {
  try {
    State now = interpolate(time());
    std::vector<double> a(now.q.size()), lambda(lambda_at_start_.size());
    Manifold& manifold = segment_->output.manifold();
    if (!manifold.solve_motion(time(), now.q, now.v, a, lambda)) return {};
    return dalembert::unbounded_multiplier(system(), start().scales, manifold.equations().w, lambda,
                                           lambda_at_start_);
  } catch (const std::exception&) {
    return {};  // the run is stopping: what stops it is known already
  }
}

}  // namespace dalembert
