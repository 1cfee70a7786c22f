#include "dalembert/solvers/event_log.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace dalembert {

namespace {

std::vector<FlatEvent> with_transitions(std::vector<FlatEvent> events, const Transitions* transitions) {
  for (std::size_t i = 0; transitions != nullptr && i < transitions->functions(); ++i) {
    events.push_back({transitions->label(i),
                      [transitions, i](const FlatSample& now) { return transitions->watched(i, now); },
                      Crossing::falling, false});
  }
  return events;
}

}  // namespace

EventLog::EventLog(std::vector<FlatEvent> events, Transitions* transitions,
                   const Transitions::Change* at_start, Stepping& stepping)
    : asked_for_(events.size()),
      transitions_(transitions),
      seen_(stepping.system(), stepping.start()),
      watch_(with_transitions(std::move(events), transitions), *stepping.system().layout()) {
  const double t = stepping.time();
  if (at_start != nullptr) go_on(*at_start, t, stepping);
  watch_.begin_anew(read(stepping, t), asked_for_);
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
    if (transitions_ != nullptr) {
      after_.append(at);
      impulses_.resize(impulses_.size() + at.lambda.size());
    }
    if (watch_.event(one.event).ends) {
      end_ = one.time;
      return;
    }
  }
  if (transitions_ != nullptr) transitions_->require_open(read(stepping, stepping.time()));
}

void EventLog::carry_out(Stepping& stepping) {
  if (!change_) return;
  const double t = change_->time;
  const FlatSample at = read(stepping, t);
  const Transitions::Change change = transitions_->pass(at, change_->function);
  for (std::size_t k = 0; k < change.what.size(); ++k) before_.append(at);
  stepping.begin_changed(t, transitions_->system(), at.q, change.v);
  go_on(change, t, stepping);
  watch_.begin_anew(read(stepping, t), asked_for_);
  change_.reset();
}

/// Lists a change, with the state after it and its impulses. Where contacts share a load in many ways, those
/// are left out that would pull.
void EventLog::go_on(const Transitions::Change& change, double t, Stepping& stepping) {
  FlatSample after = read(stepping, t);
  while (transitions_->open_pulling(after)) {
    const std::vector<double> q(after.q.begin(), after.q.end()), v(after.v.begin(), after.v.end());
    stepping.begin_changed(t, transitions_->system(), q, v);
    after = read(stepping, t);
  }
  for (const Occurrence& one : change.what) {
    occurred_.push_back(one);
    if (before_.times.size() < occurred_.size()) before_.append(after);
    after_.append(after);
    impulses_.insert(impulses_.end(), change.impulses.begin(), change.impulses.end());
  }
}

void EventLog::write(Record& record) const {
  const auto of = [&record](const Record& samples) {
    auto kept = std::make_shared<Record>(samples);
    kept->layout = record.layout;
    return kept;
  };
  record.events = occurred_;
  record.at_events = of(before_);
  if (transitions_ == nullptr) return;
  record.after_events = of(after_);
  record.impulses = impulses_;
}

}  // namespace dalembert
