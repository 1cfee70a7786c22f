#pragma once

#include <dalembert/core/results/trajectory.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/contacts.h>
#include <dalembert/solvers/run/event_watch.h>
#include <dalembert/solvers/stepping.h>

#include <optional>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// What happens in a run: the events that were asked for and the changes of its one-sided constraints, found
/// step by step, listed, and carried out.
class EventLog {
 public:
  /// At the start of a run. `contacts`, with what happened to them there, may be null, else they must outlive
  /// this. Throws as EventWatch.
  EventLog(std::vector<FlatEvent> events, Contacts* contacts, const Contacts::Change* at_start,
           Stepping& stepping);

  /// Lists what happened in the last step, up to where an event ends the run or a contact changes. Throws
  /// StepFailure, EquationFault.
  void look(Stepping& stepping);
  /// Goes on from a change of a contact, if the last step had one. Throws StepFailure, EquationFault.
  void carry_out(Stepping& stepping);
  /// Whether there is one to go on from, before any step: an impact drove a contact to its surface.
  [[nodiscard]] bool pending() const { return change_.has_value(); }

  /// Where an event has ended the run.
  [[nodiscard]] std::optional<double> end() const { return end_; }
  /// Where the run stands whose last step ended at `t`: there, or where that step had an end or a change.
  [[nodiscard]] double reached(double t) const { return end_ ? *end_ : change_ ? change_->time : t; }
  [[nodiscard]] const std::vector<Occurrence>& occurred() const { return occurred_; }
  /// Puts all of it among the results of a run.
  void write(Record& record) const;

 private:
  struct Pending {
    std::size_t contact;
    double time;
  };
  FlatSample read(Stepping& stepping, double t);
  void begin_anew(double t, Stepping& stepping);
  void go_on(const Contacts::Change& change, double t, Stepping& stepping);

  std::size_t asked_for_;
  Contacts* contacts_;
  Moment seen_;
  EventWatch watch_;
  std::vector<Occurrence> occurred_;
  Record before_, after_;
  std::vector<double> impulses_;
  std::optional<Pending> change_;
  std::optional<double> end_;
};

}  // namespace dalembert
