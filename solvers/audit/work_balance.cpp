#include "dalembert/solvers/audit/work_balance.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/constants.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

bool conservative(const System& system) {
  return !system.rheonomic() && !system.forces().has_friction() && system.forces().damping_pattern().empty();
}

WorkBalance::WorkBalance(std::shared_ptr<const System> stated, const Claim& claim)
    : stated_(std::move(stated)),
      limits_(*stated_, claim),
      watches_(conservative(*stated_)),
      falls_(!stated_->conditions().frictional_constraints().empty()),
      v_(stated_->coordinates()),
      at_rest_(stated_->coordinates()),
      g_(stated_->rows()),
      u_(stated_->rows()),
      e_(stated_->evaluation()) {
  for (std::size_t r = 0; r < stated_->rows(); ++r)
    if (stated_->law(r).compliant()) elastic_ += 0.5 / stated_->law(r).compliance;
}

void WorkBalance::start_interval(double time, double energy, std::span<const double> v) {
  time_ = before_ = checked_ = time;
  energy_ = energy;
  kinetic_ = stated_->kinetic_energy(v);
  changes_ = changes_before_ = last_ = 0.0;
  size_ = std::abs(energy);
  std::ranges::copy(v, v_.begin());
}

void WorkBalance::step(double time, std::span<const double> v) {
  const double h = time - std::exchange(time_, time);
  if (!(h > 0.0)) return;
  const auto masses = stated_->masses();
  last_ = 0.0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double unit = limits_.unit(i), a = std::abs(v[i] - v_[i]) / h, speed = std::abs(v[i]);
    last_ += masses[i] * (a * unit + speed * (unit / limits_.time + speed));
    v_[i] = v[i];
  }
  changes_ += last_;
}

/// What is left of (1) at rest, and in springs.
double WorkBalance::second_order() const {
  double energy = elastic_ * limits_.length * limits_.length;
  for (std::size_t i = 0; i < v_.size(); ++i) {
    const double speed = limits_.unit(i) / limits_.time;
    energy += 0.5 * stated_->masses()[i] * speed * speed;
  }
  return limits_.accuracy * limits_.accuracy * energy;
}

/// At these positions, at times since the sample before the last: not half-way between samples, where drives
/// may have periods, and before the last as well, which a potential that switches there is read on the side
/// before.
bool WorkBalance::potentials_depend_on_time(const FlatSample& sample) const {
  if (stated_->stiffness_pattern().size() == stated_->stiffness_of_constraints())
    return false;  // constant ones
  constexpr double part = 0.382;
  const auto potential = [&](double t) { return stated_->forces().energy({t, sample.q, sample.v}); };
  try {
    const double V = potential(sample.time);
    return potential(checked_ + part * (sample.time - checked_)) != V ||
           potential(checked_ - part * (checked_ - before_)) != V;
  } catch (const EquationFault&) {
    return true;  // it has a value where the system was at that time, and perhaps not here
  }
}

/// Velocity constraints, and slips, that are not 0 at rest, as of a belt, do work.
bool WorkBalance::constraints_drive(const FlatSample& sample) {
  if (stated_->rows() == stated_->holonomic_rows()) return false;
  try {
    stated_->gaps({sample.time, sample.q, at_rest_}, g_, u_);
    stated_->evaluate({sample.time, sample.q, at_rest_}, e_);
  } catch (const EquationFault&) {
    return true;  // what cannot be told is not watched
  }
  const auto moves = [](double u) { return u != 0.0; };
  return std::ranges::any_of(u_, moves) || std::ranges::any_of(e_.psi, moves);
}

/// What forces do where a position errs by the accuracy or a rounding, or is moved by what rounding leaves of
/// forces in balance: by r |F|/m for the time since the last sample.
double WorkBalance::work_of_errors(const FlatSample& sample) {
  stated_->without(stated_->conditions().conditional_constraints())
      .evaluate({sample.time, sample.q, sample.v}, e_);
  const double time = sample.time - checked_;
  double sum = 0.0;
  for (std::size_t i = 0; i < e_.force.size(); ++i) {
    const double force = std::abs(e_.force[i]);
    sum += force * (limits_.position(i, sample.q[i]) +
                    limits_.round_off * force / stated_->masses()[i] * time * time);
  }
  return sum;
}

void WorkBalance::check(const FlatSample& sample, const Claim& claim, Findings& findings) {
  watches_ = watches_ && !potentials_depend_on_time(sample) && !constraints_drive(sample);
  if (!watches_) return;
  limits_.set(claim);
  const double gain = sample.energy - energy_, size = falls_ ? std::max(gain, 0.0) : std::abs(gain);
  double other = second_order() + limits_.round_off * size_;
  if (size > limits_.accuracy * (changes_ + last_) + other) other += work_of_errors(sample);
  weigh(sample.time, size, changes_ + last_, other, findings);
}

void WorkBalance::weigh(double time, double size, double changes, double other, Findings& findings) {
  if (size > limits_.accuracy * changes + other) shown_ = std::max(shown_, (size - other) / changes);
  findings.weigh(Law::work, {}, time, size, limits_.accuracy * constants.growth * changes + other);
}

void WorkBalance::check(const FlatSample& sample, double work, double error, const Claim& claim,
                        Findings& findings) {
  limits_.set(claim);
  const double T = stated_->kinetic_energy(sample.v);
  const double other = second_order() + error + limits_.round_off * (T + kinetic_ + size_);
  weigh(sample.time, std::abs(T - kinetic_ - work), changes_ - changes_before_ + 2.0 * last_, other,
        findings);
}

void WorkBalance::accept(const FlatSample& sample) {
  // Read once more, an instant leaves the time before it as it is.
  if (sample.time > checked_) before_ = std::exchange(checked_, sample.time);
  kinetic_ = stated_->kinetic_energy(sample.v);
  changes_before_ = changes_;
  size_ = std::max(size_, std::abs(sample.energy) + kinetic_);
  if (!falls_ || sample.energy > energy_) return;
  energy_ = sample.energy;
  changes_ = changes_before_ = 0.0;
}

}  // namespace dalembert
