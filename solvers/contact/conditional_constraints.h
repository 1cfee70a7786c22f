#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/contacts.h>
#include <dalembert/solvers/contact/dry_friction.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// All constraints of a run that hold only at times: contacts, and dry friction.
class ConditionalConstraints {
 public:
  /// At a state that satisfies all constraints that always hold. Throws InconsistentStart where a gap is
  /// negative.
  ConditionalConstraints(const std::shared_ptr<const System>& stated, const Scales& scales, double tolerance,
                         const Instant& start, double duration);

  /// With those in force that are now, and the others not.
  [[nodiscard]] const std::shared_ptr<const System>& system() const {
    return friction_.any() ? friction_.system() : contacts_.system();
  }
  /// Switching functions, which fall through 0 where something changes, and what each belongs to.
  [[nodiscard]] std::size_t functions() const { return contacts_.size() + friction_.functions(); }
  /// Of contacts, which come first.
  [[nodiscard]] std::size_t contacts() const { return contacts_.size(); }
  [[nodiscard]] std::string label(std::size_t function) const;
  [[nodiscard]] double switching(std::size_t function, const FlatSample& now) const;
  /// Its derivative by time; NaN where it is not known.
  [[nodiscard]] double rate(std::size_t function, const FlatSample& now) const;
  /// The unit of its values from a time on, as things are now; 0 if that is the size of the values
  /// themselves.
  [[nodiscard]] double unit(std::size_t function, double from) const;
  /// What its values are larger by than what is 0 where it changes, so that round-off changes nothing.
  [[nodiscard]] double margin(std::size_t function) const;
  /// See Contacts.
  void require_open(const FlatSample& now) { contacts_.require_open(now); }
  /// After a change, once no contact is left that would pull. Throws as Contacts::require_separation and
  /// DryFriction::settle.
  void settle(const FlatSample& now) {
    contacts_.require_separation(now);
    friction_.settle(contacts_.open(), {now.time, now.q, now.v});
  }

  /// What happens at the start. Throws as Contacts::resolve and DryFriction::find_modes.
  [[nodiscard]] Change resolve_start(const Instant& at);
  /// Goes on from where a switching function has fallen to 0. Throws likewise.
  [[nodiscard]] Change resolve(const FlatSample& at, std::size_t function);
  /// The first function that is negative where the equations have just jumped.
  [[nodiscard]] std::optional<std::size_t> fallen(const FlatSample& behind);
  /// Goes on where the velocities that hold what is closed and sticks jump, as those of a drive may. Throws
  /// likewise.
  [[nodiscard]] Change resolve_jump(const Instant& at);
  /// See Contacts.
  [[nodiscard]] std::optional<std::size_t> approaching() const { return contacts_.approaching(); }
  /// By their numbers, what does not hold the positions of a state that a change of the scene leaves, with
  /// its equations: friction, and the contacts that are open there.
  [[nodiscard]] std::vector<std::size_t> not_held(const System& stated, const Instant& at) const;
  /// Goes on from a given state, reached by impulses, with equations whose parameters may differ. Throws
  /// likewise.
  [[nodiscard]] Change replace_system(const std::shared_ptr<const System>& stated, const Instant& at,
                                      std::span<const double> impulses, const Joining& joining);
  /// The scales of the run, where they differ from those of the constraints that always hold.
  void adopt(const Scales& scales);
  /// See DryFriction.
  [[nodiscard]] bool slides_in_space() const { return friction_.slides_in_space(); }
  void begin_step(const FlatSample& at) { friction_.begin_step({at.time, at.q, at.v}); }
  [[nodiscard]] bool passes_rest(std::size_t function, const FlatSample& at) const;
  /// See Contacts.
  [[nodiscard]] bool open_pulling(const FlatSample& now, Change& change);

 private:
  [[nodiscard]] Change resolve_friction(Change of_contacts, const Instant& at,
                                        std::optional<std::size_t> triggered = {},
                                        std::span<const double> unknown = {});
  void find_modes(const Instant& at, std::optional<std::size_t> triggered, Change& change);

  Contacts contacts_;
  DryFriction friction_;
};

}  // namespace dalembert
