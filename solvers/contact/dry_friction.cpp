#include "dalembert/solvers/contact/dry_friction.h"

#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/contact/round_off.h>
#include <dalembert/solvers/linear/rows.h>
#include <dalembert/solvers/manifold/manifold.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

}  // namespace

DryFriction::DryFriction(std::shared_ptr<const System> stated, const Scales& scales, double tolerance,
                         const Instant& at)
    : stated_(std::move(stated)),
      system_(stated_),
      scales_(scales),
      tolerance_(tolerance),
      g_(stated_->rows()),
      u_(stated_->rows()) {
  for (const std::size_t number : stated_->frictional_constraints()) {
    const Layout::Constraint& its = stated_->layout()->constraints[number];
    all_.push_back({.number = number, .row = its.own_rows().front(), .rows = its.own_rows().size()});
    read_law(all_.back());
  }
  measure_gradients(at);
  adopt(scales);
}

void DryFriction::measure_gradients(const Instant& at) {
  if (all_.empty()) return;
  auto e = stated_->evaluation();
  try {
    stated_->evaluate(at, e);
  } catch (const EquationFault&) {
    return;  // of what is not in force there; the motion itself will say so, if it gets there
  }
  for (Rough& r : all_) {
    r.of_lengths = r.of_angles = 0.0;
    for (std::size_t row = r.row; row < r.row + r.rows; ++row) {
      double of_lengths = 0.0, of_angles = 0.0;
      for (const std::size_t k : stated_->row(row))
        (scales_.is_angle[stated_->w_columns()[k]] ? of_angles : of_lengths) += std::abs(e.w[k]);
      r.of_lengths = std::max(r.of_lengths, of_lengths);
      r.of_angles = std::max(r.of_angles, of_angles);
    }
  }
}

void DryFriction::read_law(Rough& rough) const {
  const auto& constraints = stated_->layout()->constraints;
  const Roughness& law = *constraints[rough.number].condition.roughness;
  const Layout::Constraint& pressing = constraints[static_cast<std::size_t>(law.pressed_by)];
  const std::size_t row = std::exchange(rough.pressing_row, pressing.own_rows().front());
  rough.pressed_by = static_cast<std::size_t>(law.pressed_by);
  rough.mu = law.mu;
  rough.mu_static = law.mu_static;
  rough.one_sided = pressing.condition.contact.has_value();
  if (rough.one_sided) {
    rough.sign = pressing.condition.contact->sign();
  } else if (row != rough.pressing_row) {
    rough.sign = 1.0;
  }
}

void DryFriction::adopt(const Scales& scales) {
  scales_ = scales;
  for (Rough& r : all_) {
    r.speed = std::min(scales.speed(), (r.of_lengths * scales.length + r.of_angles) / scales.time);
    r.still = tolerance_ * r.speed;
    r.slow = Accuracy(tolerance_).rest_in_space() * r.speed;
  }
}

bool DryFriction::slides_in_space() const {
  return std::ranges::any_of(all_, [](const Rough& r) { return r.is_fast_in_space(); });
}

void DryFriction::begin_step(const Instant& at) {
  find_slip(at);
  for (Rough& r : all_)
    if (const VectorXd u = slip(r); r.is_fast_in_space() && u.norm() > r.slow) r.direction = u.normalized();
}

bool DryFriction::passes_rest(std::size_t function, const Instant& at) const {
  const Rough& r = all_[function / kinds];
  if (!r.is_fast_in_space() || static_cast<Watched>(function % kinds) != speed) return false;
  find_slip(at);
  return slip(r).norm() <= r.still;
}

void DryFriction::replace_system(std::shared_ptr<const System> stated, const Instant& at) {
  stated_ = std::move(stated);
  for (Rough& r : all_) read_law(r);
  measure_gradients(at);
  adopt(scales_);
}

std::string DryFriction::label(std::size_t function) const {
  return stated_->row_label(all_[function / kinds].row);
}

void DryFriction::find_slip(const Instant& at) const {
  stated_->gaps(at, g_, u_);
  slip_at_ = at.t;
}

VectorXd DryFriction::part(const Rough& rough, std::span<const double> all) {
  return Eigen::Map<const VectorXd>(all.data() + rough.row, static_cast<Index>(rough.rows));
}

VectorXd DryFriction::slip(const Rough& rough) const { return part(rough, u_); }

/// Round-off: a slip that begins with less may have any sign. What reverses its friction so late errs by at
/// most twice this speed: a part of a step's tolerance.
double DryFriction::no_slip(const Rough& rough) const {
  return std::min(round_off(), 0.1 * tolerance_) * rough.speed;
}

/// Round-off of its own force and of what it shares with others, and of the inertia of the lightest that it
/// acts on; never 0.
double DryFriction::round_off_of(const Rough& rough, std::span<const double> a,
                                 std::span<const double> lambda) const {
  double force = std::abs(lambda[rough.pressing_row]);
  for (const Rough& other : all_)
    if (rough.shared && other.shared) force = std::max(force, std::abs(lambda[other.pressing_row]));
  const auto lengths = scales_.lengths();
  for (std::size_t row = rough.row; row < rough.row + rough.rows; ++row) {
    double acceleration = 0.0;
    for (const std::size_t j : stated_->row(row)) {
      const std::size_t i = stated_->w_columns()[j];
      acceleration = std::max(acceleration, std::abs(a[i]) * lengths[i]);
    }
    force = std::max({force, std::abs(lambda[row]), lightest_mass(*stated_, lengths, row) * acceleration});
  }
  return std::min(round_off(), tolerance_) * force + std::numeric_limits<double>::min();
}

/// Steps carry what slides past rest, with friction in the direction that it had, up to where this function
/// tells that it rested. A single slip velocity has one direction or the other. Two have none at rest: slow
/// ones keep the direction that they have; fast ones that rest for a moment within a step have turned back
/// since it began. Something that slides without moving, to round-off, does not trigger.
double DryFriction::switching(std::size_t function, const FlatSample& now) const {
  const Rough& r = all_[function / kinds];
  const auto watched = static_cast<Watched>(function % kinds);
  const double force = round_off_of(r, now.a, now.lambda);
  const double lambda = now.lambda[r.pressing_row];
  if (watched == sign) return r.mode == Mode::slides && !r.one_sided ? r.sign * lambda + force : 1.0;
  if (r.mode == Mode::absent) return 1.0;
  if (r.mode == Mode::sticks && watched == mode) {
    // The difference of squares is smooth: where the normal force passes 0 the bound itself has a corner,
    // whose tip would pass between the times that are looked at.
    const double bound = r.mu_static * std::abs(lambda) + force;
    return bound * bound - part(r, now.lambda).squaredNorm() + std::numeric_limits<double>::min();
  }
  const bool slow = r.mode == Mode::slides && r.pace != Pace::fast;
  const bool turns = watched == speed && r.is_fast_in_space();
  if (watched == speed && !slow && !r.shared && !turns) return 1.0;
  if (slip_at_ != now.time) find_slip({now.time, now.q, now.v});
  const VectorXd u = slip(r);
  if (turns) return u.dot(r.direction) + no_slip(r);
  if (watched == speed && r.mode == Mode::slides && r.pace == Pace::straight)
    return 4.0 * r.still * r.still - (u - u.dot(r.direction) * r.direction).squaredNorm();
  if (watched == speed) return 2.0 * (slow ? r.slow : no_slip(r)) - u.norm();
  return r.ends_along_direction() ? u.dot(r.direction) + no_slip(r) : u.norm() - r.slow;
}

double DryFriction::unit(std::size_t function) const {
  const Rough& r = all_[function / kinds];
  return r.mode == Mode::slides && static_cast<Watched>(function % kinds) == mode ? r.speed : 0.0;
}

double DryFriction::margin(std::size_t function) const {
  const Rough& r = all_[function / kinds];
  const bool ends = r.mode == Mode::slides && static_cast<Watched>(function % kinds) == mode;
  return ends && r.ends_along_direction() ? no_slip(r) : 0.0;
}

/// Starts to slide from rest, whatever small slip is left.
void DryFriction::start_sliding(Rough& rough, const VectorXd& direction) const {
  rough.mode = Mode::slides;
  rough.direction = direction;
  rough.pace = rough.rows == 1 ? Pace::fast : Pace::leaves;
  rough.blur = rough.rows == 1 ? 0.0 : only_direction;
}

/// Without those that are open, contacts or frictions.
std::shared_ptr<const System> DryFriction::with_modes(const std::vector<std::size_t>& open) const {
  std::vector<std::size_t> out = open;
  std::vector<System::Slide> slides;
  for (const Rough& r : all_) {
    if (r.mode == Mode::absent) out.push_back(r.number);
    if (r.mode != Mode::slides || std::ranges::find(open, r.number) != open.end()) continue;
    slides.push_back({r.number, r.sign * r.mu, {r.direction.begin(), r.direction.end()}, r.blur});
  }
  return std::make_shared<const System>(stated_->without(out).sliding(slides));
}

DryFriction::Motion DryFriction::solve(const std::vector<std::size_t>& open, const Instant& at) const {
  const Problem problem(with_modes(open));
  const System* const system = &problem.system();
  auto e = system->evaluation();
  system->evaluate(at, e);
  Manifold manifold(problem, independent_rows(*system, e.w), scales_.lengths());
  Motion motion{std::vector<double>(at.q.size()), std::vector<double>(system->rows())};
  std::vector<double> v(at.v.begin(), at.v.end());
  if (!manifold.solve_motion(at.t, at.q, v, motion.a, motion.lambda)) throw linearly_dependent(at.t);
  motion.unique.assign(manifold.unique().begin(), manifold.unique().end());
  return motion;
}

/// Those nearest to the ones of an instant that leave what sticks no slip.
std::vector<double> DryFriction::velocities_at_rest(const std::vector<std::size_t>& open,
                                                    const Instant& at) const {
  const Problem problem(with_modes(open));
  const System& system = problem.system();
  auto e = system.evaluation();
  system.evaluate(at, e);
  Manifold manifold(problem, independent_rows(system, e.w), scales_.lengths());
  std::vector<double> v(at.v.begin(), at.v.end()), impulses(system.rows());
  if (!manifold.project_impulsively(at.t, at.q, v, impulses)) throw linearly_dependent(at.t);
  return v;
}

void DryFriction::take_away_slip(const std::vector<std::size_t>& open, const Instant& at,
                                 Change& change) const {
  const auto creeps = [&](const Rough& r) { return r.mode == Mode::sticks && slip(r).norm() > no_slip(r); };
  if (std::ranges::none_of(all_, creeps)) return;
  const std::vector<double> given = std::exchange(change.v, velocities_at_rest(open, {at.t, at.q, change.v}));
  for (std::size_t i = 0; i < given.size(); ++i) change.v_before[i] += change.v[i] - given[i];
}

/// These, numbers among all, without their friction.
SlipCoupling DryFriction::released(const std::vector<std::size_t>& which,
                                   const std::vector<std::size_t>& open, const Instant& at) const {
  std::vector<std::size_t> out = open;
  std::vector<SlipRows> rows;
  for (const std::size_t i : which) {
    out.push_back(all_[i].number);
    rows.push_back({all_[i].row, all_[i].rows, all_[i].pressing_row});
  }
  return {*stated_, with_modes(out), rows, scales_.lengths(), at, tolerance_};
}

/// Directions are known to the rounding of the positions, over the scene's length: an impulse that is that of
/// the others, or of the momenta, is none.
void DryFriction::require_no_impulse(std::span<const double> impulses, const Instant& at) const {
  if (std::ranges::all_of(all_, [&](const Rough& r) { return impulses[r.pressing_row] == 0.0; })) return;
  const double of_directions = scales_.rounding(at.q) / (epsilon * scales_.length);
  const double rounding = round_off() * std::max(1.0, of_directions);
  const std::vector<double> lengths = scales_.lengths();
  auto e = stated_->evaluation();
  stated_->evaluate(at, e);
  double momentum = 0.0;
  for (std::size_t i = 0; i < at.v.size(); ++i)
    momentum = std::max(momentum, stated_->masses()[i] * std::abs(at.v[i]) / lengths[i]);
  // What takes away no more than velocities err by is no impact.
  const auto changes_momentum = [&](std::size_t row) {
    for (const std::size_t k : stated_->row(row)) {
      const std::size_t i = stated_->w_columns()[k];
      const double change = std::abs(e.w[k] * impulses[row]);
      if (change / lengths[i] > rounding * momentum &&
          change > stated_->masses()[i] * scales_.velocity_error(i, at.v[i], tolerance_))
        return true;
    }
    return false;
  };
  const double none = rounding * largest(impulses);
  for (const Rough& r : all_) {
    if (std::abs(impulses[r.pressing_row]) <= none || !changes_momentum(r.pressing_row)) continue;
    throw StepFailure{
        stated_->row_label(r.row) + " is loaded by an impact through " + stated_->row_label(r.pressing_row) +
            ", whose frictional impulse Coulomb's law does not determine; end the run before, or leave "
            "friction out",
        at.t};
  }
}

}  // namespace dalembert
