#include "dalembert/solvers/event_log.h"

#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/contact/round_off.h>
#include <dalembert/solvers/manifold/start.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <numeric>
#include <utility>

namespace dalembert {

namespace {

std::vector<std::string> names_of(const std::vector<FlatEvent>& events) {
  std::vector<std::string> names;
  for (const FlatEvent& event : events) names.push_back(event.name);
  return names;
}

std::vector<FlatEvent> with_transitions(std::vector<FlatEvent> events, const Transitions* transitions) {
  for (std::size_t i = 0; transitions != nullptr && i < transitions->functions(); ++i) {
    events.push_back({transitions->label(i),
                      [transitions, i](const FlatSample& now) { return transitions->switching(i, now); },
                      Crossing::falling, false});
  }
  return events;
}

EventWatch::Rate rates_of_transitions(std::size_t asked_for, const Transitions* transitions) {
  if (transitions == nullptr) return {};
  return [=](std::size_t event, const FlatSample& now) { return transitions->rate(event - asked_for, now); };
}

}  // namespace

EventLog::EventLog(std::vector<FlatEvent> events, Transitions* transitions,
                   const Transitions::Change* at_start, Auditor* auditor, Stepping& stepping)
    : asked_for_(events.size()),
      names_(names_of(events)),
      transitions_(transitions),
      auditor_(auditor),
      seen_(stepping.system(), stepping.start(), changes(events)),
      watch_(with_transitions(std::move(events), transitions), rates_of_transitions(asked_for_, transitions),
             *stepping.system().layout(), stepping.tolerance()),
      changes_(asked_for_),
      looked_to_(stepping.time()) {
  const double t = stepping.time();
  if (at_start != nullptr) {
    Transitions::Change change = *at_start;
    open_pulling(change, t, stepping);
    const FlatSample after = read(stepping, t);
    FlatSample before = after;  // no step led to it: with the forces that follow
    before.v = change.v_before;
    before.energy += stepping.system().kinetic_energy(before.v) - stepping.system().kinetic_energy(after.v);
    for (Record* record : {&before_, &after_}) record->go_on_with(stepping.system().layout());
    audit(change, after);
    list(change, before, after);
  }
  begin_anew(t, stepping);
}

bool EventLog::changes(const std::vector<FlatEvent>& events) {
  return std::ranges::any_of(events, [](const FlatEvent& event) { return bool(event.change); });
}

FlatSample EventLog::read(Stepping& stepping, double t) {
  stepping.read(t, seen_);
  return seen_.flat();
}

void EventLog::look(Stepping& stepping) {
  if (transitions_ != nullptr && stepping.start().scales.of_path)
    transitions_->adopt(stepping.scales(stepping.time()));
  const EventWatch::Read reader = [&](double t) { return read(stepping, t); };
  const auto all = watch_.look({reader, stepping.time(), stepping.degree(), stepping.at_end()});
  std::vector<Occurrence> found;
  for (const auto& one : all)
    if (one.wanted) found.push_back(one.what);
  const auto changes = [this](const Occurrence& one) {
    return one.event >= asked_for_ || watch_.event(one.event).change;
  };
  const auto first = std::ranges::find_if(found, changes);
  // At the time of a change, or of an end, all that is due there: what was asked for before what follows from
  // the motion.
  double until = first == found.end() ? stepping.time() : first->time + same_time(first->time, stepping);
  for (const Occurrence& one : found) {
    if (one.time > until) break;
    if (changes(one)) {
      if (one.event < asked_for_) due_.push_back(one);
      continue;
    }
    list(one, stepping);
    if (!watch_.event(one.event).ends || end_) continue;
    end_ = one.time;
    until = std::min(until, one.time + same_time(one.time, stepping));
  }
  if (first != found.end() && first->time <= until) {
    change_ = due_.empty() ? *first : due_.front();
    if (!due_.empty()) due_.erase(due_.begin());
    if (end_) change_->time = *end_;
  }
  left_.clear();
  std::ranges::copy_if(all, std::back_inserter(left_),
                       [&](const auto& one) { return one.what.time > until; });
  if (transitions_ != nullptr)
    transitions_->require_open(read(stepping, change_ ? change_->time : stepping.time()));
  looked_to_ = stepping.time();
}

void EventLog::list(const Occurrence& one, Stepping& stepping) {
  const FlatSample at = read(stepping, one.time);
  if (auditor_ != nullptr) auditor_->instant(at);
  for (Record* record : {&before_, &after_}) {
    record->go_on_with(stepping.system().layout());
    record->append(at);
  }
  impulses_.resize(impulses_.size() + at.lambda.size());
  occurred_.push_back(one);  // last: without memory for all of it, it is not listed
  looked_to_ = one.time;
}

/// The difference of two times that are the same to round-off.
double EventLog::same_time(double t, const Stepping& stepping) {
  return round_off() * std::max(std::abs(t), stepping.scales(t).time);
}

void EventLog::carry_out(Stepping& stepping) {
  if (!change_) return;
  const double t = change_->time;
  (void)read(stepping, t);
  const Moment before = seen_;
  if (auditor_ != nullptr) auditor_->sample(before.flat());
  std::vector<double> q = before.q;
  Transitions::Change change = pass(before.flat(), stepping, q);
  require_progress(stepping);
  before_.go_on_with(stepping.system().layout());
  stepping.begin_changed(t, system_, q, change.v);
  open_pulling(change, t, stepping);
  after_.go_on_with(stepping.system().layout());
  const FlatSample after = read(stepping, t);
  audit(change, after);
  list(change, before.flat(), after);
  begin_anew(t, stepping);
}

void EventLog::begin_anew(double t, Stepping& stepping) {
  const System& system = stepping.system();
  const bool timed = system.rheonomic() || system.has_timed_forces();
  const auto left = std::exchange(left_, {});
  std::optional<std::size_t> changed;
  if (change_ && change_->event < asked_for_) changed = change_->event;
  const EventWatch::Read ahead = [&](double at) {
    stepping.read_ahead(at - t, seen_);
    return seen_.flat();
  };
  const Moment start = (read(stepping, t), seen_);
  watch_.begin_anew({start.flat(), asked_for_, timed, left, changed, ahead, stepping.scales(t).time});
  looked_to_ = t;
  change_.reset();
  if (!due_.empty()) {
    change_ = due_.front();
    change_->time = t;
    due_.erase(due_.begin());
    return;
  }
  if (transitions_ == nullptr) return;
  if (const auto function = transitions_->approaching()) {
    change_ = {asked_for_ + *function, t};
  } else if (const auto fallen = watch_.fallen_at_start(asked_for_, transitions_->contacts())) {
    change_ = {*fallen, t};
  }
}

/// Throws StepFailure where changes of one kind accumulate within the run, as impacts do (see Accumulation):
/// they do not determine what follows their limit. (Contacts come to rest there by themselves.) A parabola of
/// duration D rises by D^2/8 of its acceleration: this many roots of the tolerance keep that in sight of
/// EventWatch.
void EventLog::require_progress(const Stepping& stepping) {
  const double t = change_->time, time = stepping.scales(t).time;
  if (change_->event < asked_for_) {
    Accumulation& changes = changes_[change_->event];
    changes.add(t);
    const double least = std::max(stepping.tolerance(), round_off());
    const double brief = constants.brief_changes * std::sqrt(least) * time;
    if (t + changes.left() <= stepping.end() && changes.interval() <= brief)
      watch_.chatters(change_->event, t);
  }
  const double apart = same_time(t, stepping);
  repeated_ = last_ && last_->event == change_->event && t - last_->time <= apart ? repeated_ + 1 : 0;
  last_ = change_;
  if (repeated_ >= constants.most_at_one_time) watch_.chatters(change_->event, t);
}

Transitions::Change EventLog::pass(const FlatSample& at, Stepping& stepping, std::vector<double>& q) {
  if (change_->event < asked_for_) return change_scene(at, stepping, q);
  Transitions::Change change = transitions_->pass(at, change_->event - asked_for_);
  system_ = transitions_->system();
  return change;
}

Transitions::Change EventLog::change_scene(const FlatSample& at, Stepping& stepping, std::vector<double>& q) {
  const FlatEvent& event = watch_.event(change_->event);
  const auto refuse = [&](const std::string& what) {
    throw StepFailure{"Event \"" + event.name + "\": " + what, at.time};
  };
  FlatEvent::Changed next;
  try {
    next = event.change(at);
  } catch (const std::exception& error) {
    refuse(std::string("its change threw \"") + error.what() + '"');
  } catch (...) {
    refuse("its change threw something that is no std::exception");
  }
  if (next.system->rows() != at.lambda.size() || next.system->coordinates() != at.q.size() ||
      next.system->layout()->forces.size() != stepping.system().layout()->forces.size())
    refuse("its change adds to the scene; add everything before the run, and release or impose it there");
  if (auditor_ != nullptr) auditor_->restate(at.time, next.system);
  const Problem always(next.system->without(next.system->conditional()));
  std::vector<double> v = next.v;
  const auto impulses = take_over(always, stepping.scales(at.time), at.time, next.q, v, stepping.tolerance());
  Transitions::Change change{next.v, v, std::vector<double>(at.lambda.size())};
  if (transitions_ != nullptr) change = transitions_->restate(next.system, {at.time, next.q, v}, impulses);
  change.v_before = next.v;  // what the user gives is what the impulses change
  system_ = transitions_ != nullptr ? transitions_->system() : next.system;
  for (std::size_t r = 0; r < impulses.size(); ++r) change.impulses[r] += impulses[r];
  change.what.insert(change.what.begin(), *change_);
  q = std::move(next.q);
  return change;
}

/// Where the distribution of a load among contacts is not unique, those that would pull are opened.
void EventLog::open_pulling(Transitions::Change& change, double t, Stepping& stepping) {
  FlatSample now = read(stepping, t);
  while (transitions_ != nullptr && transitions_->open_pulling(now, change.what)) {
    const std::vector<double> q(now.q.begin(), now.q.end()), v(now.v.begin(), now.v.end());
    stepping.begin_changed(t, transitions_->system(), q, v);
    now = read(stepping, t);
  }
  if (transitions_ != nullptr) transitions_->require_separation(now);
}

void EventLog::audit(const Transitions::Change& change, const FlatSample& after) {
  if (auditor_ == nullptr) return;
  auditor_->jump({after.time, after.q, change.v_before, after.v, change.impulses, change.what}, after);
}

/// With the states before and after it, and its impulses.
void EventLog::list(const Transitions::Change& change, const FlatSample& before, const FlatSample& after) {
  for (const Occurrence& one : change.what) {
    before_.append(before);
    after_.append(after);
    impulses_.insert(impulses_.end(), change.impulses.begin(), change.impulses.end());
    occurred_.push_back(one);  // last, as above
  }
}

/// In the order of time: where one contact comes to rest, at the limit of its impacts, others may have
/// impacts before that.
void EventLog::write(Record& record) const {
  record.event_names = names_;
  std::vector<std::size_t> order(occurred_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [this](std::size_t k) { return occurred_[k].time; });
  const auto of = [&](const Record& samples) {
    Record stated = samples;
    stated.layout = record.layout;
    if (std::ranges::is_sorted(order)) return std::make_shared<Record>(std::move(stated));
    auto kept = std::make_shared<Record>();
    kept->layout = record.layout;
    for (const std::size_t k : order) {
      kept->go_on_with(stated.layout_of(k));
      kept->append(stated.sample(k));
    }
    return kept;
  };
  record.at_events = of(before_);
  record.after_events = of(after_);
  record.events.clear();
  record.impulses.clear();
  if (occurred_.empty()) return;
  record.coordinates = before_.coordinates;
  const std::size_t rows = record.rows = before_.rows;  // also of a run that kept no sample
  for (const std::size_t k : order) {
    const auto own = std::span(impulses_).subspan(k * rows, rows);
    record.events.push_back(occurred_[k]);
    record.impulses.insert(record.impulses.end(), own.begin(), own.end());
  }
}

}  // namespace dalembert
