#include "dalembert/solvers/contact/dry_friction.h"

#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/root.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/contact/round_off.h>
#include <dalembert/solvers/linear/rows.h>
#include <dalembert/solvers/manifold/manifold.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <utility>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// The part of the scene's speed at which two slip velocities are at rest. A step that passes that turns
/// their friction while it lasts, and errs by a good part of the speed that it came with; so steps that err
/// by less than a tolerance pass none from so many: 1000 to 3000 give the same times to 25 tolerances
/// (tests/solvers/coulomb.cpp). The way that is left is the square of it, so never more than the root.
double rest_in_space(double tolerance) { return std::min(1000.0 * tolerance, std::sqrt(tolerance)); }

constexpr const char* shares =
    ": its share of the friction is not determined, as others hold the same; state one that stands for all "
    "of "
    "them, or end the run before";

double largest(std::span<const double> x) {
  double most = 0.0;
  for (const double value : x) most = std::max(most, std::abs(value));
  return most;
}

VectorXd part(std::span<const double> all, std::size_t first, std::size_t count) {
  return Eigen::Map<const VectorXd>(all.data() + first, static_cast<Index>(count));
}

}  // namespace

DryFriction::DryFriction(std::shared_ptr<const System> stated, const Scales& scales, double tolerance)
    : stated_(std::move(stated)),
      system_(stated_),
      scales_(scales),
      tolerance_(tolerance),
      g_(stated_->rows()),
      u_(stated_->rows()) {
  for (const std::size_t number : stated_->rough()) {
    const Layout::Constraint& its = stated_->layout()->constraints[number];
    all_.push_back({.number = number,
                    .row = static_cast<std::size_t>(its.first_row),
                    .rows = static_cast<std::size_t>(its.rows)});
    read_law(all_.back());
  }
  adopt(scales);
}

void DryFriction::read_law(Rough& rough) const {
  const auto& constraints = stated_->layout()->constraints;
  const Roughness& law = *constraints[rough.number].holds.roughness;
  const Layout::Constraint& pressing = constraints[static_cast<std::size_t>(law.pressed_by)];
  const std::size_t row = std::exchange(rough.pressing_row, static_cast<std::size_t>(pressing.first_row));
  rough.pressed_by = static_cast<std::size_t>(law.pressed_by);
  rough.mu = law.mu;
  rough.mu_static = law.mu_static;
  rough.one_sided = pressing.holds.contact.has_value();
  if (rough.one_sided) {
    rough.sign = pressing.holds.contact->sign();
  } else if (row != rough.pressing_row) {
    rough.sign = 1.0;
  }
}

void DryFriction::adopt(const Scales& scales) {
  scales_ = scales;
  for (Rough& r : all_) r.rest = (r.rows == 1 ? tolerance_ : rest_in_space(tolerance_)) * scales.speed();
}

void DryFriction::restate(std::shared_ptr<const System> stated) {
  stated_ = std::move(stated);
  for (Rough& r : all_) read_law(r);
}

std::string DryFriction::label(std::size_t function) const {
  return stated_->row_label(all_[function / 2].row);
}

void DryFriction::find_slip(const Instant& at) const {
  stated_->gaps(at, g_, u_);
  slip_at_ = at.t;
}

VectorXd DryFriction::slip(const Rough& rough) const { return part(u_, rough.row, rough.rows); }

/// Of forces on what it acts on, those of inertia and its own; never 0.
double DryFriction::round_off_of(const Rough& rough, std::span<const double> a,
                                 std::span<const double> lambda) const {
  double force = std::abs(lambda[rough.pressing_row]);
  for (std::size_t k = 0; k < rough.rows; ++k) {
    force = std::max(force, std::abs(lambda[rough.row + k]));
    for (const std::size_t j : stated_->row(rough.row + k)) {
      const std::size_t i = stated_->w_columns()[j];
      force = std::max(force, stated_->masses()[i] * std::abs(a[i]));
    }
  }
  return round_off * force + std::numeric_limits<double>::min();
}

/// The stepper takes what slides on past rest, in its direction: where that is one of two it holds, where it
/// is one of a plane that has none at rest the run stops before, at a speed that is rest to its tolerance.
/// What is 0 to round-off, of what slides without moving, has not fallen.
double DryFriction::watched(std::size_t function, const FlatSample& now) const {
  const Rough& r = all_[function / 2];
  const double force = round_off_of(r, now.a, now.lambda);
  const double lambda = now.lambda[r.pressing_row];
  if (function % 2 == 1) return r.mode == Mode::slides && !r.one_sided ? r.sign * lambda + force : 1.0;
  if (r.mode == Mode::absent) return 1.0;
  if (r.mode == Mode::sticks) {
    const double sigma = part(now.lambda, r.row, r.rows).norm();
    return (r.mu_static * std::abs(lambda) - sigma) + force;
  }
  if (slip_at_ != now.time) find_slip({now.time, now.q, now.v});
  const VectorXd u = slip(r);
  return r.rows == 1 ? u[0] * r.direction[0] + round_off * scales_.speed() : u.norm() - r.rest;
}

/// Slides from here on, against what has held it.
void DryFriction::let_go(Rough& rough, const VectorXd& held_by) const {
  rough.mode = Mode::slides;
  rough.from_rest = true;
  rough.direction = -held_by.normalized();
  rough.slow = rough.rows == 1 ? 0.0 : tolerance_ * scales_.speed();
}

std::shared_ptr<const System> DryFriction::with_modes(const std::vector<std::size_t>& open) const {
  std::vector<std::size_t> out = open;
  std::vector<System::Slide> slides;
  for (const Rough& r : all_) {
    if (r.mode == Mode::absent) out.push_back(r.number);
    if (r.mode != Mode::slides) continue;
    slides.push_back({r.number, r.sign * r.mu, {r.direction.begin(), r.direction.end()}, r.slow});
  }
  return std::make_shared<const System>(stated_->without(out).sliding(slides));
}

DryFriction::Motion DryFriction::solve(const std::vector<std::size_t>& open, const Instant& at) const {
  const auto system = with_modes(open);
  auto e = system->evaluation();
  system->evaluate(at, e);
  Manifold manifold(*system, independent_rows(*system, e.w), scales_.lengths());
  Motion motion{std::vector<double>(at.q.size()), std::vector<double>(system->rows())};
  std::vector<double> v(at.v.begin(), at.v.end());
  if (!manifold.solve_motion(at.t, at.q, v, motion.a, motion.lambda))
    throw StepFailure{"the constraints became dependent on each other", at.t};
  motion.unique.assign(manifold.unique().begin(), manifold.unique().end());
  return motion;
}

/// u' = W v' + gamma; what is round-off beside its terms, or within the root of the tolerance as forces are,
/// is 0.
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
  }
  if (rate.norm() <= std::sqrt(tolerance_) * terms) rate.setZero();
  return rate;
}

/// When two slip velocities that are as slow as the run watches them come to rest; else now.
double DryFriction::rests_at(const Rough& rough, const Instant& at, std::span<const double> a) const {
  if (rough.mode != Mode::slides || rough.rows == 1) return at.t;
  const VectorXd u = slip(rough), rate = slip_acceleration(rough, at, {{a.begin(), a.end()}, {}});
  const double slows = -u.dot(rate) / u.squaredNorm();
  return slows > 0.0 ? at.t + 1.0 / slows : at.t;
}

/// Of two slip velocities that begin at rest: d(phi) such that u' is along it.
void DryFriction::find_direction(Rough& rough, const std::vector<std::size_t>& open, const Instant& at) {
  if (rough.rows != 2) return;
  const double first = std::atan2(rough.direction[1], rough.direction[0]);
  const auto across = [&](double phi) {
    rough.direction = Eigen::Vector2d(std::cos(phi), std::sin(phi));
    const VectorXd rate = slip_acceleration(rough, at, solve(open, at));
    return rough.direction[0] * rate[1] - rough.direction[1] * rate[0];
  };
  constexpr double quarter = std::numbers::pi / 2.0;
  const double at_first = across(first);
  if (at_first == 0.0) return;
  const double other = first + std::copysign(quarter, at_first), at_other = across(other);
  if (at_first * at_other > 0.0) refuse(at.t);
  const double phi = root(across, first, at_first, other, at_other, round_off);
  rough.direction = Eigen::Vector2d(std::cos(phi), std::sin(phi));
}

/// What to try first: as it was, but for what has changed.
void DryFriction::begin(Rough& rough, const std::vector<std::size_t>& open, std::optional<std::size_t> fallen,
                        const FlatSample& motion) {
  const Mode before = rough.mode;
  if (std::ranges::find(open, rough.pressed_by) != open.end()) {
    rough.mode = Mode::absent;
    return;
  }
  const auto index = static_cast<std::size_t>(&rough - all_.data());
  const bool turned = fallen && *fallen == 2 * index;
  if (fallen && *fallen == 2 * index + 1) rough.sign = -rough.sign;
  const VectorXd u = slip(rough);
  if (before == Mode::sticks && u.norm() <= rough.rest) {
    if (!turned) return;
    require_own_share(rough, motion.unique, motion.time);
    let_go(rough, part(motion.lambda, rough.row, rough.rows));
    return;
  }
  if (turned || (u.norm() <= rough.rest && !(before == Mode::slides && rough.from_rest))) {
    rough.mode = Mode::sticks;
    return;
  }
  if (u.norm() > rough.rest) rough.from_rest = false;
  if (before == Mode::slides) return;
  rough.mode = Mode::slides;
  rough.direction = u.normalized();
  rough.slow = 0.0;
}

/// What is let go slides with less than it stuck with: of several that hold the same it decides which that
/// is.
void DryFriction::require_own_share(const Rough& rough, std::span<const char> unique, double t) {
  bool own = unique.empty();
  for (std::size_t k = 0; k < rough.rows && !unique.empty(); ++k) own = unique[rough.row + k] != 0;
  shared_ = shared_ || !own;
  if (own || rough.mu_static == rough.mu) return;
  throw StepFailure{stated_->row_label(rough.row) + shares, t};
}

/// Of what sticks and would need more than its bound that which exceeds it most; whether there is any.
bool DryFriction::let_go_what_exceeds(const std::vector<std::size_t>& open, const Instant& at,
                                      const Motion& motion) {
  Rough* most = nullptr;
  double by = 1.0 + round_off;
  for (Rough& r : all_) {
    if (r.mode != Mode::sticks) continue;
    const double sigma = part(motion.lambda, r.row, r.rows).norm();
    const double ratio = sigma / (r.mu_static * std::abs(motion.lambda[r.pressing_row]));
    if (sigma <= round_off_of(r, motion.a, motion.lambda) || !(ratio > by)) continue;
    most = &r;
    by = ratio;
  }
  if (most == nullptr) return false;
  require_own_share(*most, motion.unique, at.t);
  if (!most->one_sided) most->sign = motion.lambda[most->pressing_row] < 0.0 ? -1.0 : 1.0;
  let_go(*most, part(motion.lambda, most->row, most->rows));
  find_direction(*most, open, at);
  return true;
}

/// Whether two slip velocities that begin at rest go another way than they were let go.
bool DryFriction::turn(Rough& rough, const std::vector<std::size_t>& open, const Instant& at,
                       const Motion& motion) {
  if (rough.rows != 2) return false;
  const VectorXd rate = slip_acceleration(rough, at, motion);
  const double across = rough.direction[0] * rate[1] - rough.direction[1] * rate[0];
  if (std::abs(across) <= std::sqrt(round_off) * rate.norm()) return false;
  find_direction(rough, open, at);
  return true;
}

/// Whether something did not agree with (1) and has been changed.
bool DryFriction::amend(const std::vector<std::size_t>& open, const Instant& at, const Motion& motion) {
  for (Rough& r : all_) {
    const double zero = round_off_of(r, motion.a, motion.lambda);
    if (r.mode != Mode::slides || r.one_sided || r.sign * motion.lambda[r.pressing_row] >= -zero) continue;
    r.sign = -r.sign;
    return true;
  }
  if (let_go_what_exceeds(open, at, motion)) return true;
  for (Rough& r : all_) {
    if (r.mode != Mode::slides || !r.from_rest || slip(r).norm() > r.rest) continue;
    if (turn(r, open, at, motion)) return true;
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
  throw StepFailure{
      names +
          ": no motion agrees with Coulomb's law here, neither sticking nor sliding (Painleve's "
          "paradox); make mu smaller, or end the run before",
      t};
}

std::vector<DryFriction::Happening> DryFriction::settle(const std::vector<std::size_t>& open,
                                                        const Instant& at, std::optional<std::size_t> fallen,
                                                        const FlatSample& motion) {
  const auto before = all_;
  shared_ = false;
  find_slip(at);
  const double time = fallen ? rests_at(all_[*fallen / 2], at, motion.a) : at.t;
  for (Rough& r : all_) begin(r, open, fallen, motion);
  if (fallen && *fallen % 2 == 0 && all_[*fallen / 2].mode == Mode::slides)
    find_direction(all_[*fallen / 2], open, at);
  std::set<std::vector<double>> tried;
  do {
    if (!tried.insert(modes()).second) refuse(at.t);
  } while (amend(open, at, solve(open, at)));
  system_ = with_modes(open);
  std::vector<Happening> what;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    const Mode was = before[i].mode, is = all_[i].mode;
    const bool turned = was == Mode::slides && is == Mode::slides && fallen == 2 * i;
    if (was == Mode::absent || is == Mode::absent || (was == is && !turned)) continue;
    what.push_back({all_[i].number, is == Mode::sticks ? Happened::sticks : Happened::slides,
                    fallen && *fallen / 2 == i ? time : at.t});
  }
  return what;
}

void DryFriction::require_no_impulse(std::span<const double> impulses, double t) const {
  for (const Rough& r : all_) {
    if (std::abs(impulses[r.pressing_row]) <= round_off * largest(impulses)) continue;
    throw StepFailure{
        stated_->row_label(r.row) + " is pressed by an impact through " + stated_->row_label(r.pressing_row) +
            ", whose impulse of friction Coulomb's law does not tell; end the run before, or leave "
            "friction out",
        t};
  }
}

}  // namespace dalembert
