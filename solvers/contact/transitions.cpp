#include "dalembert/solvers/contact/transitions.h"

#include <limits>
#include <utility>

namespace dalembert {

Transitions::Transitions(const std::shared_ptr<const System>& stated, const Scales& scales, double tolerance,
                         const Instant& start)
    : contacts_(std::make_shared<const System>(stated->without(stated->rough())), scales, tolerance, start,
                !stated->rough().empty()),
      friction_(stated, scales, tolerance) {}

std::string Transitions::label(std::size_t function) const {
  return function < contacts_.size() ? contacts_.label(function)
                                     : friction_.label(function - contacts_.size());
}

double Transitions::switching(std::size_t function, const FlatSample& now) const {
  return function < contacts_.size() ? contacts_.switching(function, now)
                                     : friction_.switching(function - contacts_.size(), now);
}

double Transitions::rate(std::size_t function, const FlatSample& now) const {
  return function < contacts_.size() ? contacts_.rate(function, now)
                                     : std::numeric_limits<double>::quiet_NaN();
}

void Transitions::add(const std::vector<Contacts::Happening>& contacts,
                      const std::vector<DryFriction::Happening>& friction,
                      std::vector<Occurrence>& what) const {
  for (const auto& one : contacts) what.push_back({contacts_.index(one.contact), one.time, one.what});
  for (const auto& one : friction) what.push_back({one.constraint, one.time, one.what});
}

/// What contacts did, and its effect on friction, of which a switching function may have fallen.
Transitions::Change Transitions::settle(Contacts::Change contacts, const Instant& at,
                                        std::optional<std::size_t> fallen) {
  friction_.require_no_impulse(contacts.impulses, at);
  Change change{std::move(contacts.v_before), std::move(contacts.v), std::move(contacts.impulses)};
  add(contacts.what, friction_.settle(contacts_.open(), {at.t, at.q, change.v}, fallen), change.what);
  return change;
}

Transitions::Change Transitions::begin(const Instant& at) { return settle(contacts_.begin(at), at); }

Transitions::Change Transitions::pass(const FlatSample& at, std::size_t function) {
  const Instant now{at.time, at.q, at.v};
  if (function < contacts_.size()) return settle(contacts_.pass(now, {function}), now);
  // What opened without leaving its surface, while friction held it, may be pressed again.
  return settle(contacts_.pass(now, {}), now, function - contacts_.size());
}

Transitions::Change Transitions::restate(const std::shared_ptr<const System>& stated, const Instant& at,
                                         std::span<const double> impulses) {
  friction_.restate(stated);
  friction_.require_no_impulse(impulses, at);
  const auto touching =
      contacts_.restate(std::make_shared<const System>(stated->without(stated->rough())), at);
  return settle(contacts_.pass(at, touching), at);
}

void Transitions::adopt(const Scales& scales) {
  contacts_.adopt(scales);
  friction_.adopt(scales);
}

bool Transitions::open_pulling(const FlatSample& now, std::vector<Occurrence>& what) {
  std::vector<Contacts::Happening> opened;
  if (!contacts_.open_pulling(now, opened)) return false;
  add(opened, friction_.settle(contacts_.open(), {now.time, now.q, now.v}), what);
  return true;
}

}  // namespace dalembert
