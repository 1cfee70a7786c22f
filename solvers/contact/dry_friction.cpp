#include "dalembert/solvers/contact/dry_friction.h"

#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/contact/round_off.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dalembert {

using Eigen::VectorXd;

DryFriction::DryFriction(std::shared_ptr<const System> stated, const Scales& scales, double tolerance,
                         const Instant& at)
    : equations_(stated, scales, tolerance), system_(stated), g_(stated->rows()), u_(stated->rows()) {
  for (const std::size_t number : stated->conditions().frictional_constraints()) {
    const Layout::Constraint& its = stated->layout()->constraints[number];
    all_.push_back({.number = number, .row = its.own_rows().front(), .rows = its.own_rows().size()});
    all_.back().read_law(*stated);
  }
  measure_gradients(all_, *stated, scales, at);
  adopt(scales);
}

bool DryFriction::slides_in_space() const {
  return std::ranges::any_of(all_, [](const RoughState& r) { return r.is_fast_in_space(); });
}

void DryFriction::begin_step(const Instant& at) {
  find_slip(at);
  for (RoughState& r : all_)
    if (const VectorXd u = slip(r); r.is_fast_in_space() && u.norm() > r.slow) r.direction = u.normalized();
}

bool DryFriction::passes_rest(std::size_t function, const Instant& at) const {
  const RoughState& r = all_[function / kinds];
  if (!r.is_fast_in_space() || static_cast<Watched>(function % kinds) != speed) return false;
  find_slip(at);
  return slip(r).norm() <= r.still;
}

void DryFriction::replace_system(std::shared_ptr<const System> stated, const Instant& at) {
  equations_.replace_system(std::move(stated));
  for (RoughState& r : all_) r.read_law(this->stated());
  measure_gradients(all_, this->stated(), equations_.scales(), at);
  adopt(equations_.scales());
}

void DryFriction::adopt(const Scales& scales) {
  equations_.adopt(scales);
  for (RoughState& r : all_) r.adopt(scales, equations_.tolerance());
}

std::string DryFriction::label(std::size_t function) const {
  return stated().row_label(all_[function / kinds].row);
}

void DryFriction::find_slip(const Instant& at) const {
  stated().gaps(at, g_, u_);
  slip_at_ = at.t;
}

VectorXd DryFriction::slip(const RoughState& rough) const { return rough.part(u_); }

/// Steps carry what slides past rest, with friction in the direction that it had, up to where this function
/// tells that it rested. A single slip velocity has one direction or the other. Two have none at rest: slow
/// ones keep the direction that they have; fast ones that rest for a moment within a step have turned back
/// since it began. Something that slides without moving, to round-off, does not trigger.
double DryFriction::switching(std::size_t function, const FlatSample& now) const {
  const RoughState& r = all_[function / kinds];
  const auto watched = static_cast<Watched>(function % kinds);
  const double force = equations_.round_off_of(all_, r, now.a, now.lambda);
  const double lambda = now.lambda[r.pressing_row];
  if (watched == sign) return r.mode == Mode::slides && !r.one_sided ? r.sign * lambda + force : 1.0;
  if (r.mode == Mode::absent) return 1.0;
  if (r.mode == Mode::sticks && watched == mode) {
    // The difference of squares is smooth: where the normal force passes 0 the bound itself has a corner,
    // whose tip would pass between the times that are looked at.
    const double bound = r.mu_static * std::abs(lambda) + force;
    return bound * bound - r.part(now.lambda).squaredNorm() + std::numeric_limits<double>::min();
  }
  const bool slow = r.mode == Mode::slides && r.pace != Pace::fast;
  const bool turns = watched == speed && r.is_fast_in_space();
  if (watched == speed && !slow && !r.shared && !turns) return 1.0;
  if (slip_at_ != now.time) find_slip({now.time, now.q, now.v});
  const VectorXd u = slip(r);
  if (turns) return u.dot(r.direction) + r.no_slip(equations_.tolerance());
  if (watched == speed && r.mode == Mode::slides && r.pace == Pace::straight)
    return 4.0 * r.still * r.still - (u - u.dot(r.direction) * r.direction).squaredNorm();
  if (watched == speed) return 2.0 * (slow ? r.slow : r.no_slip(equations_.tolerance())) - u.norm();
  return r.ends_along_direction() ? u.dot(r.direction) + r.backlash(equations_.tolerance())
                                  : u.norm() - r.slow;
}

double DryFriction::unit(std::size_t function) const {
  const RoughState& r = all_[function / kinds];
  return r.mode == Mode::slides && static_cast<Watched>(function % kinds) == mode ? r.speed : 0.0;
}

double DryFriction::margin(std::size_t function) const {
  const RoughState& r = all_[function / kinds];
  const bool ends = r.mode == Mode::slides && static_cast<Watched>(function % kinds) == mode;
  return ends && r.ends_along_direction() ? r.backlash(equations_.tolerance()) : 0.0;
}

void DryFriction::take_away_slip(const std::vector<std::size_t>& open, const Instant& at,
                                 Change& change) const {
  const auto creeps = [&](const RoughState& r) {
    return r.mode == Mode::sticks && slip(r).norm() > r.no_slip(equations_.tolerance());
  };
  if (std::ranges::none_of(all_, creeps)) return;
  const std::vector<double> given =
      std::exchange(change.v, equations_.velocities_at_rest(all_, open, {at.t, at.q, change.v}));
  for (std::size_t i = 0; i < given.size(); ++i) change.v_before[i] += change.v[i] - given[i];
}

/// Directions are known to the rounding of the positions, over the scene's length: an impulse that is that of
/// the others, or of the momenta, is none.
void DryFriction::require_no_impulse(std::span<const double> impulses, const Instant& at,
                                     std::span<const double> unknown) const {
  if (std::ranges::all_of(all_, [&](const RoughState& r) { return impulses[r.pressing_row] == 0.0; })) return;
  const double of_directions = equations_.scales().rounding(at.q) / (epsilon * equations_.scales().length);
  const double rounding = round_off() * std::max(1.0, of_directions);
  const std::vector<double> lengths = equations_.scales().lengths();
  auto e = stated().evaluation();
  stated().evaluate(at, e);
  double momentum = 0.0;
  for (std::size_t i = 0; i < at.v.size(); ++i)
    momentum = std::max(momentum, stated().masses()[i] * std::abs(at.v[i]) / lengths[i]);
  // What takes away no more than velocities err by is no impact.
  const auto changes_momentum = [&](std::size_t row) {
    for (const std::size_t k : stated().row(row)) {
      const std::size_t i = stated().w_columns()[k];
      const double change = std::abs(e.w[k] * impulses[row]);
      if (change / lengths[i] > rounding * momentum &&
          change > stated().masses()[i] *
                       std::max(equations_.scales().velocity_error(i, at.v[i], equations_.tolerance()),
                                unknown.empty() ? 0.0 : unknown[i] / lengths[i]))
        return true;
    }
    return false;
  };
  const double none = rounding * largest(impulses);
  for (const RoughState& r : all_) {
    if (std::abs(impulses[r.pressing_row]) <= none || !changes_momentum(r.pressing_row)) continue;
    throw StepFailure{
        stated().row_label(r.row) + " is loaded by an impact through " + stated().row_label(r.pressing_row) +
            ", whose frictional impulse Coulomb's law does not determine; end the run before, or leave "
            "friction out",
        at.t};
  }
}

}  // namespace dalembert
