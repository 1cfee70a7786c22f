#pragma once

#include <dalembert/core/results/trajectory.h>
#include <dalembert/solvers/audit/auditor.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/change.h>
#include <dalembert/solvers/contact/conditional_constraints.h>
#include <dalembert/solvers/integration.h>
#include <dalembert/solvers/run/event_list.h>
#include <dalembert/solvers/run/event_watch.h>

#include <optional>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Where a run stands: the end of its last step, or before that where an event ends the run or something
/// changes.
struct Stop {
  double time;
  bool ends_run = false;                         ///< an event has ended the run there
  std::vector<EventRecord> changes{};            ///< due there, in this order
  std::optional<EventRecord> made{};             ///< the one of them from which the run goes on
  std::vector<EventWatch::Found> not_reached{};  ///< roots of the last step behind it
};

/// Finds the events of a run, those that were asked for and those of constraints that hold only at times, and
/// resolves what they change.
class EventHandler {
 public:
  /// Whom audits, and the conditional constraints of the run, may be null, else they must outlive this.
  /// Throws as EventWatch.
  EventHandler(std::vector<FlatEvent> events, ConditionalConstraints* conditional, Auditor* auditor,
               const Integration& integration);

  /// Whether any of them changes the scene.
  [[nodiscard]] static bool any_changes_scene(const std::vector<FlatEvent>& events);

  // All of these throw StepFailure, EquationFault.

  /// The earliest stop in the last step. Lists what happened before it and changes nothing.
  void locate(Integration& integration, Stop& stop);
  /// What the first change that is due at a stop makes of a state.
  [[nodiscard]] Change resolve(const Stop& stop, const FlatSample& at, Integration& integration);
  /// Leaves a switch of the equations; returns what that changes, if anything.
  [[nodiscard]] std::optional<Change> go_behind_switch(Integration& integration);
  /// Lists a change from which the run goes on now. Contacts that would pull are opened before.
  void list(Change change, const EventList::Side& before, Integration& integration);
  /// The same at the start of a run.
  void list_at_start(Change change, Integration& integration);
  /// Follows the functions from a stop where something has changed, of this sample, or from the start of the
  /// run.
  [[nodiscard]] Stop restart(const Stop& stop, const FlatSample* before, Integration& integration);

  [[nodiscard]] const EventList& events() const { return events_; }

 private:
  FlatSample read(Integration& integration, double t);
  bool take_step_again(const std::vector<EventWatch::Found>& all, Integration& integration, Stop& stop);
  void audit_and_list(const EventRecord& one, Integration& integration);
  void list(const EventRecord& one, const FlatSample& at, const Integration& integration);
  [[nodiscard]] bool changes(const EventRecord& one) const;
  [[nodiscard]] bool was_asked_for(const EventRecord& one) const { return one.source < asked_for_; }
  [[nodiscard]] static double same_time(double t, const Integration& integration);
  void require_progress(const EventRecord& change, const Integration& integration);
  [[nodiscard]] Change change_scene(const EventRecord& due, const FlatSample& at, Integration& integration);
  [[nodiscard]] Change put_onto(const FlatEvent::Changed& next, const FlatSample& at,
                                Integration& integration);
  void open_pulling(Change& change, double t, Integration& integration);
  void audit(const Change& change, const FlatSample& after, Integration& integration);

  std::size_t asked_for_;
  EventList events_;
  ConditionalConstraints* conditional_;
  Auditor* auditor_;
  OutputState seen_;
  EventWatch watch_;
  std::vector<Accumulation> changes_;  // of each event that was asked for
  std::optional<EventRecord> last_change_;
  int repeated_ = 0;            // times that the last change was due at one time
  std::size_t asked_here_ = 0;  // changes that were asked for, at the time of the last one
};

}  // namespace dalembert
