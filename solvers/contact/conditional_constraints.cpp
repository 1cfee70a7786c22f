#include "dalembert/solvers/contact/conditional_constraints.h"

#include <limits>
#include <utility>

namespace dalembert {

ConditionalConstraints::ConditionalConstraints(const std::shared_ptr<const System>& stated,
                                               const Scales& scales, double tolerance, const Instant& start)
    : contacts_(std::make_shared<const System>(stated->without(stated->frictional_constraints())), scales,
                tolerance, start, !stated->frictional_constraints().empty()),
      friction_(stated, scales, tolerance) {}

std::string ConditionalConstraints::label(std::size_t function) const {
  return function < contacts_.size() ? contacts_.label(function)
                                     : friction_.label(function - contacts_.size());
}

double ConditionalConstraints::switching(std::size_t function, const FlatSample& now) const {
  return function < contacts_.size() ? contacts_.switching(function, now)
                                     : friction_.switching(function - contacts_.size(), now);
}

double ConditionalConstraints::rate(std::size_t function, const FlatSample& now) const {
  return function < contacts_.size() ? contacts_.rate(function, now)
                                     : std::numeric_limits<double>::quiet_NaN();
}

void ConditionalConstraints::add(const std::vector<Contacts::Happening>& contacts,
                                 const std::vector<DryFriction::Happening>& friction,
                                 std::vector<EventRecord>& what) const {
  for (const auto& one : contacts) what.push_back({contacts_.index(one.contact), one.time, one.kind});
  for (const auto& one : friction) what.push_back({one.constraint, one.time, one.kind});
}

/// What contacts did, and its effect on friction, of which a switching function may have fallen.
ConditionalConstraints::Change ConditionalConstraints::resolve_friction(
    Contacts::Change contacts, const Instant& at, std::optional<std::size_t> triggered) {
  friction_.require_no_impulse(contacts.impulses, at);
  Change change{std::move(contacts.v_before), std::move(contacts.v), std::move(contacts.impulses)};
  add(contacts.what, friction_.find_modes(contacts_.open(), {at.t, at.q, change.v}, triggered), change.what);
  return change;
}

ConditionalConstraints::Change ConditionalConstraints::resolve_start(const Instant& at) {
  return resolve_friction(contacts_.resolve_start(at), at);
}

ConditionalConstraints::Change ConditionalConstraints::resolve(const FlatSample& at, std::size_t function) {
  const Instant now{at.time, at.q, at.v};
  if (function < contacts_.size()) return resolve_friction(contacts_.resolve(now, {function}), now);
  // What opened without leaving its surface, while friction held it, may be pressed again.
  return resolve_friction(contacts_.resolve(now, {}), now, function - contacts_.size());
}

ConditionalConstraints::Change ConditionalConstraints::replace_system(
    const std::shared_ptr<const System>& stated, const Instant& at, std::span<const double> impulses) {
  friction_.replace_system(stated);
  friction_.require_no_impulse(impulses, at);
  const auto touching = contacts_.replace_system(
      std::make_shared<const System>(stated->without(stated->frictional_constraints())), at);
  return resolve_friction(contacts_.resolve(at, touching), at);
}

void ConditionalConstraints::adopt(const Scales& scales) {
  contacts_.adopt(scales);
  friction_.adopt(scales);
}

bool ConditionalConstraints::open_pulling(const FlatSample& now, std::vector<EventRecord>& what) {
  std::vector<Contacts::Happening> opened;
  if (!contacts_.open_pulling(now, opened)) return false;
  add(opened, friction_.find_modes(contacts_.open(), {now.time, now.q, now.v}), what);
  return true;
}

}  // namespace dalembert
