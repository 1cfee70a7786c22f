#include "dalembert/solvers/erk/erk.h"

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/solvers/base/accuracy.h>
#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/erk/hermite.h>
#include <dalembert/solvers/erk/runge_kutta.h>
#include <dalembert/solvers/run/diagnosis.h>

#include <algorithm>
#include <cmath>

namespace dalembert {

ErkStepper::ErkStepper(const Problem& problem, const Start& start, const Options& options)
    : method_(std::make_unique<RungeKutta>(problem, start, options)) {}
ErkStepper::~ErkStepper() = default;

/// Round-off in the projection of a state, over the tolerance: velocities by eps/sin^2, see
/// SingularExtrapolation.
double ErkStepper::RungeKutta::round_off_of_projection() const {
  const double eps = epsilon;
  return constants.roundings_of_step * eps / (std::max(next.sine * next.sine, eps) * errors.tolerance());
}

/// Tries a step into `next`. Returns its error over the tolerance; infinite, with the reason in
/// `fault`, if the equations cannot be evaluated on its way.
double ErkStepper::RungeKutta::attempt(double step) {
  errors.start_attempt();
  switching.start_attempt();
  (void)Branches::strayed();
  strayed = false;
  try {
    if (to.rows != manifold.exchanges()) find_sine(to);
    projected = close_to_singular(step);
    run_stages(to, step, Stages::count - 1, projected);
    stages.finish(to, step, next);
    const bool not_smooth =
        steps == 0 ? starts_at_switch : step < constants.far_too_short * usual && switching.over == 0.0;
    const StepErrors::Step tried{to, next, step, stages.derivatives()};
    const double e = errors.error(tried, not_smooth ? constants.unreliable : 1.0, manifold.equations());
    if (e > 1.0) return e;
    if (steps % check_interval == 0 && stages.at_limit_of_stability(step, errors.scales()))
      stability_limited += check_interval;
    const double correction = project();
    note_sine(next);
    const double of_switch =
        strayed || Branches::strayed() ? switching.effect_of_switch(to, next, step) : 0.0;
    return std::max({e, correction / (constants.most_correction + round_off_of_projection()),
                     errors.disagreement(tried) / constants.most_disagreement, of_switch,
                     switching.error_of_switch(step)});
  } catch (const EquationFault& error) {
    fault = error.what();
    return std::numeric_limits<double>::infinity();
  }
}

double ErkStepper::RungeKutta::shortest() const {
  return 16.0 * epsilon * std::max(std::abs(to.t), errors.scales().time);
}

double ErkStepper::RungeKutta::shorter(double step, double factor) const {
  if (step * factor > shortest()) return step * factor;
  throw StepFailure{fault.empty() ? "the error tolerance cannot be met with any step that double precision "
                                    "resolves: " +
                                        cause()
                                  : fault,
                    to.t};
}

/// What makes steps fail however short they are, as far as the last node tells; round-off does not, see
/// StepErrors::weigh.
std::string ErkStepper::RungeKutta::cause() const {
  if (const auto singular = singular_here(*system, errors.scales(), to.instant()); !singular.empty())
    return singular;
  if (to.sine < constants.close_to_dependent) return "the constraints are nearly linearly dependent here";
  if (2 * stability_limited > steps && steps > 0)
    return "a force is very stiff; Stepper::ida has no such limit";
  return "look for a discontinuous force, or a constraint whose gradient jumps, or ask for a looser "
         "tolerance";
}

/// The step to try: h, or an equal part of the way to the next output time or the end of the run, unless
/// several outputs fall into one step.
double ErkStepper::RungeKutta::step_towards(double wanted) const {
  const double gap = std::min(wanted, t_end) - to.t, next_h = std::min(h, longest);
  if (gap < 0.5 * next_h && wanted < t_end) return std::min(next_h, t_end - to.t);
  return std::min(longest, gap / std::max(1.0, std::ceil(gap / next_h - constants.stretch)));
}

/// Accepts `next` as the end of a step.
void ErkStepper::RungeKutta::accept(bool by_extrapolation) {
  usual = std::max(next.t - to.t, constants.step_memory * usual);
  errors.accept();
  ++steps;
  has_middle = false;
  extrapolated = by_extrapolation;
  std::swap(from, to);
  std::swap(to, next);
  singular.remember(to.t, to.a());
}

void ErkStepper::step(double wanted) {
  RungeKutta& s = *method_;
  s.fault.clear();
  if (s.switching.end) throw StepFailure(*s.switching.end);
  if (s.steps == 0) s.switching.find_first_side();
  if (s.singular.attempt() == SingularPassage::Outcome::passed) {
    s.accept(true);
    return s.switching.find_side_again();
  }
  if (s.steps % RungeKutta::check_interval == 0) s.errors.measure_round_off(s.to, s.manifold, s.switching);
  double growth = constants.most_growth;
  for (;;) {
    const double step =
        s.switching.over > 0.0 ? std::min(s.switching.over, s.t_end - s.to.t) : s.step_towards(wanted);
    const double error = s.attempt(step);
    if (s.singular.may_have_passed()) {  // look again from closer
      s.h = s.shorter(step, 0.5 * (s.singular.least_angle().t - s.to.t) / step);
      s.switching.over = 0.0;
      growth = 1.0;
      continue;
    }
    const double factor = std::isfinite(error)
                              ? constants.safety * std::pow(error, -1.0 / RungeKutta::pair.order)
                              : constants.after_fault;
    if (error <= 1.0) {
      s.h = step * std::min(factor, growth);
      s.switching.over = 0.0;
      break;
    }
    if (s.failures++ % RungeKutta::check_interval == 0)
      s.errors.measure_round_off(s.to, s.manifold, s.switching);
    growth = 1.0;
    s.switching.over = 0.0;
    if (s.switching.stop_short(step)) break;
    s.h = s.shorter(step, std::max(factor, constants.most_shrinking));
  }
  // Round-off in the sum must not leave the last part of the way short of its goal.
  const double goal = std::min(wanted, s.t_end);
  if (std::abs(s.next.t - goal) <= converged_to * std::max(std::abs(goal), s.errors.scales().time)) {
    s.errors.put_off(goal - s.next.t);
    s.next.t = goal;
  }
  s.accept(false);

  s.switching.go_on_behind_switch();
}

const Scales& ErkStepper::scales() const { return method_->errors.scales(); }
void ErkStepper::starts_at_switch() { method_->starts_at_switch = true; }
void ErkStepper::hold_sides(const Branches::Sides& held) { method_->held = &held; }
/// The last attempt may have been another step than that which was taken.
std::span<const Compared> ErkStepper::compared() const {
  const RungeKutta& s = *method_;
  if (s.held == nullptr || s.extrapolated) return {};
  const double h = s.to.t - s.from.t;
  for (std::size_t j = 0; j < s.compared.size(); ++j) {
    const double t = s.from.t + RungeKutta::pair.c[RungeKutta::noted[j]] * h;
    if (!(std::abs(s.compared[j].t - t) <= 1e-3 * h)) return {};
  }
  return s.compared;
}
double ErkStepper::time() const { return method_->to.t; }
double ErkStepper::sine() const { return method_->to.sine; }
StepError ErkStepper::error() const { return method_->errors.reached(); }

/// Velocities are the derivative of the polynomial of positions, but for its round-off, that of positions and
/// times over h: where the cubic of velocities and accelerations at both ends is right to that, the
/// polynomial that takes the middle, too, is better.
void ErkStepper::interpolate(double t, std::span<double> q, std::span<double> v) {
  RungeKutta& s = *method_;
  for (const Node* node : {&s.to, &s.from}) {
    if (t != node->t) continue;
    std::ranges::copy(node->q(), q.begin());
    std::ranges::copy(node->v(), v.begin());
    return;
  }
  if (s.extrapolated) return s.singular.read(t, q, v);
  s.find_middle();
  const Hermite<3> polynomial({s.from.t, s.middle.t, s.to.t}, t);
  const Hermite<3, 2> of_velocities({s.from.t, s.middle.t, s.to.t}, t);
  const Hermite<2, 2> of_ends({s.from.t, s.to.t}, t);
  const double rounding = s.errors.scales().rounding(s.to.q()), h = s.to.t - s.from.t,
               of_time = 10.0 * epsilon * std::abs(s.to.t);
  for (std::size_t i = 0; i < s.n; ++i) {
    const std::array speeds{s.from.v()[i], s.middle.v()[i], s.to.v()[i]},
        accelerations{s.from.a()[i], s.middle.a()[i], s.to.a()[i]};
    const auto x = polynomial({s.from.q()[i], s.middle.q()[i], s.to.q()[i]}, speeds, accelerations);
    const double better = of_velocities(speeds, accelerations).value;
    const double cubic = of_ends({speeds[0], speeds[2]}, {accelerations[0], accelerations[2]}).value;
    const double round_off = 10.0 * (rounding + of_time * std::abs(speeds[0])) / h;
    q[i] = x.value;
    v[i] = std::abs(cubic - better) <= round_off ? better : x.derivative;
  }
}

/// The polynomial of degree 5 through both ends.
void ErkStepper::sketch(double t, std::span<double> q, std::span<double> v) {
  const RungeKutta& s = *method_;
  if (s.extrapolated || s.has_middle || s.from.t == s.to.t) return interpolate(t, q, v);
  const Hermite<2> of_ends({s.from.t, s.to.t}, t);
  for (std::size_t i = 0; i < s.n; ++i) {
    const auto x =
        of_ends({s.from.q()[i], s.to.q()[i]}, {s.from.v()[i], s.to.v()[i]}, {s.from.a()[i], s.to.a()[i]});
    q[i] = x.value;
    v[i] = x.derivative;
  }
}

void ErkStepper::count(Statistics& statistics) const {
  const RungeKutta& s = *method_;
  statistics.steps += s.steps;
  statistics.evaluations += s.manifold.evaluations();
  statistics.factorisations += s.manifold.factorisations();
  statistics.error_test_failures += s.failures;
  statistics.singular_positions += s.singular.passed();
  statistics.linear_algebra = s.manifold.method();
  statistics.stability_limited += s.stability_limited;
  if (2 * s.stability_limited > s.steps)
    statistics.advice =
        "stability, not accuracy, limited most steps: looser tolerances will hardly be faster; "
        "Stepper::ida has no such limit, but takes more steps: try whether it is faster";
}

}  // namespace dalembert
