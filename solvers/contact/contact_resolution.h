#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/change.h>
#include <dalembert/solvers/contact/contact_accelerations.h>
#include <dalembert/solvers/contact/contact_accuracy.h>
#include <dalembert/solvers/contact/coupling.h>

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// An instant at which contacts change: the impacts of what touches, (1) of Contacts, and what is closed
/// after them, by (2).
class ContactResolution {
 public:
  /// Of these contacts, which it opens and closes; `triggered` are those whose switching functions have
  /// fallen to 0. Contacts, gaps and the state must outlive it.
  ContactResolution(std::shared_ptr<const System> stated, std::vector<ContactState>& contacts,
                    const ContactAccuracy& known, Gaps& gaps, const Instant& at,
                    const std::vector<std::size_t>& triggered);

  /// Once, with these in touch. Their velocities may be known only roughly, at a start and after impacts at
  /// one time; with friction the accelerations are not those of (2). See Contacts::resolve, also for what is
  /// thrown.
  void resolve(std::vector<std::size_t> touching, bool known_roughly, bool friction);
  /// What has changed: nothing before `resolve`.
  [[nodiscard]] const Change& change() const { return change_; }

 private:
  [[nodiscard]] ContactState& contact(Eigen::Index place) const;
  [[nodiscard]] bool triggered(Eigen::Index place) const {
    return triggered_[touching_[static_cast<std::size_t>(place)]] != 0;
  }
  /// The instant, after the impacts.
  [[nodiscard]] Instant after() const { return {at_.t, at_.q, change_.v}; }
  void couple(const Instant& at);
  void find_rates(bool known_roughly);
  [[nodiscard]] bool is_slow(Eigen::Index place) const;
  [[nodiscard]] Coupling::Places jerked_slowly() const;
  void strike();
  void hold(const Coupling::Places& jerked);
  void join_slow();
  [[nodiscard]] Coupling::Places open_separating();
  void close_resting(const Coupling::Places& resting);
  void open_or_close(Eigen::Index place, const PairOfContact& pair);
  void open(Eigen::Index place, double rate);
  void update_rates();

  std::shared_ptr<const System> stated_;
  std::vector<ContactState>* contacts_;
  const ContactAccuracy* known_;
  Gaps* gaps_;
  Instant at_;
  std::vector<char> triggered_;         // for each contact
  std::vector<std::size_t> touching_;   // what touches, by place among the contacts,
  std::unique_ptr<Coupling> coupling_;  // how these act on each other,
  Eigen::VectorXd U_;                   // and their rates: 0 of what rests
  Change change_;
};

}  // namespace dalembert
