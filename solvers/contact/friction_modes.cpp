#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/contact/coming_to_rest.h>
#include <dalembert/solvers/contact/dry_friction.h>
#include <dalembert/solvers/contact/onset.h>
#include <dalembert/solvers/contact/round_off.h>
#include <dalembert/solvers/linear/rows.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

/// Which rough contacts stick at an instant, and in which direction the others slide.
namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Modes at an instant, tried one after another, of which no two are the same.
constexpr std::size_t most_tried = 1000;
/// The part of a speed that counts as none by which directions no longer matter.
constexpr double vanished = 1e-2;

constexpr const char* shares =
    ": its share of the friction is not determined, as others constrain the same slip; state one in place "
    "of all, or end the run before";

}  // namespace

/// u' = W v' + gamma; 0 where it is round-off of its terms, of what slides also of what its friction alone
/// would do, or below the root of the tolerance as forces are.
VectorXd DryFriction::slip_acceleration(const Rough& rough, const Instant& at, const Motion& motion) const {
  auto e = stated_->evaluation();
  std::vector<double> gamma(stated_->rows());
  stated_->evaluate(at, e);
  stated_->bias(at, gamma);
  VectorXd rate(static_cast<Index>(rough.rows));
  double terms = 0.0;
  for (std::size_t k = 0; k < rough.rows; ++k) {
    const std::size_t row = rough.row + k;
    double sum = gamma[row];
    terms = std::max(terms, std::abs(gamma[row]));
    for (const std::size_t j : stated_->row(row)) {
      const double term = e.w[j] * motion.a[stated_->w_columns()[j]];
      const std::size_t i = stated_->w_columns()[j];
      sum += term;
      terms = std::max({terms, std::abs(term), std::abs(e.w[j] * e.force[i] / stated_->masses()[i])});
    }
    rate[static_cast<Index>(k)] = sum;
    if (rough.mode == Mode::slides)
      terms = std::max(terms, rough.mu * std::abs(motion.lambda[rough.pressing_row]) *
                                  inverse_effective_mass(*stated_, e.w, row));
  }
  if (rate.norm() <= Accuracy(tolerance_).of_accelerations() * terms) rate.setZero();
  return rate;
}

/// The difference of two times that are the same to round-off.
double DryFriction::same_time(double t) const { return round_off() * std::max(std::abs(t), scales_.time); }

bool DryFriction::own(const Rough& rough, Triggered triggered, Watched watched) const {
  const auto index = static_cast<std::size_t>(&rough - all_.data());
  return triggered == kinds * index + watched;
}

/// What moves slides; what does not sticks, before `decide`. A slip that others prescribe is known to
/// round-off, another one as exactly as velocities are.
void DryFriction::set_mode_by_slip(Rough& rough, const std::vector<std::size_t>& open, double t,
                                   Triggered triggered) {
  const bool slid = rough.mode == Mode::slides, slow = slid && rough.pace != Pace::fast;
  const bool due = own(rough, triggered, mode),
             just = slid && rough.let_go && t - *rough.let_go <= same_time(t);
  rough.at_rest = rough.reached = false;
  const bool exerts_nothing =
      rough.mu_static == 0.0 || std::ranges::find(open, rough.pressed_by) != open.end();
  if (exerts_nothing) {
    rough.mode = Mode::absent;
    return;
  }
  if (own(rough, triggered, sign)) rough.sign = -rough.sign;
  const VectorXd u = slip(rough);
  const double none = no_slip(rough);
  const bool stops = due && slid && (rough.rows == 1 || slow),
             moves = slid ? u.dot(rough.direction) > none : rough.shared && u.norm() > none;
  // What begins is known as starts are, not as well as a step has kept the rest of what stuck.
  const double still =
      rough.mode == Mode::absent ? std::min(rough.still, start_tolerance * rough.speed) : rough.still;
  if (stops || (u.norm() <= std::max(still, none) && !moves)) {
    rough.at_rest = true;
    rough.reached = slid ? just : due;
    rough.mode = Mode::sticks;
    return;
  }
  rough.shared = false;
  if (own(rough, triggered, speed) && rough.is_fast_in_space()) return end_straight(rough, u.normalized());
  if (rough.pace == Pace::straight && slid && !own(rough, triggered, speed) && u.dot(rough.direction) > 0.0)
    return;
  if (slow && u.norm() < 2.0 * rough.slow && u.dot(rough.direction) > 0.0) return;
  rough.mode = Mode::slides;
  rough.direction = u.normalized();
  rough.blur = 0.0;
  rough.pace = rough.rows == 2 && (due || u.norm() < rough.slow) ? Pace::leaves : Pace::fast;
  rough.turns.reset();
}

/// Comes to rest in this direction, however fast it is.
void DryFriction::end_straight(Rough& rough, const VectorXd& direction) {
  rough.direction = direction;
  rough.pace = Pace::straight;
  rough.blur = only_direction;
  rough.turns = 0.0;
}

/// What others that are at rest leave no slip is at rest, too: the slow slip that it still has is an error of
/// the steps, and its direction one of round-off.
void DryFriction::rest_with_others(const std::vector<std::size_t>& open, const Instant& at) {
  const auto may_rest = [&](const Rough& r) {
    return r.mode == Mode::slides && !r.at_rest && slip(r).norm() <= r.slow;
  };
  for (bool more = std::ranges::any_of(all_, &Rough::at_rest); more;) {
    more = false;
    if (std::ranges::none_of(all_, may_rest)) return;
    const std::vector<double> v = velocities_at_rest(open, at);
    const auto before = u_;
    find_slip({at.t, at.q, v});
    const auto after = std::exchange(u_, before);
    slip_at_ = at.t;
    for (Rough& r : all_) {
      if (!may_rest(r) || part(r, after).norm() > no_slip(r)) continue;
      r.at_rest = more = true;
      r.reached = r.shared = false;
      r.mode = Mode::sticks;
    }
  }
}

/// Whether two slow slip velocities come to rest: then with the direction that they have.
void DryFriction::find_way_to_rest(Rough& rough, const std::vector<std::size_t>& open, const Instant& at) {
  const Eigen::Vector2d u = slip(rough);
  const Motion motion = solve(open, at);
  if (!motion.unique.empty() && !motion.unique[rough.pressing_row]) {
    // Of feet that slide one way together none can be let go alone: they rest together on a straight way.
    const Eigen::Vector2d rate = slip_acceleration(rough, at, motion);
    const double across = std::abs(u[0] * rate[1] - u[1] * rate[0]);
    if (u.dot(rate) >= 0.0 || across > Accuracy(tolerance_).of_accelerations() * u.norm() * rate.norm())
      return;
    rough.pace = Pace::ends;
    rough.blur = only_direction;
    rough.turns = 0.0;
    return;
  }
  const SlipCoupling coupling = released({static_cast<std::size_t>(&rough - all_.data())}, open, at);
  const auto left = time_to_rest(coupling, rough.mu, u, vanished * rough.still);
  if (!left) return;
  rough.pace = Pace::ends;
  rough.blur = only_direction;
  rough.turns = *left - time_to_rest_ahead(coupling, rough.mu, u);
  if (!std::isfinite(*rough.turns)) rough.turns = 0.0;
}

/// What starts to slide has less friction than it stuck with: of redundant ones that decides which slides.
void DryFriction::require_own_share(const Rough& rough, double t) const {
  if (!rough.shared || rough.mu_static == rough.mu) return;
  throw StepFailure{stated_->row_label(rough.row) + shares, t};
}

bool DryFriction::shared(const Rough& rough, std::span<const char> unique) {
  if (unique.empty()) return false;
  const auto rows = unique.subspan(rough.row, rough.rows);
  return std::ranges::find(rows, char{0}) != rows.end();
}

void DryFriction::mark_shared(const Motion& motion) {
  for (Rough& r : all_) r.shared = r.mode == Mode::sticks && shared(r, motion.unique);
}

/// By how much the friction of what sticks exceeds its bound, as a part of that; -1 if there is none.
double DryFriction::excess(const Rough& rough, const Motion& motion) const {
  const double sigma = part(rough, motion.lambda).norm();
  if (rough.mode != Mode::sticks || sigma <= round_off_of(rough, motion.a, motion.lambda)) return -1.0;
  return sigma / (rough.mu_static * std::abs(motion.lambda[rough.pressing_row])) - 1.0 - round_off();
}

/// Whether all that is at rest can stay there: what others prescribe may move it.
bool DryFriction::sticks(const Instant& at, const Motion& motion) const {
  return std::ranges::none_of(all_, [&](const Rough& r) {
    if (!r.at_rest) return false;
    if (r.reached || excess(r, motion) > 0.0) return true;
    return shared(r, motion.unique) && slip_acceleration(r, at, motion).norm() > 0.0;
  });
}

/// What of all that is at rest sticks, and what slides.
void DryFriction::decide(const std::vector<std::size_t>& open, const Instant& at) {
  const bool group = std::ranges::any_of(all_, [](const Rough& r) { return r.reached && r.shared; });
  for (Rough& r : all_) {  // what holds together reaches its bounds together
    if (r.at_rest && r.shared && group) r.reached = true;
    if (r.reached) require_own_share(r, at.t);
  }
  const Motion held = solve(open, at);
  mark_shared(held);
  if (sticks(at, held)) return;
  std::vector<std::size_t> which;
  std::vector<AtRest> rest;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    const Rough& r = all_[i];
    if (!r.at_rest) continue;
    which.push_back(i);
    rest.push_back({{r.row, r.rows, r.pressing_row}, r.mu, r.mu_static, r.reached});
  }
  const SlipCoupling coupling = released(which, open, at);
  const auto onset = Onset::find(coupling, rest);
  if (!onset) return;
  Index first = 0;
  for (std::size_t k = 0; k < which.size(); first += static_cast<Index>(rest[k++].rows.rows)) {
    if (!onset->parts[k].slides) continue;
    Rough& r = all_[which[k]];
    const bool prescribed = coupling.S_0(first, first) == 0.0;
    if (!prescribed) require_own_share(r, at.t);
    if (!r.one_sided) r.sign = held.lambda[r.pressing_row] < 0.0 ? -1.0 : 1.0;
    start_sliding(r, onset->parts[k].direction);
    if (r.reached) r.let_go = at.t;
  }
}

/// Releases, of what sticks and would exceed its bound, what exceeds it most; whether there is any.
bool DryFriction::release_most_exceeded(const Motion& motion, double t) {
  Rough* most = nullptr;
  double by = 0.0;
  for (Rough& r : all_) {
    const double own = excess(r, motion);
    if (!(own > by)) continue;
    most = &r;
    by = own;
  }
  if (most == nullptr) return false;
  mark_shared(motion);
  const bool together = most->shared;
  for (Rough& r : all_) {
    const bool too = together && r.shared && excess(r, motion) > -std::sqrt(round_off());
    if (&r != most && !too) continue;
    require_own_share(r, t);
    if (!r.one_sided) r.sign = motion.lambda[r.pressing_row] < 0.0 ? -1.0 : 1.0;
    start_sliding(r, -part(r, motion.lambda).normalized());
  }
  return true;
}

/// Whether two slip velocities that start from rest take another direction than they were released in.
bool DryFriction::turn(Rough& rough, const Instant& at, const Motion& motion) const {
  if (rough.rows != 2) return false;
  const VectorXd rate = slip_acceleration(rough, at, motion);
  const double across = rough.direction[0] * rate[1] - rough.direction[1] * rate[0];
  if (std::abs(across) <= std::sqrt(round_off()) * rate.norm() || rough.direction.dot(rate) <= 0.0)
    return false;
  rough.direction = rate.normalized();
  return true;
}

/// Whether something violated (1) and has been changed.
bool DryFriction::amend(const Instant& at, const Motion& motion) {
  for (Rough& r : all_) {
    const double zero = round_off_of(r, motion.a, motion.lambda);
    if (r.mode != Mode::slides || r.one_sided || r.sign * motion.lambda[r.pressing_row] >= -zero) continue;
    r.sign = -r.sign;
    return true;
  }
  if (release_most_exceeded(motion, at.t)) return true;
  for (Rough& r : all_) {
    if (r.mode != Mode::slides || !r.at_rest) continue;
    if (turn(r, at, motion)) return true;
    if (r.direction.dot(slip_acceleration(r, at, motion)) >= 0.0) continue;
    r.mode = Mode::sticks;
    return true;
  }
  return false;
}

std::vector<double> DryFriction::modes() const {
  std::vector<double> all;
  for (const Rough& r : all_) {
    all.insert(all.end(), {static_cast<double>(r.mode), r.sign});
    if (r.mode == Mode::slides) all.insert(all.end(), r.direction.begin(), r.direction.end());
  }
  return all;
}

void DryFriction::refuse(double t) const {
  std::string names;
  for (const Rough& r : all_)
    if (r.mode != Mode::absent) names += (names.empty() ? "" : ", ") + stated_->row_label(r.row);
  throw StepFailure{names +
                        ": no motion satisfies Coulomb's law here, neither sticking nor sliding (Painleve's "
                        "paradox); make mu smaller, or end the run before",
                    t};
}

std::vector<EventRecord> DryFriction::changes(const std::vector<Rough>& before, double t,
                                              Triggered triggered) const {
  std::vector<EventRecord> events;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    const Rough &was = before[i], &is = all_[i];
    const bool due = own(is, triggered, mode);
    const bool turned = was.mode == Mode::slides && is.mode == Mode::slides && due && is.at_rest;
    if (was.mode == Mode::absent || is.mode == Mode::absent || (was.mode == is.mode && !turned)) continue;
    events.push_back({is.number, due && was.turns ? t + *was.turns : t,
                      is.mode == Mode::sticks ? EventKind::sticks : EventKind::slides});
  }
  return events;
}

std::vector<EventRecord> DryFriction::find_modes(const std::vector<std::size_t>& open, const Instant& at,
                                                 Triggered triggered) {
  const auto before = all_;
  find_slip(at);
  for (Rough& r : all_) set_mode_by_slip(r, open, at.t, triggered);
  rest_with_others(open, at);
  for (Rough& r : all_)
    if (r.mode == Mode::slides && r.pace == Pace::leaves && r.blur == 0.0) find_way_to_rest(r, open, at);
  if (std::ranges::any_of(all_, &Rough::at_rest)) decide(open, at);
  std::set<std::vector<double>> tried;
  Motion found = solve(open, at);
  while (amend(at, found)) {
    if (!tried.insert(modes()).second || tried.size() > most_tried) refuse(at.t);
    found = solve(open, at);
  }
  mark_shared(found);
  for (Rough& r : all_)
    if (r.mode == Mode::slides && r.pace == Pace::leaves && r.at_rest) r.blur = r.slow;
  system_ = with_modes(open);
  return changes(before, at.t, triggered);
}

}  // namespace dalembert
