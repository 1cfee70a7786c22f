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

std::vector<FlatEvent> with_switching(std::vector<FlatEvent> events,
                                      const ConditionalConstraints* conditional) {
  for (std::size_t i = 0; conditional != nullptr && i < conditional->functions(); ++i) {
    events.push_back({conditional->label(i),
                      [conditional, i](const FlatSample& now) { return conditional->switching(i, now); },
                      Crossing::falling, false});
  }
  return events;
}

EventWatch::Rate rates_of_switching(std::size_t asked_for, const ConditionalConstraints* conditional) {
  if (conditional == nullptr) return {};
  return [=](std::size_t event, const FlatSample& now) { return conditional->rate(event - asked_for, now); };
}

}  // namespace

EventLog::EventLog(std::vector<FlatEvent> events, ConditionalConstraints* conditional,
                   const ConditionalConstraints::Change* at_start, Auditor* auditor, Integration& integration)
    : asked_for_(events.size()),
      names_(names_of(events)),
      conditional_(conditional),
      auditor_(auditor),
      seen_(integration.system(), integration.start(), changes(events)),
      watch_(with_switching(std::move(events), conditional), rates_of_switching(asked_for_, conditional),
             *integration.system().layout(), integration.tolerance()),
      changes_(asked_for_),
      looked_to_(integration.time()) {
  const double t = integration.time();
  if (at_start != nullptr) {
    ConditionalConstraints::Change change = *at_start;
    open_pulling(change, t, integration);
    const FlatSample after = read(integration, t);
    FlatSample before = after;  // no step led to it: with the forces that follow
    before.v = change.v_before;
    before.energy +=
        integration.system().kinetic_energy(before.v) - integration.system().kinetic_energy(after.v);
    for (Record* record : {&before_, &after_}) record->use_layout(integration.system().layout());
    audit(change, after);
    list(change, before, after);
  }
  restart_watch(t, integration);
}

bool EventLog::changes(const std::vector<FlatEvent>& events) {
  return std::ranges::any_of(events, [](const FlatEvent& event) { return bool(event.change); });
}

FlatSample EventLog::read(Integration& integration, double t) {
  integration.read(t, seen_);
  return seen_.flat();
}

void EventLog::locate(Integration& integration) {
  if (conditional_ != nullptr && integration.start().scales.length_from_path)
    conditional_->adopt(integration.scales(integration.time()));
  const EventWatch::Read reader = [&](double t) { return read(integration, t); };
  const auto all = watch_.locate({reader, integration.time(), integration.degree(), integration.at_end()});
  std::vector<EventRecord> found;
  for (const auto& one : all)
    if (one.wanted) found.push_back(one.record);
  const auto changes = [this](const EventRecord& one) {
    return one.source >= asked_for_ || watch_.event(one.source).change;
  };
  const auto first = std::ranges::find_if(found, changes);
  // At the time of a change, or of an end, all that is due there: what was asked for before what follows from
  // the motion.
  double until =
      first == found.end() ? integration.time() : first->time + same_time(first->time, integration);
  for (const EventRecord& one : found) {
    if (one.time > until) break;
    if (changes(one)) {
      if (one.source < asked_for_) due_.push_back(one);
      continue;
    }
    list(one, integration);
    if (!watch_.event(one.source).ends || end_) continue;
    end_ = one.time;
    until = std::min(until, one.time + same_time(one.time, integration));
  }
  if (first != found.end() && first->time <= until) {
    change_ = due_.empty() ? *first : due_.front();
    if (!due_.empty()) due_.erase(due_.begin());
    if (end_) change_->time = *end_;
  }
  left_.clear();
  std::ranges::copy_if(all, std::back_inserter(left_),
                       [&](const auto& one) { return one.record.time > until; });
  if (conditional_ != nullptr)
    conditional_->require_open(read(integration, change_ ? change_->time : integration.time()));
  looked_to_ = integration.time();
}

void EventLog::list(const EventRecord& one, Integration& integration) {
  const FlatSample at = read(integration, one.time);
  if (auditor_ != nullptr) auditor_->instant(at);
  for (Record* record : {&before_, &after_}) {
    record->use_layout(integration.system().layout());
    record->append(at);
  }
  impulses_.resize(impulses_.size() + at.lambda.size());
  occurred_.push_back(one);  // last: without memory for all of it, it is not listed
  looked_to_ = one.time;
}

/// The difference of two times that are the same to round-off.
double EventLog::same_time(double t, const Integration& integration) {
  return round_off() * std::max(std::abs(t), integration.scales(t).time);
}

void EventLog::carry_out(Integration& integration) {
  if (!change_) return;
  const double t = change_->time;
  (void)read(integration, t);
  const OutputState before = seen_;
  if (auditor_ != nullptr) auditor_->sample(before.flat());
  std::vector<double> q = before.q;
  ConditionalConstraints::Change change = resolve(before.flat(), integration, q);
  require_progress(integration);
  before_.use_layout(integration.system().layout());
  integration.restart_with_constraints(t, system_, q, change.v);
  open_pulling(change, t, integration);
  after_.use_layout(integration.system().layout());
  const FlatSample after = read(integration, t);
  audit(change, after);
  list(change, before.flat(), after);
  restart_watch(t, integration);
}

void EventLog::restart_watch(double t, Integration& integration) {
  const System& system = integration.system();
  const bool timed = system.rheonomic() || system.has_timed_forces();
  const auto left = std::exchange(left_, {});
  std::optional<std::size_t> changed;
  if (change_ && change_->source < asked_for_) changed = change_->source;
  const EventWatch::Read ahead = [&](double at) {
    integration.read_ahead(at - t, seen_);
    return seen_.flat();
  };
  const OutputState start = (read(integration, t), seen_);
  watch_.restart({start.flat(), asked_for_, timed, left, changed, ahead, integration.scales(t).time});
  looked_to_ = t;
  change_.reset();
  if (!due_.empty()) {
    change_ = due_.front();
    change_->time = t;
    due_.erase(due_.begin());
    return;
  }
  if (conditional_ == nullptr) return;
  if (const auto function = conditional_->approaching()) {
    change_ = {asked_for_ + *function, t};
  } else if (const auto triggered = watch_.triggered_at_start(asked_for_, conditional_->contacts())) {
    change_ = {*triggered, t};
  }
}

/// Throws StepFailure where changes of one kind accumulate within the run, as impacts do (see Accumulation):
/// they do not determine what follows their limit. (Contacts come to rest there by themselves.) A parabola of
/// duration D rises by D^2/8 of its acceleration: this many roots of the tolerance keep that in sight of
/// EventWatch.
void EventLog::require_progress(const Integration& integration) {
  const double t = change_->time, time = integration.scales(t).time;
  if (change_->source < asked_for_) {
    Accumulation& changes = changes_[change_->source];
    changes.add(t);
    const double least = std::max(integration.tolerance(), round_off());
    const double brief = constants.brief_changes * std::sqrt(least) * time;
    if (t + changes.left() <= integration.end() && changes.interval() <= brief)
      watch_.chatters(change_->source, t);
  }
  const double apart = same_time(t, integration);
  repeated_ = last_ && last_->source == change_->source && t - last_->time <= apart ? repeated_ + 1 : 0;
  last_ = change_;
  if (repeated_ >= constants.most_at_one_time) watch_.chatters(change_->source, t);
}

ConditionalConstraints::Change EventLog::resolve(const FlatSample& at, Integration& integration,
                                                 std::vector<double>& q) {
  if (change_->source < asked_for_) return change_scene(at, integration, q);
  ConditionalConstraints::Change change = conditional_->resolve(at, change_->source - asked_for_);
  system_ = conditional_->system();
  return change;
}

ConditionalConstraints::Change EventLog::change_scene(const FlatSample& at, Integration& integration,
                                                      std::vector<double>& q) {
  const FlatEvent& event = watch_.event(change_->source);
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
      next.system->layout()->forces.size() != integration.system().layout()->forces.size())
    refuse("its change adds to the scene; add everything before the run, and release or impose it there");
  if (auditor_ != nullptr) auditor_->replace_system(at.time, next.system);
  const Problem always(next.system->without(next.system->conditional_constraints()));
  std::vector<double> v = next.v;
  const auto impulses = project_impulsively_onto(always, integration.scales(at.time), at.time, next.q, v,
                                                 integration.tolerance());
  ConditionalConstraints::Change change{next.v, v, std::vector<double>(at.lambda.size())};
  if (conditional_ != nullptr)
    change = conditional_->replace_system(next.system, {at.time, next.q, v}, impulses);
  change.v_before = next.v;  // what the user gives is what the impulses change
  system_ = conditional_ != nullptr ? conditional_->system() : next.system;
  for (std::size_t r = 0; r < impulses.size(); ++r) change.impulses[r] += impulses[r];
  change.what.insert(change.what.begin(), *change_);
  q = std::move(next.q);
  return change;
}

/// Where the distribution of a load among contacts is not unique, those that would pull are opened.
void EventLog::open_pulling(ConditionalConstraints::Change& change, double t, Integration& integration) {
  FlatSample now = read(integration, t);
  while (conditional_ != nullptr && conditional_->open_pulling(now, change.what)) {
    const std::vector<double> q(now.q.begin(), now.q.end()), v(now.v.begin(), now.v.end());
    integration.restart_with_constraints(t, conditional_->system(), q, v);
    now = read(integration, t);
  }
  if (conditional_ != nullptr) conditional_->require_separation(now);
}

void EventLog::audit(const ConditionalConstraints::Change& change, const FlatSample& after) {
  if (auditor_ == nullptr) return;
  auditor_->jump({after.time, after.q, change.v_before, after.v, change.impulses, change.what}, after);
}

/// With the states before and after it, and its impulses.
void EventLog::list(const ConditionalConstraints::Change& change, const FlatSample& before,
                    const FlatSample& after) {
  for (const EventRecord& one : change.what) {
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
      kept->use_layout(stated.layout_of(k));
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
