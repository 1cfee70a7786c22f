#include <dalembert/solvers/base/accuracy.h>
#include <dalembert/solvers/contact/coming_to_rest.h>
#include <dalembert/solvers/contact/dry_friction.h>
#include <dalembert/solvers/contact/friction_modes.h>
#include <dalembert/solvers/contact/round_off.h>

#include <algorithm>
#include <cmath>
#include <utility>

/// Dry friction at an instant at which something changes.
namespace dalembert {

namespace {

using Eigen::VectorXd;

/// The part of a speed that counts as none by which directions no longer matter.
constexpr double vanished = 1e-2;

}  // namespace

/// The difference of two times that are the same to round-off.
double DryFriction::same_time(double t) const {
  return round_off() * std::max(std::abs(t), equations_.scales().time);
}

bool DryFriction::own(const RoughState& rough, Triggered triggered, Watched watched) const {
  const auto index = static_cast<std::size_t>(&rough - all_.data());
  return triggered == kinds * index + watched;
}

/// What moves slides; what does not sticks, before FrictionModes decide. A slip that others prescribe is
/// known to round-off, another one as exactly as velocities are.
void DryFriction::set_mode_by_slip(RoughState& rough, const std::vector<std::size_t>& open, double t,
                                   Triggered triggered) {
  const bool slid = rough.mode == Mode::slides, slow = slid && rough.pace != Pace::fast;
  const bool due = own(rough, triggered, mode),
             just = slid && rough.let_go && t - *rough.let_go <= same_time(t);
  rough.at_rest = rough.reached = rough.loses_share = false;
  const bool exerts_nothing =
      rough.mu_static == 0.0 || std::ranges::find(open, rough.pressed_by) != open.end();
  if (exerts_nothing) {
    rough.mode = Mode::absent;
    return;
  }
  if (own(rough, triggered, sign)) rough.sign = -rough.sign;
  const VectorXd u = slip(rough);
  const double none = rough.no_slip(equations_.tolerance());
  const bool stops = due && slid && (rough.rows == 1 || slow),
             moves = slid ? u.dot(rough.direction) > none : rough.shared && u.norm() > none;
  // What begins is known as starts are, not as well as a step has kept the rest of what stuck.
  const double still =
      rough.mode == Mode::absent ? std::min(rough.still, start_tolerance * rough.speed) : rough.still;
  if (stops || (u.norm() <= std::max(still, none) && !moves)) {
    rough.at_rest = true;
    rough.reached = slid ? just : due;
    rough.mode = Mode::sticks;
    rough.begins = true;
    return;
  }
  rough.shared = false;
  rough.begins = rough.begins || !slid || u.dot(rough.direction) <= 0.0;
  if (own(rough, triggered, speed) && rough.is_fast_in_space()) return rough.end_straight(u.normalized());
  if (rough.pace == Pace::straight && slid && !own(rough, triggered, speed) && u.dot(rough.direction) > 0.0)
    return;
  if (slow && u.norm() < 2.0 * rough.slow && u.dot(rough.direction) > 0.0) return;
  rough.mode = Mode::slides;
  rough.direction = u.normalized();
  rough.blur = 0.0;
  rough.pace = rough.rows == 2 && (due || u.norm() < rough.slow) ? Pace::leaves : Pace::fast;
  rough.turns.reset();
}

/// What others that are at rest leave no slip is at rest, too: the slow slip that it still has is an error of
/// the steps, and its direction one of round-off.
void DryFriction::rest_with_others(const std::vector<std::size_t>& open, const Instant& at) {
  const auto may_rest = [&](const RoughState& r) {
    return r.mode == Mode::slides && !r.at_rest && slip(r).norm() <= r.slow;
  };
  for (bool more = std::ranges::any_of(all_, &RoughState::at_rest); more;) {
    more = false;
    if (std::ranges::none_of(all_, may_rest)) return;
    const std::vector<double> v = equations_.velocities_at_rest(all_, open, at);
    const auto before = u_;
    find_slip({at.t, at.q, v});
    const auto after = std::exchange(u_, before);
    slip_at_ = at.t;
    for (RoughState& r : all_) {
      if (!may_rest(r) || r.part(after).norm() > r.no_slip(equations_.tolerance())) continue;
      r.at_rest = more = true;
      r.reached = r.shared = false;
      r.mode = Mode::sticks;
      r.begins = true;
    }
  }
}

/// Whether two slow slip velocities come to rest: then with the direction that they have.
void DryFriction::find_way_to_rest(RoughState& rough, const std::vector<std::size_t>& open,
                                   const Instant& at) {
  const Eigen::Vector2d u = slip(rough);
  const auto motion = equations_.solve(all_, open, at);
  if (!motion.unique.empty() && !motion.unique[rough.pressing_row]) {
    // Of feet that slide one way together none can be let go alone: they rest together on a straight way.
    const Eigen::Vector2d rate = equations_.slip_acceleration(rough, at, motion);
    const double across = std::abs(u[0] * rate[1] - u[1] * rate[0]);
    if (u.dot(rate) >= 0.0 ||
        across > Accuracy(equations_.tolerance()).of_accelerations() * u.norm() * rate.norm())
      return;
    rough.pace = Pace::ends;
    rough.blur = RoughState::only_direction;
    rough.turns = 0.0;
    return;
  }
  const SlipCoupling coupling =
      equations_.released(all_, {static_cast<std::size_t>(&rough - all_.data())}, open, at);
  const auto left = time_to_rest(coupling, rough.mu, u, vanished * rough.still);
  if (!left) return;
  rough.pace = Pace::ends;
  rough.blur = RoughState::only_direction;
  rough.turns = *left - time_to_rest_ahead(coupling, rough.mu, u);
  if (!std::isfinite(*rough.turns)) rough.turns = 0.0;
}

std::vector<EventRecord> DryFriction::changes(const std::vector<RoughState>& before, double t,
                                              Triggered triggered) const {
  std::vector<EventRecord> events;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    const RoughState &was = before[i], &is = all_[i];
    const bool due = own(is, triggered, mode);
    const bool turned = was.mode == Mode::slides && is.mode == Mode::slides && due && is.at_rest;
    if (was.mode == Mode::absent || is.mode == Mode::absent || (was.mode == is.mode && !turned)) continue;
    events.push_back({is.number, due && was.turns ? t + *was.turns : t,
                      is.mode == Mode::sticks ? EventKind::sticks : EventKind::slides});
  }
  return events;
}

void DryFriction::settle(const std::vector<std::size_t>& open, const Instant& at) {
  FrictionModes::require_own_shares(stated(), all_, at.t);
  FrictionModes(equations_, all_, open, at).require_one_motion();
  for (RoughState& r : all_) r.begins = false;
}

std::vector<EventRecord> DryFriction::find_modes(const std::vector<std::size_t>& open, const Instant& at,
                                                 Triggered triggered) {
  const auto before = all_;
  find_slip(at);
  for (RoughState& r : all_) set_mode_by_slip(r, open, at.t, triggered);
  rest_with_others(open, at);
  for (RoughState& r : all_)
    if (r.mode == Mode::slides && r.pace == Pace::leaves && r.blur == 0.0) find_way_to_rest(r, open, at);
  FrictionModes(equations_, all_, open, at).find();
  for (RoughState& r : all_)
    if (r.mode == Mode::slides && r.pace == Pace::leaves && r.at_rest) r.blur = r.slow;
  system_ = equations_.with_modes(all_, open);
  return changes(before, at.t, triggered);
}

}  // namespace dalembert
