#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/erk/runge_kutta.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

namespace dalembert {

namespace {

constexpr double not_ahead = std::numeric_limits<double>::infinity();
/// An estimate is right within this factor.
constexpr double margin_of_gap = 5.0;

/// Where the parabola through the squares of three sines has its minimum; none if it has none.
std::optional<Angle> least_of_parabola(const std::array<Angle, 3>& at) {
  const auto square = [&](std::size_t i) { return at[i].sine * at[i].sine; };
  const double d01 = (square(1) - square(0)) / (at[1].t - at[0].t);
  const double d12 = (square(2) - square(1)) / (at[2].t - at[1].t);
  const double curvature = (d12 - d01) / (at[2].t - at[0].t);
  if (!(curvature > 0.0)) return std::nullopt;
  const double t = 0.5 * (at[0].t + at[1].t) - 0.5 * d01 / curvature;
  const double least = square(0) + (t - at[0].t) * (d01 + (t - at[1].t) * curvature);
  return Angle{t, std::sqrt(std::max(least, 0.0))};
}

}  // namespace

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
ErkStepper::RungeKutta::Passing ErkStepper::RungeKutta::pass_singular_position() {
  const double left = time_left();
  if (left == not_ahead) {
    next_attempt = not_ahead;
    best_extrapolation = none_yet;
    only_close = false;
    return Passing::none;
  }
  if (h <= 0.5 * left && (to.sine > constants.search_sine || left > next_attempt)) return Passing::none;
  next_attempt = left / constants.node_ratio;
  try {
    double singular = to.t + left;
    const double lowest = find_singular(singular);
    only_close = lowest > constants.regular_ratio * to.sine || passes_beside(singular);
    if (only_close) return Passing::none;
    if (lowest <= constants.singular_ratio * to.sine && extrapolate_past(singular)) return Passing::passed;
    h = std::min(h, 0.5 * std::min(left, singular - to.t));
  } catch (const EquationFault& error) {
    fault = error.what();
    h = std::min(h, 0.5 * left);
  }
  usual = std::min(usual, h);
  return Passing::ahead;
}

double ErkStepper::RungeKutta::time_left() const {
  return steps > 0 && from.rows == to.rows ? time_to_singular(from.angle(), to.angle()) : not_ahead;
}

/// Whether a long step may have crossed a singular position that was not in sight where it began.
bool ErkStepper::RungeKutta::may_have_passed() const {
  const double first = angles[0].sine;
  if (!(least.sine < constants.close_to_dependent && least.sine < 0.5 * first)) return false;
  return !only_close || least_between_stages() < constants.regular_ratio * first;
}

/// The least sine, if the angle has passed it.
double ErkStepper::RungeKutta::least_between_stages() const {
  Angle before = angles[0], after{none_yet, 1.0};
  for (const Angle& angle : angles) {
    if (angle.t < least.t && angle.t > before.t) before = angle;
    if (angle.t > least.t && angle.t < after.t) after = angle;
  }
  if (!(before.t < least.t && after.t < none_yet)) return least.sine;
  const auto lowest = least_of_parabola({before, least, after});
  return lowest ? lowest->sine : least.sine;
}

void ErkStepper::RungeKutta::extrapolate(std::size_t nodes, double t, Node& out) {
  const auto [v, a] = halves(out.va);
  extrapolation.go(nodes, t, to.q, std::span(to.va).first(n), out.q, v, a);
  out.t = t;
}

/// Refines the time at which the angle of the extrapolated motion is least. Returns its sine there, that of
/// the last node if other rows take over.
double ErkStepper::RungeKutta::find_singular(double& t) {
  constexpr int attempts = 4;
  std::array<Angle, 3> at{from.angle(), to.angle(), {t, 0.0}};
  const double until = to.t + 4.0 * (t - to.t);
  const std::size_t nodes = extrapolation.choose(t);
  Angle lowest = to.angle();
  for (int i = 0; i < attempts && lowest.sine > constants.singular_ratio * to.sine; ++i) {
    extrapolate(nodes, t, middle);
    at[2] = {t, manifold.sine({t, middle.q, halves(middle.va).first})};
    if (manifold.exchanges() != to.rows) return to.sine;
    if (at[2].sine < lowest.sine) lowest = at[2];
    const auto next_guess = least_of_parabola(at);
    if (!next_guess || !(next_guess->t > to.t && next_guess->t < until) || next_guess->t == at[2].t) break;
    t = next_guess->t;
    at[0] = std::exchange(at[1], at[2]);
  }
  t = lowest.t;
  return lowest.sine;
}

/// Whether the motion turns in front of the place where the angle is least, on its own branch: the gap to the
/// other one is then larger than the extrapolated state is wrong by. Steps follow it if they cannot go astray
/// that far unnoticed.
bool ErkStepper::RungeKutta::passes_beside(double singular) {
  constexpr double beside = 1e-3;  // where the matrix is regular
  const std::size_t nodes = extrapolation.choose(singular);
  if (nodes < 2) return false;
  const double t = singular - beside * (singular - to.t);
  extrapolate(nodes, t, next);
  extrapolate(nodes - 1, t, middle);
  const auto lengths = scales.lengths();
  double error = 0.0;
  for (std::size_t i = 0; i < n; ++i) error = std::max(error, std::abs(next.q[i] - middle.q[i]) * lengths[i]);
  const Manifold::Gap gap = manifold.gap({t, next.q, halves(next.va).first}, scales.length);
  if (!(gap.distance > margin_of_gap * std::max(error, gap.rounding))) return false;
  const double unnoticed = constants.most_correction * tolerance * scales.length;
  if (gap.distance > unnoticed) return true;
  std::ostringstream what;
  what << "two branches of the motion, of which " << system->row_label(gap.row)
       << " makes part, pass within a distance of " << gap.distance
       << " of each other here, where it nearly depends on other constraints; steps may leave the right one "
          "unnoticed by "
       << unnoticed << ": ask for a tolerance smaller by " << unnoticed / gap.distance
       << " or more, or make the constraints meet exactly";
  throw StepFailure{what.str(), to.t};
}

/// Whether to accept `next`, with an error of `error` over the tolerance, or the best passage so far in its
/// place. The constraints amplify an error there by 1/sin.
bool ErkStepper::RungeKutta::worth_taking(double error) {
  if (error < best_extrapolation) {
    best_extrapolation = error;
    best_extrapolated = next;
    return error <= std::min(1.0, to.sine);
  }
  if (best_extrapolation * tolerance > Accuracy(tolerance).of_forces()) return false;
  next = best_extrapolated;
  return true;
}

bool ErkStepper::RungeKutta::extrapolate_past(double singular) {
  const std::size_t nodes = extrapolation.choose(singular);
  if (nodes < 2) return false;
  extrapolation.keep_chosen();
  const double beyond = std::min(2.0 * singular - to.t, t_end);
  extrapolate(nodes, beyond, next);
  extrapolate(nodes - 1, beyond, middle);
  weigh(next, 0.0, tolerance);
  for (std::size_t i = 0; i < n; ++i) {
    difference[i] = next.q[i] - middle.q[i];
    difference[n + i] = next.va[i] - middle.va[i];
  }
  if (!worth_taking(weighted_norm())) return false;
  if (next.t < t_end) {
    (void)project();
    note_sine(next);
  }
  const double lost = tolerance * std::exchange(best_extrapolation, none_yet);
  estimated = {.position = lost * scales.length, .velocity = lost * scales.speed()};
  extrapolation_nodes = nodes;
  next_attempt = not_ahead;
  if (next.t > singular) ++singular_positions;
  return true;
}

/// Between the nodes on both sides of a singular position.
void ErkStepper::RungeKutta::read_extrapolation(double t, std::span<double> q, std::span<double> v) const {
  extrapolation.read(extrapolation_nodes, t, {from.t, from.q, std::span(from.va).first(n)},
                     {to.t, to.q, std::span(to.va).first(n)}, q, v);
}

}  // namespace dalembert
