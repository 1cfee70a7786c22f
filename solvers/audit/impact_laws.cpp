#include "dalembert/solvers/audit/impact_laws.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

namespace {

bool happened(const Jump& jump, EventKind what) {
  return std::ranges::find(jump.what, what, &EventRecord::kind) != jump.what.end();
}

}  // namespace

ImpactLaws::ImpactLaws(std::shared_ptr<const System> stated, const Claim& claim)
    : stated_(std::move(stated)),
      limits_(*stated_, claim),
      before_(stated_->evaluation()),
      after_(stated_->evaluation()) {}

void ImpactLaws::check(const Jump& jump, bool at_start, const Claim& claim, Findings& findings) {
  limits_.set(claim);
  const auto carries = [&](std::size_t number) {
    const auto own = stated_->layout()->constraints[number].own_rows().in(jump.impulses);
    return std::ranges::any_of(own, [](double P) { return P != 0.0; });
  };
  std::vector<std::size_t> idle = stated_->conditions().conditional_constraints();
  std::erase_if(idle, carries);
  const System acting = stated_->without(idle);
  acting.evaluate({jump.time, jump.q, jump.v_before}, before_);
  acting.evaluate({jump.time, jump.q, jump.v_after}, after_);
  check_momentum(acting, jump, findings);
  check_carriers(jump, at_start, findings);
  check_restitution(jump, findings);
  check_energy(acting, jump, findings);
}

void ImpactLaws::check_momentum(const System& acting, const Jump& jump, Findings& findings) const {
  const auto masses = acting.masses();
  std::vector<double> residual(masses.size()), terms(masses.size());
  for (std::size_t i = 0; i < masses.size(); ++i) {
    residual[i] = masses[i] * (jump.v_after[i] - jump.v_before[i]);
    terms[i] =
        masses[i] * (std::abs(jump.v_after[i]) + std::abs(jump.v_before[i]) + limits_.unit(i) / limits_.time);
  }
  const auto columns = acting.w_columns();
  for (std::size_t r = 0; r < acting.rows(); ++r) {
    for (const std::size_t k : acting.row(r)) {
      residual[columns[k]] -= after_.w[k] * jump.impulses[r];
      terms[columns[k]] += std::abs(after_.w[k] * jump.impulses[r]);
    }
  }
  const bool stuck = happened(jump, EventKind::sticks);
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const double taken = limits_.rest_at_contacts(i) + (stuck ? limits_.rest_in_space(i) : 0.0);
    findings.weigh(Law::impulse, {Subject::Kind::coordinate, i}, jump.time, std::abs(residual[i]),
                   limits_.relative(terms[i]) + masses[i] * taken);
  }
}

/// An impulse of the accuracy of momenta is none. Where impacts accumulate, what brings their remainder to
/// rest also makes up for the impulses of other forces until then: it has no sign. What touches at the start
/// may do so in rounded numbers.
void ImpactLaws::check_carriers(const Jump& jump, bool at_start, Findings& findings) const {
  const double most = largest(jump.impulses), limit = limits_.relative(most);
  if (most == 0.0) return;
  const bool accumulated = happened(jump, EventKind::rested);
  for (std::size_t c = 0; c < stated_->layout()->constraints.size(); ++c) {
    const Condition& holds = stated_->conditions().of[c];
    for (const std::size_t r : stated_->layout()->constraints[c].own_rows()) {
      double wrong = 0.0;
      if (!stated_->in_force(r) || stated_->law(r).compliant() || holds.roughness)
        wrong = std::abs(jump.impulses[r]);
      else if (holds.contact && !accumulated)
        wrong = std::max(-holds.contact->sign() * jump.impulses[r], 0.0);
      findings.weigh(Law::impulse_carrier, {Subject::Kind::row, r}, jump.time, wrong, limit);
      if (!holds.contact || std::abs(jump.impulses[r]) <= limit) continue;
      double near = limits_.by_time(jump.time, before_.psi[r]);
      for (const std::size_t k : stated_->row(r))
        near += std::abs(after_.w[k]) *
                (limits_.position(stated_->w_columns()[k], jump.q[stated_->w_columns()[k]]) +
                 (at_start ? start_tolerance * limits_.unit(stated_->w_columns()[k]) : 0.0));
      findings.weigh(Law::impulse_carrier, {Subject::Kind::row, r}, jump.time, std::abs(after_.g[r]), near);
    }
  }
}

double ImpactLaws::speed_limit(const System& acting, std::size_t r, const Jump& jump) const {
  double limit = 0.0;
  for (const std::size_t k : acting.row(r)) {
    const std::size_t i = acting.w_columns()[k];
    limit += std::abs(after_.w[k]) *
             (limits_.velocity(i, std::max(std::abs(jump.v_before[i]), std::abs(jump.v_after[i]))) +
              limits_.rest_at_contacts(i));
  }
  return limit;
}

void ImpactLaws::check_restitution(const Jump& jump, Findings& findings) const {
  if (happened(jump, EventKind::rested) || happened(jump, EventKind::event))
    return;  // several impacts in one
  const double none = limits_.relative(largest(jump.impulses));
  for (const std::size_t c : stated_->conditions().contacts()) {
    const std::size_t r = stated_->layout()->constraints[c].own_rows().front();
    if (std::abs(jump.impulses[r]) <= none) continue;
    const Contact& law = *stated_->conditions().of[c].contact;
    const double s = law.sign();
    findings.weigh(Law::restitution, {Subject::Kind::row, r}, jump.time,
                   std::abs(s * after_.psi[r] + law.restitution * s * before_.psi[r]),
                   2.0 * speed_limit(*stated_, r, jump));
  }
}

void ImpactLaws::check_energy(const System& acting, const Jump& jump, Findings& findings) const {
  double work = 0.0, limit = 0.0;
  for (std::size_t r = 0; r < acting.rows(); ++r) {
    work += 0.5 * jump.impulses[r] * (before_.psi[r] + after_.psi[r]);
    limit += std::abs(jump.impulses[r]) * speed_limit(acting, r, jump);
  }
  findings.weigh(Law::impact_energy, {}, jump.time, std::max(work, 0.0),
                 limit + limits_.relative(acting.kinetic_energy(jump.v_before)));
}

}  // namespace dalembert
