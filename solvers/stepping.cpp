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
  Options looking = options;
  looking.tolerance = Options{}.tolerance;  // the scene's length is its own, whatever is asked of the run
  try {
    ErkStepper first(problem, start, looking);
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
    : options_(options) {
  const Problem problem(std::move(of));
  Start start = first_start(problem, q, v, options, nearest_contact);
  lambda_at_start_ = start.lambda;
  state_ = {start.q, start.v};
  if (problem.system().compliant()) springs_ = Springs(start.lambda.size());
  stretch_ = stretch(problem, std::move(start), options.t_start, options.stepper);
  const auto number = [](std::size_t equations) { return static_cast<int>(equations); };
  const auto& rows = this->start().rows.rows;
  const std::size_t active = rows.size();
  const auto rigid = std::ranges::count_if(rows, [&](auto r) { return !system().law(r).compliant(); });
  past_.degrees_of_freedom = number(system().coordinates()) - static_cast<int>(rigid);
  past_.redundant_equations = number(system().rows_in_force() - active);
  angle_ = {options.t_start, 1.0};
  covered_ = this->start().scales;
  from_ = options.t_start;
  if (options.dense) {
    kept_ = std::make_shared<KeptSteps>(options.tolerance);
    kept_->begin(shared_system(), this->start(), options.t_start);
  }
  keep_step(options.t_start);
}

Options Stepping::options_from(double t, Stepper by) const {
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

/// From `start` at time t.
std::unique_ptr<Stepping::Stretch> Stepping::stretch(const Problem& problem, Start start, double t,
                                                     Stepper by) const {
  Comparisons comparisons(problem, start, t, tolerance_of_a_step(by, options_.tolerance));
  if (comparisons.chosen()) {
    const Branches holding(nullptr, comparisons.held());
    start = begin_anew(problem, start, t, start.q, start.v);
  }
  return stretch(problem, std::move(start), t, by, std::move(comparisons));
}

std::unique_ptr<Stepping::Stretch> Stepping::stretch(const Problem& problem, Start start, double t,
                                                     Stepper by, Comparisons comparisons) const {
  const Options options = options_from(t, by);
  Reader reader(problem, start, options_.tolerance);
  std::unique_ptr<TimeStepper> stepper;
  {
    const Branches holding(nullptr, comparisons.held());
    stepper = make_stepper(problem, start, options);
  }
  auto made = std::make_unique<Stretch>(Stretch{problem, std::move(start), std::move(comparisons), by,
                                                std::move(reader), std::move(stepper), std::nullopt});
  if (const Branches::Sides* const held = made->comparisons.held()) made->stepper->listen(*held);
  // A run by the explicit stepper finds itself where friction sticks.
  if (problem.system().frictional() && options_.stepper == Stepper::ida)
    made->sticking.emplace(problem, made->start, options_.tolerance);
  return made;
}

/// Whole, or not begun: whatever may fail has been made before anything here changes.
void Stepping::go_on_with(std::unique_ptr<Stretch> next) {
  Statistics past = statistics(time());
  past.advice.clear();  // of a crossing it would be about the wrong stepper
  const double t = next->stepper->time();
  if (kept_) own_steps().begin(next->problem.shared_system(), next->start, t);
  past_ = std::move(past);
  angle_ = {t, 1.0};
  switch_.reset();
  stretch_ = std::move(next);
  covered_ = start().scales;
  from_ = t;
}

/// What was handed out stays as it is.
KeptSteps& Stepping::own_steps() {
  if (kept_.use_count() > 1) kept_ = std::make_shared<KeptSteps>(*kept_);
  return *kept_;
}

std::shared_ptr<const DenseOutput> Stepping::dense(double end) {
  if (kept_ && kept_->end() > end) own_steps().end(end);
  return kept_;
}

void Stepping::keep_step(double from) {
  const Branches holding = stretch_->hold();
  if (kept_) own_steps().add(*stretch_->stepper, from, steps_);
}

/// What fails behind a switch, as what throws from a time on, is not reached by the step that ends there.
void Stepping::find_switch(double from) try {
  switch_ = stretch_->comparisons.leave(*stretch_->stepper);
} catch (const EquationFault& fault) {
  throw StepFailure{fault.what(), from};
}

void Stepping::step(double wanted) {
  // Before a step, so that all output within the last has been read from the stepper that took it.
  if (switch_) pass_switch();
  exchange_rows();
  if (options_.stepper == Stepper::ida) watch_sine();
  if (steps_++ == 0) watch_sliding();
  const double from = time();
  if (covered_.of_path) cover(covered_, from, state_);
  from_ = from;
  try {
    const Branches holding = stretch_->hold();
    stretch_->stepper->step(wanted);
    error_.add(stretch_->stepper->error(), time() - from);
    find_switch(from);
    keep_step(from);
  } catch (const StepFailure&) {
    // Newton's iteration may fail anywhere; where the constraints are close to dependent the explicit
    // stepper goes on.
    const bool singular = stretch_->stepper->sine() < constants.handover_sine;
    if (stretch_->by == Stepper::erk || !singular) throw;
    hand_over(angle_.sine);
  }
  watch_sliding();
}

void Stepping::read(double t, Moment& m) {
  m.t = t;
  stepper_at(t, m.q, m.v);
  stretch_->reader.read(m, springs_at(t), steps_);
  past_.residual_position = std::max(past_.residual_position, m.position.size);
  past_.residual_velocity = std::max(past_.residual_velocity, m.velocity.size);
  past_.correction = std::max(past_.correction, m.correction);
}

void Stepping::read_ahead(double while_after, Moment& m) {
  const Branches holding = stretch_->hold();
  const Start& from = start();
  const double h = while_after;
  m.t = time() + h;
  for (std::size_t i = 0; i < from.q.size(); ++i) {
    m.q[i] = from.q[i] + h * (from.v[i] + 0.5 * h * from.a[i]);
    m.v[i] = from.v[i] + h * from.a[i];
  }
  stretch_->reader.read(m, nullptr, steps_);
}

/// The stepper's state, with the forces that it has found for compliant constraints.
const Stepping::State& Stepping::interpolate(double t) {
  stepper_at(t, state_.q, state_.v);
  if (const Springs* const springs = springs_at(t)) stretch_->reader.manifold().follow(*springs);
  return state_;
}

/// If they are part of the stepper's state.
const Springs* Stepping::springs_at(double t) {
  return system().compliant() && stretch_->stepper->springs(t, springs_) ? &springs_ : nullptr;
}

/// The implicit stepper's unknowns are the multipliers of the rows that it began with: where others have
/// taken over (see Manifold) it begins anew.
void Stepping::exchange_rows() {
  if (stretch_->by == Stepper::erk || start().rows.size() == system().rows_in_force()) return;
  const State& now = interpolate(time());
  Manifold& manifold = stretch_->reader.manifold();
  (void)manifold.sine({time(), now.q, now.v});
  if (manifold.rows().rows != start().rows.rows) restart(Stepper::ida);
}

/// Whether round-off in the implicit stepper's velocities, see Passage, exceeds the error allowed to its
/// steps: that then decides on their size.
bool Stepping::lost_to_round_off(double sine) const {
  return epsilon > sine * sine * tolerance_of_a_step(Stepper::ida, options_.tolerance);
}

/// Isolated singular positions are passed by the explicit stepper (see ErkStepper), from where they come in
/// sight until they are as far behind.
void Stepping::watch_sine() {
  const Angle before = angle_, now{time(), stretch_->stepper->sine()};
  if (stretch_->by == Stepper::ida) {
    const double left = time_to_singular(before, now);
    const bool soon = left < constants.handover_steps * (now.t - before.t);
    if (now.sine < constants.handover_sine && (soon || (std::isfinite(left) && lost_to_round_off(now.sine))))
      return hand_over(now.sine);
  } else if (now.sine > before.sine && now.sine >= sine_at_handover_) {
    return restart(Stepper::ida);
  }
  angle_ = now;
}

void Stepping::hand_over(double sine) {
  sine_at_handover_ = sine;
  restart(Stepper::erk);
}

void Stepping::watch_sliding() {
  if (!stretch_->sticking) return;
  const State& now = interpolate(time());
  stretch_->sticking->watch(time(), now.q, now.v);
}

void Stepping::begin_changed(double t, std::shared_ptr<const System> system, std::span<const double> q,
                             std::span<const double> v) {
  const Problem problem(std::move(system));
  // A path begins anew: the shorter flights behind impacts are held to the tolerance as the first ones are.
  Start next = dalembert::begin_changed(problem, start(), t, q, v, options_.tolerance);
  if (next.scales.of_path) {  // a first step, see IdaStepper, must advance the time
    const double rounding = constants.roundings_of_path * epsilon * std::abs(t);
    Way way = next.scales.way;
    way.length = std::max(
        way.length, way.speed * rounding / (constants.first_implicit_step * std::sqrt(options_.tolerance)));
    next.scales.take(way);
  }
  go_on_with(stretch(problem, std::move(next), t, options_.stepper));
}

/// A fresh choice of rows and a fresh stepper where the present one stands.
void Stepping::restart(Stepper by) {
  const double t = time();
  State now = interpolate(t);
  put_on_springs(t, now);
  go_on_with(stretch(problem(), begin_anew(problem(), start_of_rest(t), t, now.q, now.v), t, by));
}

/// The explicit stepper takes -g/C for the forces of compliant constraints: g must be as exact.
void Stepping::put_on_springs(double t, State& now) {
  if (!system().compliant()) return;
  stretch_->reader.manifold().project_positions(t, now.q, now.v, 0.1 * start().scales.rounding(now.q));
}

/// A fresh stepper on the sides behind a switch.
void Stepping::pass_switch() {
  const Comparisons::Switch one = *switch_;
  const double t = one.at.t;
  Comparisons& comparisons = stretch_->comparisons;
  // Between two of them a motion that is driven back and forth leaves its place by round-off.
  const double brief = std::sqrt(epsilon) * start().scales.time;
  switches_at_once_ = t - std::exchange(last_switch_, t) <= brief ? switches_at_once_ + 1 : 0;
  if (switches_at_once_ > constants.most_at_one_time) comparisons.chatters(one);
  comparisons.require_no_corner(one);
  State now = interpolate(t);
  const Start before = start_of_rest(t);
  const Branches holding(nullptr, &one.behind);
  put_on_springs(t, now);
  Start next = begin_anew(problem(), before, t, now.q, now.v);
  comparisons.require_leaving(one, next.a);
  Comparisons behind(problem(), next, t, tolerance_of_a_step(stretch_->by, options_.tolerance), t + one.ahead,
                     one.behind);
  auto made = stretch(problem(), std::move(next), t, stretch_->by, std::move(behind));
  made->stepper->begins_at_switch();
  go_on_with(std::move(made));
}

Scales Stepping::scales(double t) const {
  Scales now = covered_;
  State at{start().q, start().v};
  if (now.of_path) cover(now, t, at);
  return now;
}

/// The way on to a time inside the last step.
void Stepping::cover(Scales& way, double t, State& at) const {
  const Branches holding = stretch_->hold();
  stretch_->stepper->sketch(t, at.q, at.v);
  way.take(way.further(at.q, at.v, t - from_, options_.tolerance));
}

/// What goes on from there goes on in its scales.
Start Stepping::start_of_rest(double t) const {
  Start before = start();
  before.scales = scales(t);
  return before;
}

void Stepping::stepper_at(double t, std::span<double> q, std::span<double> v) {
  const Branches holding = stretch_->hold();
  stretch_->stepper->interpolate(t, q, v);
}

Statistics Stepping::statistics(double until) const {
  Statistics s = past_;
  stretch_->stepper->count(s);
  const Scales now = scales(until);
  s.length = now.length;
  s.time = now.time;
  stretch_->reader.count(s);
  if (stretch_->by != options_.stepper) s.advice.clear();
  if (s.steps > 0) {
    s.accuracy =
        std::max({options_.tolerance, error_.position() / s.length, error_.velocity() * s.time / s.length});
    s.round_off = std::max(error_.position_noise() / s.length, error_.velocity_noise() * s.time / s.length);
  }
  return s;
}

std::string Stepping::unbounded_multiplier() {
  try {
    State now = interpolate(time());
    std::vector<double> a(now.q.size()), lambda(lambda_at_start_.size());
    Manifold& manifold = stretch_->reader.manifold();
    if (!manifold.solve_motion(time(), now.q, now.v, a, lambda)) return {};
    return dalembert::unbounded_multiplier(system(), start().scales, manifold.equations().w, lambda,
                                           lambda_at_start_);
  } catch (const std::exception&) {
    return {};  // the run is stopping: what stops it is known already
  }
}

}  // namespace dalembert
