#include "dalembert/solvers/run/sticking.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/accuracy.h>
#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/step_failure.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

namespace {

/// How closely the reversal of a friction is located, as a fraction of the way between the states given.
constexpr double next_to = 1e-9;

/// to = the point at `part` of the way from a to b.
void between(const Motion& a, const Motion& b, double part, Motion& to) {
  to.t = a.t + part * (b.t - a.t);
  to.q.resize(a.q.size());
  to.v.resize(a.v.size());
  for (std::size_t i = 0; i < a.q.size(); ++i) {
    to.q[i] = a.q[i] + part * (b.q[i] - a.q[i]);
    to.v[i] = a.v[i] + part * (b.v[i] - a.v[i]);
  }
}

}  // namespace

void move(const Motion& from, double duration, Motion& to) {
  to.t = from.t + duration;
  to.q.resize(from.q.size());
  to.v.resize(from.v.size());
  for (std::size_t i = 0; i < from.q.size(); ++i) {
    to.q[i] = from.q[i] + duration * (from.v[i] + 0.5 * duration * from.a[i]);
    to.v[i] = from.v[i] + duration * from.a[i];
  }
}

std::string Sticking::message(const Switches& switches, std::size_t friction) {
  return switches.friction(friction) +
         " would stick here: the sliding velocity is zero, and friction exceeds the driving force both ways. "
         "A law that jumps there describes sliding only; smooth it, v / sqrt(v^2 + small^2) in place of the "
         "direction of v, or end the run here";
}

Sticking::Sticking(const Problem& problem, const Start& start, double tolerance)
    : system_(&problem.system()),
      manifold_(problem, start.rows, start.scales.lengths()),
      switches_(*system_),
      time_(start.scales.time),
      // The square of this, of the scene's time, is what the time of sticking may be wrong by.
      soon_(Accuracy(tolerance).short_time() * time_),
      lambda_(start.lambda) {}

void Sticking::find_slope(const Motion& at, Slope& side) {
  side.resize(system_->forces().friction_pattern().size());
  system_->forces().friction_slope(at.instant(), lambda_, side);
}

bool Sticking::accelerate(Motion& at, Slope& side) {
  at.a.resize(at.q.size());
  if (!manifold_.accelerate(at.instant(), at.a)) return false;
  manifold_.multipliers(lambda_);
  switches_.find(at.instant(), lambda_, side);
  return true;
}

Departure Sticking::leave(const Instant& at, std::span<const double> a, Slope& side) {
  const auto copy = [](std::span<const double> x) { return std::vector<double>(x.begin(), x.end()); };
  Motion start{at.t, copy(at.q), copy(at.v), copy(a)}, later;
  if (!accelerate(start, side) || !switches_.rests(side)) return {};
  move(start, constants.instant_after * time_, later);
  if (!accelerate(later, side)) return {};
  start.a = later.a;
  move(start, constants.instant_after * time_, trial_);
  find_slope(trial_, near_);
  return {switches_.turned(side, near_), true, later.a};
}

bool Sticking::jumps(const Motion& before, const Motion& behind, std::size_t friction) {
  find_slope(before, side_);
  double a = 0.0, b = 1.0;
  while (b - a > next_to) {
    const double middle = 0.5 * (a + b);
    between(before, behind, middle, trial_);
    find_slope(trial_, near_);
    (switches_.turned(side_, near_) ? b : a) = middle;
  }
  find_slope(behind, far_);
  between(before, behind, b, trial_);
  find_slope(trial_, near_);
  const double away = std::min(switches_.steepness(side_, friction), switches_.steepness(far_, friction));
  return switches_.steepness(near_, friction) > 0.5 * away;
}

void Sticking::watch(double t, std::span<const double> q, std::span<const double> v) {
  now_.t = t;
  now_.q.assign(q.begin(), q.end());
  now_.v.assign(v.begin(), v.end());
  // A step may have crossed what has no acceleration, or several (Painleve): that throws.
  static_cast<void>(accelerate(now_, side_));
  if (started_)
    require_no_stop();
  else
    require_leaving();
  std::swap(last_, now_);
  started_ = true;
}

/// Whether what is at rest may leave.
void Sticking::require_leaving() {
  if (!accelerate(now_, side_)) return;
  const Departure departure = leave(now_.instant(), now_.a, side_);
  if (departure.held_by) throw StepFailure{would_stick(*departure.held_by), now_.t};
}

/// In the last step, or soon behind it.
void Sticking::require_no_stop() {
  const double step = now_.t - last_.t;
  find_slope(last_, side_);
  find_slope(now_, near_);
  if (switches_.turned(side_, near_)) return look_ahead(last_, step);
  now_.a.resize(now_.v.size());
  for (std::size_t i = 0; i < now_.v.size(); ++i) now_.a[i] = (now_.v[i] - last_.v[i]) / step;
  move(now_, step, trial_);
  find_slope(trial_, far_);
  if (switches_.turned(near_, far_)) look_ahead(now_, std::min(step, soon_));
}

/// Whether the sliding velocity vanishes so soon.
void Sticking::look_ahead(Motion from, double duration) {
  if (!accelerate(from, near_)) return;
  move(from, duration, trial_);
  find_slope(trial_, far_);
  if (switches_.turned(near_, far_)) require_sliding(from, trial_);
}

/// From before the reversal of a friction to behind it.
void Sticking::require_sliding(const Motion& before, Motion& behind) {
  find_slope(before, side_);
  find_slope(behind, far_);
  const auto friction = switches_.turned(side_, far_);
  Motion after = behind;
  if (!friction || !jumps(before, after, *friction) || !accelerate(after, far_)) return;
  const double t = trial_.t;
  move(after, 8.0 * (after.t - before.t), trial_);
  find_slope(trial_, near_);
  if (!switches_.turned(side_, near_)) throw StepFailure{would_stick(*friction), t};
}

}  // namespace dalembert
