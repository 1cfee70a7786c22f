#include "dalembert/solvers/event_log.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

namespace dalembert {

namespace {

std::vector<FlatEvent> with_contacts(std::vector<FlatEvent> events, const Contacts* contacts) {
  for (std::size_t i = 0; contacts != nullptr && i < contacts->size(); ++i) {
    events.push_back({contacts->label(i),
                      [contacts, i](const FlatSample& now) { return contacts->watched(i, now); },
                      Crossing::falling, false});
  }
  return events;
}

}  // namespace

EventLog::EventLog(std::vector<FlatEvent> events, Contacts* contacts, const Contacts::Change* at_start,
                   Stepping& stepping)
    : asked_for_(events.size()),
      contacts_(contacts),
      seen_(stepping.system(), stepping.start()),
      watch_(with_contacts(std::move(events), contacts), *stepping.system().layout()) {
  const double t = stepping.time();
  if (at_start != nullptr) go_on(*at_start, t, stepping);
  begin_anew(t, stepping);
}

FlatSample EventLog::read(Stepping& stepping, double t) {
  stepping.read(t, seen_);
  return seen_.flat();
}

void EventLog::look(Stepping& stepping) {
  const auto reader = [&](double t) { return read(stepping, t); };
  for (const Occurrence& one : watch_.look(reader, stepping.time(), stepping.degree())) {
    if (one.event >= asked_for_) {
      change_ = {one.event - asked_for_, one.time};
      return;
    }
    const FlatSample at = read(stepping, one.time);
    occurred_.push_back(one);
    before_.append(at);
    if (contacts_ != nullptr) {
      after_.append(at);
      impulses_.resize(impulses_.size() + at.lambda.size());
    }
    if (watch_.event(one.event).ends) {
      end_ = one.time;
      return;
    }
  }
  if (contacts_ != nullptr) contacts_->require_open(read(stepping, stepping.time()));
}

void EventLog::carry_out(Stepping& stepping) {
  if (!change_) return;
  const double t = change_->time;
  const FlatSample at = read(stepping, t);
  const Contacts::Change change = contacts_->pass({t, at.q, at.v}, {change_->contact});
  for (std::size_t k = 0; k < change.what.size(); ++k) before_.append(at);
  stepping.begin_changed(t, contacts_->system(), at.q, change.v);
  go_on(change, t, stepping);
  begin_anew(t, stepping);
}

void EventLog::begin_anew(double t, Stepping& stepping) {
  watch_.begin_anew(read(stepping, t), asked_for_);
  change_.reset();
  if (contacts_ == nullptr) return;
  if (const auto contact = contacts_->driven()) change_ = {*contact, t};
}

/// Lists a change, with the state after it and its impulses. Where contacts share a load in many ways, those
/// are left out that would pull.
void EventLog::go_on(const Contacts::Change& change, double t, Stepping& stepping) {
  FlatSample after = read(stepping, t);
  while (contacts_->open_pulling(after)) {
    const std::vector<double> q(after.q.begin(), after.q.end()), v(after.v.begin(), after.v.end());
    stepping.begin_changed(t, contacts_->system(), q, v);
    after = read(stepping, t);
  }
  FlatSample before = after;  // of a start that no step led to, with the forces that follow
  before.v = change.v_before;
  before.energy += stepping.system().kinetic_energy(before.v) - stepping.system().kinetic_energy(after.v);
  for (const auto& happening : change.what) {
    occurred_.push_back({contacts_->index(happening.contact), happening.time, happening.what});
    if (before_.times.size() < occurred_.size()) before_.append(before);
    after_.append(after);
    impulses_.insert(impulses_.end(), change.impulses.begin(), change.impulses.end());
  }
}

/// In the order of time: where one contact comes to rest, at the limit of its impacts, others may be struck
/// before that.
void EventLog::write(Record& record) const {
  std::vector<std::size_t> order(occurred_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [this](std::size_t k) { return occurred_[k].time; });
  const auto of = [&](const Record& samples) {
    Record stated = samples;
    stated.layout = record.layout;
    if (std::ranges::is_sorted(order)) return std::make_shared<Record>(std::move(stated));
    auto kept = std::make_shared<Record>();
    kept->layout = record.layout;
    for (const std::size_t k : order) kept->append(stated.sample(k));
    return kept;
  };
  record.events.clear();
  for (const std::size_t k : order) record.events.push_back(occurred_[k]);
  record.at_events = of(before_);
  if (contacts_ == nullptr) return;
  record.after_events = of(after_);
  record.impulses.clear();
  record.coordinates = contacts_->system()->coordinates();
  const std::size_t rows = record.rows = contacts_->system()->rows();  // also of a run that kept no sample
  for (const std::size_t k : order) {
    const auto own = std::span(impulses_).subspan(k * rows, rows);
    record.impulses.insert(record.impulses.end(), own.begin(), own.end());
  }
}

}  // namespace dalembert
