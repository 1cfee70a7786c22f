#include "dalembert/solvers/audit/sample_laws.h"

#include <dalembert/core/errors.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

SampleLaws::SampleLaws(std::shared_ptr<const System> stated, const Claim& claim)
    : stated_(std::move(stated)),
      acting_(stated_),
      limits_(*stated_, claim),
      e_(stated_->evaluation()),
      gamma_(stated_->rows()),
      g_(stated_->rows()),
      u_(stated_->rows()),
      residual_(stated_->coordinates()),
      terms_(stated_->coordinates()),
      conditional_(stated_->conditions().conditional_constraints()),
      acts_(conditional_.size(), 1),
      acted_(conditional_.size(), 1),
      always_(stated_->rows(), 1) {
  const auto& all = stated_->layout()->constraints;
  for (const std::size_t number : conditional_) {
    const Condition& holds = stated_->conditions().of[number];
    const std::size_t first = all[number].own_rows().front();
    for (const std::size_t r : all[number].own_rows()) always_[r] = 0;
    if (holds.contact) contacts_.push_back({first, holds.contact->sign()});
    if (!holds.roughness) continue;
    const auto pressing = static_cast<std::size_t>(holds.roughness->pressed_by);
    rough_.push_back({first, all[number].own_rows().size(), all[pressing].own_rows().front(),
                      holds.roughness->mu, holds.roughness->mu_static});
  }
}

/// What exerts no force need not have a gradient, as a slack string of length 0 has none: it is left out, and
/// friction with what does not press.
void SampleLaws::find_what_acts(const FlatSample& sample) {
  const auto exerts = [](double force) { return force != 0.0; };
  for (std::size_t k = 0; k < conditional_.size(); ++k) {
    const Layout::Constraint& its = stated_->layout()->constraints[conditional_[k]];
    acts_[k] = std::ranges::any_of(its.own_rows().in(sample.lambda), exerts);
    const auto& law = stated_->conditions().of[conditional_[k]].roughness;
    if (!law) continue;
    const auto pressing = static_cast<std::size_t>(law->pressed_by);
    if (std::ranges::any_of(stated_->layout()->constraints[pressing].own_rows().in(sample.lambda), exerts))
      acts_[k] = 1;
  }
  if (acts_ == acted_) return;
  std::vector<std::size_t> idle;
  for (std::size_t k = 0; k < conditional_.size(); ++k)
    if (!acts_[k]) idle.push_back(conditional_[k]);
  acting_ = std::make_shared<const System>(stated_->without(idle));
  acted_ = acts_;
}

void SampleLaws::evaluate(const FlatSample& sample) {
  const Instant at{sample.time, sample.q, sample.v};
  acting_->evaluate_with_bias(at, e_, gamma_);
  if (acting_->forces().has_friction()) add_forces_that_read(sample);
  const bool redundant = std::ranges::find(sample.unique, char{0}) != sample.unique.end();
  dependence_ = redundant ? Limits::dependent : 0.0;
  largest_force_ = 0.0;
  for (const double force : sample.forces)
    if (std::abs(force) > largest_force_) largest_force_ = std::abs(force);
  for (std::size_t i = 0; i < sample.a.size(); ++i) {
    const double force = std::max(acting_->masses()[i] * std::abs(sample.a[i]), inertia(i));
    if (force > largest_force_) largest_force_ = force;
  }
}

/// The force that moves a coordinate by its unit in the scene's time: by a part of it forces err where
/// nothing exerts any.
double SampleLaws::inertia(std::size_t i) const {
  return acting_->masses()[i] * limits_.unit(i) / (limits_.time * limits_.time);
}

/// Where a multiplier that is read is not determined, nor are the forces that read it.
void SampleLaws::add_forces_that_read(const FlatSample& sample) {
  const auto unknown = [&](const MatrixEntry& entry) { return std::isnan(sample.lambda[entry.column]); };
  if (std::ranges::none_of(acting_->forces().friction_pattern(), unknown))
    return acting_->forces().add_friction({sample.time, sample.q, sample.v}, sample.lambda, e_.force);
  for (const MatrixEntry& entry : acting_->forces().friction_pattern())
    e_.force[entry.row] = std::numeric_limits<double>::quiet_NaN();
}

void SampleLaws::check(const FlatSample& sample, const Claim& claim, Findings& findings) {
  limits_.set(claim);
  if (!conditional_.empty()) {
    stated_->gaps({sample.time, sample.q, sample.v}, g_, u_);
    find_what_acts(sample);
  }
  evaluate(sample);
  check_newton(sample, findings);
  check_rows(sample, findings);
  check_point_forces(sample, findings);
  check_energy(sample, findings);
  check_contacts(sample, findings);
  check_friction(sample, findings);
}

/// The residual of every coordinate, and what its terms are: of its row the largest entry of W counts, as
/// round-off in directions comes from all of it.
void SampleLaws::check_newton(const FlatSample& sample, Findings& findings) {
  const auto masses = acting_->masses();
  for (std::size_t i = 0; i < residual_.size(); ++i) {
    residual_[i] = masses[i] * sample.a[i] - e_.force[i];
    terms_[i] = std::abs(masses[i] * sample.a[i]) + std::abs(e_.force[i]) + inertia(i);
  }
  const auto columns = acting_->w_columns();
  for (std::size_t r = 0; r < acting_->rows(); ++r) {
    if (sample.lambda[r] == 0.0) continue;
    double most = 0.0;
    for (const std::size_t k : acting_->row(r)) most = std::max(most, std::abs(e_.w[k]));
    for (const std::size_t k : acting_->row(r)) {
      residual_[columns[k]] -= e_.w[k] * sample.lambda[r];
      terms_[columns[k]] += most * std::abs(sample.lambda[r]);
    }
  }
  for (std::size_t i = 0; i < residual_.size(); ++i) {
    findings.weigh(Law::newton, {Subject::Kind::coordinate, i}, sample.time, std::abs(residual_[i]),
                   limits_.relative(terms_[i]) + dependence_ * terms_[i]);
  }
}

double SampleLaws::position_limit(std::span<const double> w, const System& of, std::size_t r,
                                  const FlatSample& sample) const {
  double limit = 0.0;
  for (const std::size_t k : of.row(r))
    limit += std::abs(w[k]) * limits_.position(of.w_columns()[k], sample.q[of.w_columns()[k]]);
  return limit;
}

/// Two slip velocities that are slower have the direction that they leave rest in, or come to it.
double SampleLaws::slow_slip(std::size_t r) const {
  double slow = 0.0;
  for (const std::size_t k : acting_->row(r))
    slow += std::abs(e_.w[k]) * limits_.rest_in_space(acting_->w_columns()[k]);
  return slow;
}

double SampleLaws::velocity_limit(std::size_t r, const FlatSample& sample) const {
  double limit = 0.0;
  for (const std::size_t k : acting_->row(r))
    limit += std::abs(e_.w[k]) * limits_.velocity(acting_->w_columns()[k], sample.v[acting_->w_columns()[k]]);
  return limit;
}

void SampleLaws::check_rows(const FlatSample& sample, Findings& findings) const {
  for (std::size_t r = 0; r < acting_->rows(); ++r) {
    if (!acting_->in_force(r)) {
      findings.weigh(Law::released, row(r), sample.time, std::abs(sample.lambda[r]),
                     limits_.relative(largest_force_));
    } else {
      check_row(sample, r, findings);
    }
  }
}

void SampleLaws::check_row(const FlatSample& sample, std::size_t r, Findings& findings) const {
  const RowLaw& law = acting_->law(r);
  const bool holonomic = r < acting_->holonomic_rows();
  const double position = position_limit(e_.w, *acting_, r, sample);
  if (law.compliant()) {
    return findings.weigh(Law::compliance, row(r), sample.time,
                          std::abs(law.residual(e_.g[r], sample.lambda[r])),
                          position + limits_.relative(law.compliance * std::abs(sample.lambda[r])));
  }
  if (!always_[r] && !holonomic) return;  // friction has its own law
  if (holonomic)
    findings.weigh(always_[r] ? Law::position : Law::no_distant_force, row(r), sample.time, std::abs(e_.g[r]),
                   position);
  findings.weigh(Law::velocity, row(r), sample.time, std::abs(e_.psi[r]), velocity_limit(r, sample));
  double residual = gamma_[r], terms = std::abs(gamma_[r]);
  for (const std::size_t k : acting_->row(r)) {
    const std::size_t i = acting_->w_columns()[k];
    residual += e_.w[k] * sample.a[i];
    terms += std::abs(e_.w[k]) * terms_[i] / acting_->masses()[i];
  }
  findings.weigh(Law::acceleration, row(r), sample.time, std::abs(residual),
                 limits_.relative(terms) + dependence_ * terms);
}

void SampleLaws::check_point_forces(const FlatSample& sample, Findings& findings) const {
  for (const Layout::Constraint& c : acting_->layout()->constraints) {
    std::size_t j = 0;
    for (const std::size_t slot : c.slots()) {
      double residual = sample.forces[slot], terms = std::abs(residual);
      for (const std::size_t r : c.own_rows()) {
        const double force = e_.w[acting_->row(r).front() + j] * sample.lambda[r];
        residual -= force;
        terms += std::abs(force);
      }
      findings.weigh(Law::point_forces, row(c.own_rows().front()), sample.time, std::abs(residual),
                     limits_.relative(terms));
      ++j;
    }
  }
}

void SampleLaws::check_energy(const FlatSample& sample, Findings& findings) const {
  const double T = acting_->kinetic_energy(sample.v),
               V = acting_->forces().energy({sample.time, sample.q, sample.v}),
               elastic = acting_->compliant() ? acting_->elastic_energy(sample.lambda) : 0.0;
  findings.weigh(Law::energy, {}, sample.time, std::abs(sample.energy - (T + V + elastic)),
                 limits_.relative(T + std::abs(V) + elastic));
}

/// How far g may be off where one of these has no force, and so no gradient has been evaluated. Without one
/// nothing is known of it.
double SampleLaws::gradient(const FlatSample& sample, std::size_t contact) const {
  std::vector<std::size_t> others = conditional_;
  std::erase_if(others, [&](std::size_t number) {
    return stated_->layout()->constraints[number].own_rows().front() == contact;
  });
  const System alone = stated_->without(others);
  auto e = alone.evaluation();
  try {
    alone.evaluate({sample.time, sample.q, sample.v}, e);
  } catch (const EquationFault&) {
    return std::numeric_limits<double>::infinity();
  }
  return position_limit(e.w, alone, contact, sample);
}

/// A multiplier as large as all that acts on what a row moves: of what is far heavier, or elsewhere, forces
/// tell nothing about how exactly it is known.
double SampleLaws::own_force(std::size_t r) const {
  double acceleration = 0.0, inverse_mass = 0.0;
  for (const std::size_t k : acting_->row(r)) {
    const std::size_t i = acting_->w_columns()[k];
    acceleration += std::abs(e_.w[k]) * terms_[i] / acting_->masses()[i];
    inverse_mass += e_.w[k] * e_.w[k] / acting_->masses()[i];
  }
  return inverse_mass > 0.0 ? acceleration / inverse_mass : 0.0;
}

/// What makes it uncertain though nothing is in balance with it: roundings of single forces that cancel each
/// other, where a pull has just grown as large as a weight; and the error of a position that a spring has
/// where it is relaxed.
double SampleLaws::own_uncertainty(std::size_t r, const FlatSample& sample) const {
  const Layout& layout = *acting_->layout();
  const Instant at{sample.time, sample.q, sample.v};
  auto displaced = acting_->evaluation();
  double acceleration = 0.0, inverse_mass = 0.0;
  for (const std::size_t k : acting_->row(r)) {
    const std::size_t i = acting_->w_columns()[k];
    const double mass = acting_->masses()[i];
    inverse_mass += e_.w[k] * e_.w[k] / mass;
    std::vector<double> q(sample.q.begin(), sample.q.end());
    q[i] += limits_.accuracy * (limits_.angle[i] ? 1.0 : limits_.length);
    acting_->evaluate({sample.time, q, sample.v}, displaced);
    acceleration += std::abs(e_.w[k] * (displaced.force[i] - e_.force[i])) / mass;
    const auto* particle = layout.particle_at(static_cast<int>(i));
    const auto first = particle ? static_cast<std::size_t>(particle->coordinate) : i;
    std::vector<double> force(particle ? static_cast<std::size_t>(layout.dimension) : 1);
    for (std::size_t f = 0; f < layout.forces.size(); ++f) {
      if (layout.applied->on(f, at, sample.lambda, static_cast<int>(first), particle ? mass : 0.0, force))
        acceleration += limits_.round_off * std::abs(e_.w[k] * force[i - first]) / mass;
    }
  }
  return inverse_mass > 0.0 ? acceleration / inverse_mass : 0.0;
}

void SampleLaws::check_contacts(const FlatSample& sample, Findings& findings) const {
  for (const Contact& c : contacts_) {
    const double pull = std::max(-c.sign * sample.lambda[c.row], 0.0);
    double most = 2.0 * limits_.relative(own_force(c.row));
    if (pull > most) most += 2.0 * own_uncertainty(c.row, sample);
    findings.weigh(Law::no_pull, row(c.row), sample.time, pull, most);
    const double depth = -c.sign * g_[c.row];
    const double rounding = limits_.by_time(sample.time, u_[c.row]);
    double limit = limits_.accuracy * limits_.length + rounding;
    if (depth > limit) limit = gradient(sample, c.row) + rounding;
    findings.weigh(Law::no_penetration, row(c.row), sample.time, std::max(depth, 0.0), limit);
  }
}

/// Of a slip u that is not told from rest the direction is free; one of two components is turned by the
/// accuracy of u.
void SampleLaws::check_friction(const FlatSample& sample, Findings& findings) const {
  for (const Rough& rough : rough_) {
    const double N = std::abs(sample.lambda[rough.pressing_row]);
    double sigma = 0.0, u = 0.0, sliding = 0.0, rest = 0.0, own = own_force(rough.pressing_row);
    for (std::size_t k = rough.row; k < rough.row + rough.rows; ++k) {
      sigma += sample.lambda[k] * sample.lambda[k];
      u += u_[k] * u_[k];
      own = std::max(own, own_force(k));
      rest = std::max(rest, velocity_limit(k, sample) + (rough.rows > 1 ? slow_slip(k) : 0.0));
    }
    sigma = std::sqrt(sigma);
    u = std::sqrt(u);
    const double limit = 2.0 * limits_.relative(own);
    findings.weigh(Law::friction_cone, row(rough.row), sample.time,
                   std::max(sigma - rough.mu_static * N, 0.0), limit);
    const double direction = rough.rows == 1 ? 0.0 : std::min(1.0, rest / u);
    if (!(u > rest) || !(direction < 1.0)) continue;
    for (std::size_t k = rough.row; k < rough.row + rough.rows; ++k)
      sliding = std::hypot(sliding, sample.lambda[k] + rough.mu * N * u_[k] / u);
    findings.weigh(Law::sliding, row(rough.row), sample.time, sliding,
                   limit + 2.0 * rough.mu * N * direction);
  }
}

}  // namespace dalembert
