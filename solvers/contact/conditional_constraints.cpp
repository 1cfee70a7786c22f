#include "dalembert/solvers/contact/conditional_constraints.h"

#include <limits>
#include <utility>

namespace dalembert {

ConditionalConstraints::ConditionalConstraints(const std::shared_ptr<const System>& stated,
                                               const Scales& scales, double tolerance, const Instant& start,
                                               double duration)
    : contacts_(
          std::make_shared<const System>(stated->without(stated->conditions().frictional_constraints())),
          scales, tolerance, start, duration, !stated->conditions().frictional_constraints().empty()),
      friction_(stated, scales, tolerance, start) {}

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

double ConditionalConstraints::unit(std::size_t function, double from) const {
  return function < contacts_.size() ? contacts_.unit(function, from)
                                     : friction_.unit(function - contacts_.size());
}

double ConditionalConstraints::margin(std::size_t function) const {
  return function < contacts_.size() ? 0.0 : friction_.margin(function - contacts_.size());
}

/// Where contacts are as they are now.
void ConditionalConstraints::find_modes(const Instant& at, std::optional<std::size_t> triggered,
                                        Change& change) {
  const auto events = friction_.find_modes(contacts_.open(), at, triggered);
  change.events.insert(change.events.end(), events.begin(), events.end());
  change.system = system();
}

/// What contacts did, and its effect on friction, of which a switching function may have triggered it.
Change ConditionalConstraints::resolve_friction(Change change, const Instant& at,
                                                std::optional<std::size_t> triggered,
                                                std::span<const double> unknown) {
  friction_.require_no_impulse(change.impulses, at, unknown);
  change.q.assign(at.q.begin(), at.q.end());
  find_modes({at.t, at.q, change.v}, triggered, change);
  return change;
}

Change ConditionalConstraints::resolve_start(const Instant& at) {
  Change change = resolve_friction(contacts_.resolve_start(at), at);
  friction_.take_away_slip(contacts_.open(), at, change);
  return change;
}

Change ConditionalConstraints::resolve(const FlatSample& at, std::size_t function) {
  const Instant now{at.time, at.q, at.v};
  if (function < contacts_.size()) return resolve_friction(contacts_.resolve(now, {function}), now);
  // What opened without leaving its surface, while friction held it, may be pressed again.
  return resolve_friction(contacts_.resolve(now, {}), now, function - contacts_.size());
}

std::optional<std::size_t> ConditionalConstraints::fallen(const FlatSample& behind) {
  contacts_.forget_instant();
  for (std::size_t i = 0; i < functions(); ++i)
    if (switching(i, behind) < 0.0) return i;
  return contacts_.driven_apart({behind.time, behind.q, behind.v});
}

Change ConditionalConstraints::resolve_jump(const Instant& at) {
  const auto touching = contacts_.replace_system(contacts_.stated(), at, {});
  return resolve_friction(contacts_.resolve(at, touching), at);
}

std::vector<std::size_t> ConditionalConstraints::not_held(const System& stated, const Instant& at) const {
  std::vector<std::size_t> all = stated.conditions().frictional_constraints();
  const auto open = contacts_.open_in(stated, at);
  all.insert(all.end(), open.begin(), open.end());
  return all;
}

Change ConditionalConstraints::replace_system(const std::shared_ptr<const System>& stated, const Instant& at,
                                              std::span<const double> impulses, const Joining& joining) {
  friction_.replace_system(stated, at);
  friction_.require_no_impulse(impulses, at, {});
  const auto touching = contacts_.replace_system(
      std::make_shared<const System>(stated->without(stated->conditions().frictional_constraints())), at,
      joining);
  return resolve_friction(contacts_.resolve(at, touching), at, {}, contacts_.unknown_speeds(joining.known));
}

bool ConditionalConstraints::passes_rest(std::size_t function, const FlatSample& at) const {
  const std::size_t first = contacts_.size();
  return function >= first && friction_.passes_rest(function - first, {at.time, at.q, at.v});
}

void ConditionalConstraints::adopt(const Scales& scales) {
  contacts_.adopt(scales);
  friction_.adopt(scales);
}

bool ConditionalConstraints::open_pulling(const FlatSample& now, Change& change) {
  if (!contacts_.open_pulling(now, change.events)) return false;
  find_modes({now.time, now.q, now.v}, {}, change);
  return true;
}

}  // namespace dalembert
