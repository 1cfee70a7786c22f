#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/change.h>
#include <dalembert/solvers/contact/contact_accuracy.h>
#include <dalembert/solvers/contact/contact_forces.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The one-sided constraints of a run: which of them are closed, and what happens where that changes.
///
/// With gaps s g >= 0 and forces s lambda >= 0, s the admissible sign of each contact, U = d(s g)/dt,
///
///   impact:        P >= 0,       U+ + e U- >= 0,   P (U+ + e U-) = 0    (Newton; Moreau for several) (1)
///   acceleration:  lambda >= 0,  dU/dt >= 0,       lambda dU/dt = 0                                      (2)
///
/// over the touching contacts, P the impulses, U+ - U- and dU/dt by Coupling. Both are solved exactly, and
/// have a unique U+ and dU/dt. Energy changes by sum (1 - e) U- P / 2 <= 0. (Where a joint is imposed at the
/// same time e multiplies the slower one of the approaches before and after its impulse, 0 if one is none: of
/// that impulse no part bounces, and one contact gains no energy.) A contact with dU/dt = 0 by
/// (2) is closed: it is in force, like any other constraint, until its force changes its sign.
///
/// Each island of the scene has its own (1) and (2); only those where something happens are looked at.
/// Where impacts accumulate, contacts come to rest, see ContactImpacts.
class Contacts {
 public:
  /// At a state that satisfies all other constraints, of a run of this duration; whether there is friction
  /// that sticks and slides. Throws InconsistentStart where a gap is negative.
  Contacts(std::shared_ptr<const System> stated, const Scales& scales, double tolerance, const Instant& start,
           double duration, bool friction);
  /// The system with the closed contacts in force, and the others not.
  [[nodiscard]] const std::shared_ptr<const System>& system() const { return system_; }
  [[nodiscard]] const std::shared_ptr<const System>& stated() const { return stated_; }
  [[nodiscard]] std::size_t size() const { return contacts_.size(); }
  [[nodiscard]] std::string label(std::size_t contact) const {
    return stated_->row_label(contacts_[contact].row);
  }
  /// Goes on with these equations, whose parameters may differ, at a state that may too: returns what touches
  /// there. Throws StepFailure where a gap is negative, naming the contact.
  [[nodiscard]] std::vector<std::size_t> replace_system(std::shared_ptr<const System> stated,
                                                        const Instant& at,
                                                        const std::optional<Joining>& joining);
  /// The numbers in the layout of those that are open at a state and with equations that a change leaves.
  [[nodiscard]] std::vector<std::size_t> open_in(const System& stated, const Instant& at) const;
  void adopt(const Scales& scales) {
    known_.scales = scales;
    forget_instant();  // it was measured by the old ones
  }
  /// The state watched goes on from another one, which may be at the same time.
  void forget_instant() {
    gaps_.forget();
    forces_.forget();
  }

  /// A switching function for each, which falls through 0 where the contact opens or closes: the force of a
  /// closed one; the gap of an open one over the time since it opened, which has no root there. (One that has
  /// opened and is not above the surface yet, within the error of a step, but separates counts by its rate:
  /// at first the gap is round-off, over a time that is as short.) A force that is 0 to the tolerance,
  /// relative to the others, has not fallen.
  [[nodiscard]] double switching(std::size_t contact, const FlatSample& now) const;
  /// Its derivative by time while the contact is open; NaN where it is not known.
  [[nodiscard]] double rate(std::size_t contact, const FlatSample& now) const;
  /// The unit of its values from a time on: of one that has opened, but not left its surface yet by more than
  /// a step errs, a speed. (That error over the time in which forces hardly change is what is known of it,
  /// see Accuracy.) Of one that has left it a size of which the round-off of its gap, over the time since it
  /// opened, is the part to which forces are known. 0 of others: their own size.
  [[nodiscard]] double unit(std::size_t contact, double from) const;
  /// Notes which open contacts have separated where a step ends, or a change, and which closed ones are
  /// pressed. Throws StepFailure, naming it, if one has been penetrated unnoticed.
  void require_open(const FlatSample& now);

  /// That no surface approaches what rests on it openly, after a change. Throws StepFailure, naming it: of
  /// redundant contacts with friction which are closed is not always found.
  void require_separation(const FlatSample& now) const;

  /// The impacts of that state, and which contacts are closed after them. What touches and separates is open.
  Change resolve_start(const Instant& start);
  /// A contact driven back to its surface by an impact on others, of those that touched and were separating:
  /// its impact is next, at the same time.
  [[nodiscard]] std::optional<std::size_t> approaching() const;
  /// Goes on from an instant at which the switching functions of some contacts have fallen to 0. Throws
  /// StepFailure where no velocities or accelerations satisfy (1), (2), naming the contacts; EquationFault.
  /// With friction accelerations are not those of (2): what touches and does not separate is closed then,
  /// what has fallen open, and `open_pulling` finds what else opens.
  /// What joints have set moving by no more than is known takes its part of their impulse and stays closed.
  Change resolve(const Instant& at, const std::vector<std::size_t>& triggered);
  /// Of each coordinate this part of the top speed so far of its island: what is not coupled to it says
  /// nothing of its error.
  [[nodiscard]] std::vector<double> unknown_speeds(double known) const;
  /// The first closed one, if there is any, that others drive apart, whatever its force is: no pull shows it.
  [[nodiscard]] std::optional<std::size_t> driven_apart(const Instant& at) const;
  /// Where the forces of closed contacts are not determined those of least norm may pull, where dry friction
  /// reads them or all cannot push, though others, those of (2), push: opens the contacts without a force by
  /// these; with friction the one that pulls most.
  /// Returns whether there was any, and adds those closed before.
  [[nodiscard]] bool open_pulling(const FlatSample& now, std::vector<EventRecord>& events);
  /// The numbers in the layout of those that are open.
  [[nodiscard]] std::vector<std::size_t> open() const;

 private:
  void find_gaps(const Instant& at) const { gaps_.find(*stated_, known_.scales, at); }
  [[nodiscard]] double no_pull(const ContactState& contact, const FlatSample& now) const;
  [[nodiscard]] bool counts_by_rate(const ContactState& contact) const;
  [[nodiscard]] std::vector<std::size_t> touching(const Instant& at,
                                                  const std::vector<std::size_t>& triggered) const;
  void join_within_error(const Instant& at, std::vector<std::size_t>& touching) const;
  void note_speeds(std::span<const double> v);
  void rebuild_system();

  std::shared_ptr<const System> stated_, system_;
  ContactAccuracy known_;
  bool friction_;
  std::vector<ContactState> contacts_;
  std::vector<std::size_t> touching_at_start_;
  bool started_ = false;
  bool everywhere_ = true;  // all islands are to be looked at: at the start, and after a change of the scene
  std::vector<double> fastest_;   // the top speed of each coordinate so far
  mutable Gaps gaps_;             // of the state watched,
  mutable ContactForces forces_;  // and its forces
};

}  // namespace dalembert
