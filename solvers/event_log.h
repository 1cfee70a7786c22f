#pragma once

#include <dalembert/core/results/trajectory.h>
#include <dalembert/solvers/audit/auditor.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/transitions.h>
#include <dalembert/solvers/run/event_watch.h>
#include <dalembert/solvers/stepping.h>

#include <optional>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// What happens in a run: the events that were asked for and the changes of constraints that hold only at
/// times, found step by step, listed, and carried out.
class EventLog {
 public:
  /// At the start of a run. `transitions`, with what happened to them there, and who audits what is listed
  /// may be null, else they must outlive this. Throws as EventWatch.
  EventLog(std::vector<FlatEvent> events, Transitions* transitions, const Transitions::Change* at_start,
           Auditor* auditor, Stepping& stepping);

  /// Whether any of them changes the scene.
  [[nodiscard]] static bool changes(const std::vector<FlatEvent>& events);

  /// Lists what happened in the last step, up to where an event ends the run or changes the scene, or a
  /// constraint changes. Throws StepFailure, EquationFault.
  void look(Stepping& stepping);
  /// Goes on from a change of a constraint or of the scene, if the last step had one. Throws StepFailure,
  /// EquationFault.
  void carry_out(Stepping& stepping);
  /// Whether there is one to go on from, before any step: an impact drove a contact to its surface.
  [[nodiscard]] bool pending() const { return change_.has_value(); }

  /// Where an event has ended the run.
  [[nodiscard]] std::optional<double> end() const { return end_; }
  /// Where the run stands: the end of the last step that was looked at, or where that had an end or a change.
  [[nodiscard]] double reached() const { return end_ ? *end_ : change_ ? change_->time : looked_to_; }
  [[nodiscard]] const std::vector<Occurrence>& occurred() const { return occurred_; }
  /// Puts all of it among the results of a run.
  void write(Record& record) const;

 private:
  FlatSample read(Stepping& stepping, double t);
  void list(const Occurrence& one, Stepping& stepping);
  [[nodiscard]] static double same_time(double t, const Stepping& stepping);
  void require_progress(const Stepping& stepping);
  [[nodiscard]] Transitions::Change pass(const FlatSample& at, Stepping& stepping, std::vector<double>& q);
  [[nodiscard]] Transitions::Change change_scene(const FlatSample& at, Stepping& stepping,
                                                 std::vector<double>& q);
  void begin_anew(double t, Stepping& stepping);
  void open_pulling(Transitions::Change& change, double t, Stepping& stepping);
  void list(const Transitions::Change& change, const FlatSample& before, const FlatSample& after);
  void audit(const Transitions::Change& change, const FlatSample& after);

  std::size_t asked_for_;
  std::vector<std::string> names_;  // of these
  Transitions* transitions_;
  Auditor* auditor_;
  Moment seen_;
  EventWatch watch_;
  std::vector<Accumulation> changes_;  // of each event that was asked for
  std::vector<Occurrence> occurred_;
  Record before_, after_;
  std::vector<double> impulses_;
  std::shared_ptr<const System> system_;  // that goes on after a change
  std::vector<Occurrence> due_;           // changes of the scene at the time of another one
  std::optional<Occurrence> change_, last_;
  int repeated_ = 0;                     // times that the last change was due at one time
  std::vector<EventWatch::Found> left_;  // of the last step, behind a change
  std::optional<double> end_;
  double looked_to_;
};

}  // namespace dalembert
