#include "dalembert/solvers/run/switches.h"

#include <dalembert/core/errors.h>

#include <algorithm>

namespace dalembert {

Switches::Switches(const System& system, const Instant& at, std::span<const double> lambda)
    : system_(&system) {
  work_ = system.linearisation();
  std::string label;
  for (std::size_t k = 0; k < system.stated_friction_entries(); ++k) {
    const std::string own = system.force_of_friction(k);
    if (own != std::exchange(label, own)) first_.push_back(k);
  }
  first_.push_back(system.stated_friction_entries());
  Branches::Outcomes heard;
  const Branches listening(heard);
  try {
    system.linearise_forces(at, lambda, work_);
    of_forces_ = system.frictional() || listening.count() > 0;
    system.linearise_constraints(at, lambda, work_);
    any_ = of_forces_ || listening.count() > 0;
  } catch (const EquationFault&) {
    any_ = of_forces_ = true;
  }
  batches_ = heard.size();
}

void Switches::make_room(Side& side) const {
  side.branches.reserve(batches_);
  side.slope.reserve(work_.friction.size());
}

void Switches::find(const Instant& at, std::span<const double> lambda,
                    const Branches::Outcomes& of_constraints, Side& out) {
  out.branches = of_constraints;
  if (!of_forces_) return;
  const Branches listening(out.branches);
  try {
    system_->linearise_forces(at, lambda, work_);
    out.slope = work_.friction;
  } catch (const EquationFault&) {  // a kink itself may have no derivative
    out.branches.clear();
    out.slope.clear();
  }
}

/// The inner product of a friction's slopes: negative if it turned. NaN-free: an unknown one counts as not
/// turned.
double Switches::turn(const Side& a, const Side& b, std::size_t friction) const {
  double product = 0.0;
  for (std::size_t k = first_[friction]; k < first_[friction + 1] && k < a.slope.size() && k < b.slope.size();
       ++k)
    product += a.slope[k] * b.slope[k];
  return product;
}

bool Switches::same(const Side& a, const Side& b) const {
  if (a.branches.empty() || b.branches.empty()) return true;
  return a.branches == b.branches && !turned(a, b);
}

bool Switches::returns(const Side& a, const Side& b, const Side& c) const {
  if (a.branches.empty() || b.branches.empty() || c.branches.empty()) return false;
  for (std::size_t k = 0; k < a.branches.size(); ++k)
    if (a.branches[k] != b.branches[k] && c.branches[k] != a.branches[k]) return false;
  for (std::size_t i = 0; i + 1 < first_.size(); ++i)
    if (turn(a, b, i) < 0.0 && !(turn(a, c, i) > 0.0)) return false;
  return true;
}

std::optional<std::size_t> Switches::turned(const Side& a, const Side& b) const {
  for (std::size_t i = 0; i + 1 < first_.size(); ++i)
    if (turn(a, b, i) < 0.0) return i;
  return std::nullopt;
}

bool Switches::rests(const Side& a) const {
  for (std::size_t i = 0; i + 1 < first_.size(); ++i)
    if (turn(a, a, i) == 0.0) return true;
  return false;
}

std::string Switches::others(const Side& a, const Side& b) const {
  std::string all;
  for (std::size_t k = 0; k < std::min(a.branches.size(), b.branches.size()); ++k)
    if (a.branches[k] != b.branches[k]) all += (all.empty() ? "" : ", ") + system_->label_of_batch(k);
  return all;
}

}  // namespace dalembert
