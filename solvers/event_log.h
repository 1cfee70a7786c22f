#pragma once

#include <dalembert/core/results/trajectory.h>
#include <dalembert/solvers/audit/auditor.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/conditional_constraints.h>
#include <dalembert/solvers/integration.h>
#include <dalembert/solvers/run/event_watch.h>

#include <optional>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// What happens in a run: the events that were asked for and the changes of constraints that hold only at
/// times, found step by step, listed, and carried out.
class EventLog {
 public:
  /// At the start of a run. `conditional`, with what happened to them there, and who audits what is listed
  /// may be null, else they must outlive this. Throws as EventWatch.
  EventLog(std::vector<FlatEvent> events, ConditionalConstraints* conditional,
           const ConditionalConstraints::Change* at_start, Auditor* auditor, Integration& integration);

  /// Whether any of them changes the scene.
  [[nodiscard]] static bool changes(const std::vector<FlatEvent>& events);

  /// Lists what happened in the last step, up to where an event ends the run or changes the scene, or a
  /// constraint changes. Throws StepFailure, EquationFault.
  void locate(Integration& integration);
  /// Goes on from a change of a constraint or of the scene, if the last step had one. Throws StepFailure,
  /// EquationFault.
  void carry_out(Integration& integration);
  /// Whether there is one to go on from, before any step: an impact drove a contact to its surface.
  [[nodiscard]] bool pending() const { return change_.has_value(); }

  /// Where an event has ended the run.
  [[nodiscard]] std::optional<double> end() const { return end_; }
  /// Where the run stands: the end of the last step that was looked at, or where that had an end or a change.
  [[nodiscard]] double reached() const { return end_ ? *end_ : change_ ? change_->time : looked_to_; }
  [[nodiscard]] const std::vector<EventRecord>& occurred() const { return occurred_; }
  /// Puts all of it among the results of a run.
  void write(Record& record) const;

 private:
  FlatSample read(Integration& integration, double t);
  void list(const EventRecord& one, Integration& integration);
  [[nodiscard]] static double same_time(double t, const Integration& integration);
  void require_progress(const Integration& integration);
  [[nodiscard]] ConditionalConstraints::Change resolve(const FlatSample& at, Integration& integration,
                                                       std::vector<double>& q);
  [[nodiscard]] ConditionalConstraints::Change change_scene(const FlatSample& at, Integration& integration,
                                                            std::vector<double>& q);
  void restart_watch(double t, Integration& integration);
  void open_pulling(ConditionalConstraints::Change& change, double t, Integration& integration);
  void list(const ConditionalConstraints::Change& change, const FlatSample& before, const FlatSample& after);
  void audit(const ConditionalConstraints::Change& change, const FlatSample& after);

  std::size_t asked_for_;
  std::vector<std::string> names_;  // of these
  ConditionalConstraints* conditional_;
  Auditor* auditor_;
  OutputState seen_;
  EventWatch watch_;
  std::vector<Accumulation> changes_;  // of each event that was asked for
  std::vector<EventRecord> occurred_;
  Record before_, after_;
  std::vector<double> impulses_;
  std::shared_ptr<const System> system_;  // that goes on after a change
  std::vector<EventRecord> due_;          // changes of the scene at the time of another one
  std::optional<EventRecord> change_, last_;
  int repeated_ = 0;                     // times that the last change was due at one time
  std::vector<EventWatch::Found> left_;  // of the last step, behind a change
  std::optional<double> end_;
  double looked_to_;
};

}  // namespace dalembert
