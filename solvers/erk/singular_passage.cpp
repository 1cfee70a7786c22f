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

ErkStepper::SingularPassage::SingularPassage(RungeKutta& method, std::size_t coordinates)
    : rk_(method), extrapolation_(coordinates) {}

ErkStepper::SingularPassage::Outcome ErkStepper::SingularPassage::attempt() {
  const double left = time_left();
  if (left == not_ahead) {
    next_attempt_ = not_ahead;
    best_extrapolation_ = none_yet;
    only_close_ = false;
    return Outcome::none;
  }
  if (rk_.h <= 0.5 * left && (rk_.to.sine > constants.search_sine || left > next_attempt_))
    return Outcome::none;
  next_attempt_ = left / constants.node_ratio;
  try {
    double singular = rk_.to.t + left;
    const double lowest = find_singular(singular);
    only_close_ = lowest > constants.regular_ratio * rk_.to.sine || passes_beside(singular);
    if (only_close_) return Outcome::none;
    if (lowest <= constants.singular_ratio * rk_.to.sine && take(singular)) return Outcome::passed;
    rk_.h = std::min(rk_.h, 0.5 * std::min(left, singular - rk_.to.t));
  } catch (const EquationFault& error) {
    rk_.fault = error.what();
    rk_.h = std::min(rk_.h, 0.5 * left);
  }
  rk_.usual = std::min(rk_.usual, rk_.h);
  return Outcome::ahead;
}

double ErkStepper::SingularPassage::time_left() const {
  return rk_.steps > 0 && rk_.from.rows == rk_.to.rows ? time_to_singular(rk_.from.angle(), rk_.to.angle())
                                                       : not_ahead;
}

void ErkStepper::SingularPassage::start_step(const Node& start) {
  angles_.fill(start.angle());
  least_ = angles_[0];
  rows_of_angles_ = start.rows;
}

/// On the way to the stage other rows may have taken over.
void ErkStepper::SingularPassage::note_angle(std::size_t i, double t) {
  angles_[i] = {t, rk_.manifold.sine()};
  if (rk_.manifold.exchanges() != rows_of_angles_) {
    rows_of_angles_ = rk_.manifold.exchanges();
    angles_.fill(angles_[i]);
    least_ = angles_[i];
  }
  if (angles_[i].sine < least_.sine) least_ = angles_[i];
}

bool ErkStepper::SingularPassage::may_have_passed() const {
  const double first = angles_[0].sine;
  if (!(least_.sine < constants.close_to_dependent && least_.sine < 0.5 * first)) return false;
  return !only_close_ || least_between_stages() < constants.regular_ratio * first;
}

/// The least sine, if the angle has passed it.
double ErkStepper::SingularPassage::least_between_stages() const {
  Angle before = angles_[0], after{none_yet, 1.0};
  for (const Angle& angle : angles_) {
    if (angle.t < least_.t && angle.t > before.t) before = angle;
    if (angle.t > least_.t && angle.t < after.t) after = angle;
  }
  if (!(before.t < least_.t && after.t < none_yet)) return least_.sine;
  const auto lowest = least_of_parabola({before, least_, after});
  return lowest ? lowest->sine : least_.sine;
}

void ErkStepper::SingularPassage::extrapolate(std::size_t nodes, double t, Node& out) {
  extrapolation_.go(nodes, t, rk_.to.q(), rk_.to.v(), out.q(), out.v(), out.a());
  out.t = t;
}

/// Refines the time at which the angle of the extrapolated motion is least. Returns its sine there, that of
/// the last node if other rows take over.
double ErkStepper::SingularPassage::find_singular(double& t) {
  constexpr int attempts = 4;
  std::array<Angle, 3> at{rk_.from.angle(), rk_.to.angle(), {t, 0.0}};
  const double until = rk_.to.t + 4.0 * (t - rk_.to.t);
  const std::size_t nodes = extrapolation_.choose(t);
  Angle lowest = rk_.to.angle();
  for (int i = 0; i < attempts && lowest.sine > constants.singular_ratio * rk_.to.sine; ++i) {
    extrapolate(nodes, t, rk_.middle);
    at[2] = {t, rk_.manifold.sine(rk_.middle.instant())};
    if (rk_.manifold.exchanges() != rk_.to.rows) return rk_.to.sine;
    if (at[2].sine < lowest.sine) lowest = at[2];
    const auto next_guess = least_of_parabola(at);
    if (!next_guess || !(next_guess->t > rk_.to.t && next_guess->t < until) || next_guess->t == at[2].t)
      break;
    t = next_guess->t;
    at[0] = std::exchange(at[1], at[2]);
  }
  t = lowest.t;
  return lowest.sine;
}

/// Whether the motion turns in front of the place where the angle is least, on its own branch: the gap to the
/// other one is then larger than the extrapolated state is wrong by. Steps follow it if they cannot go astray
/// that far unnoticed.
bool ErkStepper::SingularPassage::passes_beside(double singular) {
  constexpr double beside = 1e-3;  // where the matrix is regular
  const std::size_t nodes = extrapolation_.choose(singular);
  if (nodes < 2) return false;
  const double t = singular - beside * (singular - rk_.to.t);
  extrapolate(nodes, t, rk_.next);
  extrapolate(nodes - 1, t, rk_.middle);
  const auto lengths = rk_.errors.lengths();
  double error = 0.0;
  for (std::size_t i = 0; i < rk_.n; ++i)
    error = std::max(error, std::abs(rk_.next.q()[i] - rk_.middle.q()[i]) * lengths[i]);
  const Manifold::Gap gap = rk_.manifold.gap(rk_.next.instant(), rk_.errors.scales().length);
  if (!(gap.distance > margin_of_gap * std::max(error, gap.rounding))) return false;
  const double unnoticed = constants.most_correction * rk_.errors.tolerance() * rk_.errors.scales().length;
  if (gap.distance > unnoticed) return true;
  std::ostringstream what;
  what << "two branches of the motion, of which " << rk_.system->row_label(gap.row)
       << " makes part, pass within a distance of " << gap.distance
       << " of each other here, where it nearly depends on other constraints; steps may leave the right one "
          "unnoticed by "
       << unnoticed << ": ask for a tolerance smaller by " << unnoticed / gap.distance
       << " or more, or make the constraints meet exactly";
  throw StepFailure{what.str(), rk_.to.t};
}

/// Whether to accept `next`, with an error of `error` over the tolerance, or the best passage so far in its
/// place. The constraints amplify an error there by 1/sin.
bool ErkStepper::SingularPassage::worth_taking(double error) {
  if (error < best_extrapolation_) {
    best_extrapolation_ = error;
    best_extrapolated_ = rk_.next;
    return error <= std::min(1.0, rk_.to.sine);
  }
  if (best_extrapolation_ * rk_.errors.tolerance() > Accuracy(rk_.errors.tolerance()).of_forces())
    return false;
  rk_.next = best_extrapolated_;
  return true;
}

bool ErkStepper::SingularPassage::take(double singular) {
  const std::size_t nodes = extrapolation_.choose(singular);
  if (nodes < 2) return false;
  extrapolation_.keep_chosen();
  const double beyond = std::min(2.0 * singular - rk_.to.t, rk_.t_end);
  extrapolate(nodes, beyond, rk_.next);
  extrapolate(nodes - 1, beyond, rk_.middle);
  if (!worth_taking(rk_.errors.distance(rk_.middle, rk_.next))) return false;
  if (rk_.next.t < rk_.t_end) {
    (void)rk_.project();
    rk_.note_sine(rk_.next);
  }
  rk_.errors.estimate_as(rk_.errors.tolerance() * std::exchange(best_extrapolation_, none_yet));
  extrapolation_nodes_ = nodes;
  next_attempt_ = not_ahead;
  if (rk_.next.t > singular) ++singular_positions_;
  return true;
}

void ErkStepper::SingularPassage::read(double t, std::span<double> q, std::span<double> v) const {
  extrapolation_.read(extrapolation_nodes_, t, rk_.from.instant(), rk_.to.instant(), q, v);
}

}  // namespace dalembert
