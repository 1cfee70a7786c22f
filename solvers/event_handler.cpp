#include "dalembert/solvers/event_handler.h"

#include <dalembert/solvers/base/accuracy.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/contact/round_off.h>
#include <dalembert/solvers/manifold/start.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
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

EventWatch::OfContacts of_contacts(std::size_t asked_for, const ConditionalConstraints* conditional) {
  if (conditional == nullptr) return {};
  return {[=](std::size_t event, const FlatSample& at) { return conditional->rate(event - asked_for, at); },
          [=](std::size_t event, double from) { return conditional->unit(event - asked_for, from); },
          [=](std::size_t event) { return conditional->margin(event - asked_for); }};
}

}  // namespace

EventHandler::EventHandler(std::vector<FlatEvent> events, ConditionalConstraints* conditional,
                           Auditor* auditor, const Integration& integration)
    : asked_for_(events.size()),
      events_(names_of(events)),
      conditional_(conditional),
      auditor_(auditor),
      seen_(integration.system(), integration.start(), any_changes_scene(events)),
      watch_(with_switching(std::move(events), conditional), of_contacts(asked_for_, conditional),
             integration.system().layout()->scene, integration.tolerance()),
      changes_(asked_for_) {}

bool EventHandler::any_changes_scene(const std::vector<FlatEvent>& events) {
  return std::ranges::any_of(events, [](const FlatEvent& event) { return bool(event.change); });
}

bool EventHandler::changes(const EventRecord& one) const {
  return !was_asked_for(one) || watch_.event(one.source).change;
}

FlatSample EventHandler::read(Integration& integration, double t) {
  integration.read(t, seen_);
  return seen_.flat();
}

/// At the time of a change, or of an end, all that is due there: what was asked for before what follows from
/// the motion.
void EventHandler::locate(Integration& integration, Stop& stop) {
  if (conditional_ != nullptr && integration.start().scales.length_from_path)
    conditional_->adopt(integration.scales_at_step());  // what a run claims of its results only grows
  if (conditional_ != nullptr && conditional_->slides_in_space())
    conditional_->begin_step(read(integration, integration.start_of_step()));
  const EventWatch::Read reader = [&](double t) { return read(integration, t); };
  const auto all = watch_.locate({reader, integration.time(), integration.degree(), integration.at_end()});
  if (take_step_again(all, integration, stop)) return;
  std::vector<EventRecord> found;
  for (const auto& one : all)
    if (one.wanted) found.push_back(one.record);
  const auto first = std::ranges::find_if(found, [this](const auto& one) { return changes(one); });
  double until =
      first == found.end() ? integration.time() : first->time + same_time(first->time, integration);
  std::vector<EventRecord> due;
  for (const EventRecord& one : found) {
    if (one.time > until) break;
    if (changes(one)) {
      if (was_asked_for(one)) due.push_back(one);
      continue;
    }
    audit_and_list(one, integration);
    if (stop.ends_run) continue;
    stop.time = one.time;
    stop.ends_run = watch_.event(one.source).ends;
    if (stop.ends_run) until = std::min(until, one.time + same_time(one.time, integration));
  }
  const bool changes_there = first != found.end() && first->time <= until;
  if (changes_there && due.empty()) due.push_back(*first);
  const double end = changes_there ? due.front().time : integration.time();
  if (!stop.ends_run) stop.time = end;
  stop.changes = std::move(due);
  stop.not_reached.clear();
  // What is 0 here as its root is here is not on its way to its next one.
  const double here = stop.time + same_time(stop.time, integration);
  const auto is_here = [&](const EventWatch::Found& one) {
    return std::ranges::any_of(all, [&](const EventWatch::Found& other) {
      return other.record.source == one.record.source && other.record.time >= stop.time &&
             other.record.time <= here;
    });
  };
  std::ranges::copy_if(all, std::back_inserter(stop.not_reached),
                       [&](const auto& one) { return one.record.time > until && !is_here(one); });
  if (conditional_ == nullptr) return;
  const double reached = changes_there || stop.ends_run ? stop.time : integration.time();
  const FlatSample at = read(integration, reached);
  integration.as_read(reached, [&] { conditional_->require_open(at); });
}

/// From where it began, if it has gone past a rest in space: then towards it.
bool EventHandler::take_step_again(const std::vector<EventWatch::Found>& all, Integration& integration,
                                   Stop& stop) {
  if (conditional_ == nullptr) return false;
  const auto passes = std::ranges::find_if(all, [&](const EventWatch::Found& one) {
    return !was_asked_for(one.record) &&
           conditional_->passes_rest(one.record.source - asked_for_, read(integration, one.record.time));
  });
  if (passes == all.end()) return false;
  const double t = integration.start_of_step();
  stop = {t, false, {{passes->record.source, t}}, {}, all};
  return true;
}

void EventHandler::audit_and_list(const EventRecord& one, Integration& integration) {
  const FlatSample at = read(integration, one.time);
  if (auditor_ != nullptr) integration.as_read(one.time, [&] { auditor_->instant(at); });
  list(one, at, integration);
}

void EventHandler::list(const EventRecord& one, const FlatSample& at, const Integration& integration) {
  const EventList::Side there{at, integration.system().layout()};
  events_.add(std::span(&one, 1), there, there, std::vector<double>(at.lambda.size()));
}

/// The difference of two times that are the same to round-off.
double EventHandler::same_time(double t, const Integration& integration) {
  return round_off() * std::max(std::abs(t), integration.scales(t).time);
}

Change EventHandler::resolve(const Stop& stop, const FlatSample& at, Integration& integration) {
  const EventRecord due{stop.changes.front().source, stop.time};
  // Of contacts on the sides behind a switch, where a step that is taken again began there.
  const auto resolved = [&] { return conditional_->resolve(at, due.source - asked_for_); };
  Change change =
      was_asked_for(due) ? change_scene(due, at, integration) : integration.as_read(stop.time, resolved);
  require_progress(due, integration);
  return change;
}

/// A force that jumps may open what was closed, or let slide what stuck. No root shows it: behind the switch
/// the functions are others.
std::optional<Change> EventHandler::go_behind_switch(Integration& integration) {
  const double t = integration.time();
  FlatSample now = read(integration, t);
  const bool goes_on = integration.go_behind_switch();
  if (conditional_ == nullptr) return std::nullopt;
  const Branches holding(nullptr, &integration.behind_switch());
  if (!goes_on) return conditional_->resolve_jump({t, now.q, now.v});
  now = read(integration, t);
  const auto function = conditional_->fallen(now);
  if (!function) return std::nullopt;
  require_progress({asked_for_ + *function, t}, integration);
  return conditional_->resolve(now, *function);
}

/// Throws StepFailure where changes of one kind accumulate within the run, as impacts do (see Accumulation):
/// they do not determine what follows their limit. (Contacts come to rest there by themselves.) A parabola of
/// duration D rises by D^2/8 of its acceleration: this many roots of the tolerance keep that in sight of
/// EventWatch.
void EventHandler::require_progress(const EventRecord& change, const Integration& integration) {
  const double t = change.time, time = integration.scales(t).time;
  if (was_asked_for(change)) {
    Accumulation& changes = changes_[change.source];
    changes.add(t);
    const double least = std::max(integration.tolerance(), round_off());
    const double brief = Accuracy(least).brief_change() * time;
    if (t + changes.left() <= integration.end() && changes.interval() <= brief)
      watch_.chatters(change.source, t);
  }
  const double apart = same_time(t, integration);
  const bool repeats =
      last_change_ && last_change_->source == change.source && t - last_change_->time <= apart;
  const bool here = last_change_ && t - last_change_->time <= apart;
  repeated_ = repeats ? repeated_ + 1 : 0;
  if (!here) asked_here_ = 0;
  if (was_asked_for(change)) ++asked_here_;
  last_change_ = change;
  const auto most = static_cast<std::size_t>(constants.most_at_one_time);
  if (repeated_ >= constants.most_at_one_time || asked_here_ > most * asked_for_)
    watch_.chatters(change.source, t);
}

Change EventHandler::change_scene(const EventRecord& due, const FlatSample& at, Integration& integration) {
  const FlatEvent& event = watch_.event(due.source);
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
  Change change = integration.as_read(at.time, [&] { return put_onto(next, at, integration); });
  change.v_before = next.v;  // what the user gives is what the impulses change
  change.events.insert(change.events.begin(), due);
  return change;
}

/// What an event has changed, put onto the constraints by impulses. The positions keep to the contacts that
/// stay closed: a joint that holds to the run's accuracy would lift them off, or press them in.
Change EventHandler::put_onto(const FlatEvent::Changed& next, const FlatSample& at,
                              Integration& integration) {
  const Problem always(next.system->without(next.system->conditions().conditional_constraints()));
  std::vector<double> q = next.q, v = next.v;
  const Problem held =
      conditional_ == nullptr
          ? always
          : Problem(next.system->without(conditional_->not_held(*next.system, {at.time, q, v})));
  const double known = integration.error_of_position(at.time);
  const Scales scales = integration.scales(at.time);
  const auto impulses = project_impulsively_onto(always, held, scales, at.time, q, v, known);
  double moved = 0.0;
  for (std::size_t i = 0; i < q.size(); ++i)
    moved = std::max(moved, std::abs(q[i] - next.q[i]) / scales.unit(i) * scales.length);
  integration.displace(moved);
  Change change{.v = v, .impulses = std::vector<double>(at.lambda.size()), .q = q, .system = next.system};
  if (conditional_ != nullptr)
    change = conditional_->replace_system(next.system, {at.time, q, v}, impulses, {next.v, known});
  for (std::size_t r = 0; r < impulses.size(); ++r) change.impulses[r] += impulses[r];
  return change;
}

/// Where the distribution of a load among contacts is not unique, those that would pull are opened.
void EventHandler::open_pulling(Change& change, double t, Integration& integration) {
  if (conditional_ == nullptr) return;
  FlatSample now = read(integration, t);
  while (integration.as_read(t, [&] { return conditional_->open_pulling(now, change); })) {
    const std::vector<double> q(now.q.begin(), now.q.end()), v(now.v.begin(), now.v.end());
    integration.restart_with_constraints(t, change.system, q, v);
    now = read(integration, t);
  }
  integration.as_read(t, [&] { conditional_->settle(now); });
}

void EventHandler::audit(const Change& change, const FlatSample& after, Integration& integration) {
  if (auditor_ == nullptr) return;
  integration.as_read(after.time, [&] {
    auditor_->jump({after.time, after.q, change.v_before, after.v, change.impulses, change.events}, after);
  });
}

void EventHandler::list(Change change, const EventList::Side& before, Integration& integration) {
  open_pulling(change, before.sample.time, integration);
  const FlatSample after = read(integration, before.sample.time);
  audit(change, after, integration);
  events_.add(change.events, before, {after, integration.system().layout()}, change.impulses);
}

/// No step has led there: the sample before has the forces of the one after.
void EventHandler::list_at_start(Change change, Integration& integration) {
  open_pulling(change, integration.time(), integration);
  const System& system = integration.system();
  const FlatSample after = read(integration, integration.time());
  FlatSample before = after;
  before.v = change.v_before;
  before.energy += system.kinetic_energy(before.v) - system.kinetic_energy(after.v);
  audit(change, after, integration);
  events_.add(change.events, {before, system.layout()}, {after, system.layout()}, change.impulses);
}

Stop EventHandler::restart(const Stop& stop, const FlatSample* before, Integration& integration) {
  const double t = stop.time;
  const System& system = integration.system();
  std::optional<std::size_t> changed;
  if (stop.made && was_asked_for(*stop.made)) changed = stop.made->source;
  const EventWatch::Read ahead = [&](double at) {
    integration.read_ahead(at - t, seen_);
    return seen_.flat();
  };
  const OutputState start = (read(integration, t), seen_);
  const bool timed = system.rheonomic() || system.forces().timed();
  const auto jumped =
      watch_.restart({start.flat(), before, asked_for_, timed, stop.not_reached, changed, ahead,
                      integration.scales(t).time, integration.scales(t).length, system});
  Stop next{t, stop.ends_run, stop.changes};
  for (const EventWatch::Found& one : jumped) {
    if (!one.wanted) continue;
    if (changes(one.record)) {
      next.changes.push_back(one.record);
      continue;
    }
    list(one.record, start.flat(), integration);
    next.ends_run = next.ends_run || watch_.event(one.record.source).ends;
  }
  if (next.changes.empty() && conditional_ != nullptr) {
    if (const auto function = conditional_->approaching()) {
      next.changes.push_back({asked_for_ + *function, t});
    } else if (const auto triggered = watch_.triggered_at_start(asked_for_, conditional_->contacts())) {
      next.changes.push_back({*triggered, t});
    }
  }
  return next;
}

}  // namespace dalembert
