#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/change.h>
#include <dalembert/solvers/contact/contact_accuracy.h>
#include <dalembert/solvers/contact/coupling.h>

#include <Eigen/Core>

#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The impacts of touching contacts at an instant, (1) of Contacts, and the rest where they accumulate: where
/// at the speed of the last one a contact would move by less than the tolerance in the time left, all
/// contacts of its island with an impact since its previous one come to rest. That changes no later position.
class ContactImpacts {
 public:
  /// Of these contacts, which it notes the impacts of; all must outlive it.
  ContactImpacts(const System& stated, std::vector<ContactState>& contacts, const ContactAccuracy& known,
                 const Instant& at)
      : stated_(&stated),
        contacts_(&contacts),
        known_(&known),
        at_(at),
        rounding_(known.scales.rounding(at.q)) {}

  /// Solves (1), of each island. U becomes U+. Throws StepFailure where nothing satisfies it.
  void solve(const Coupling& coupling, const std::vector<std::size_t>& touching, Eigen::VectorXd& U,
             Change& change) const;

  /// Of the impacts that accumulate in an island; the time since which each contact of them was struck.
  struct Limit {
    std::size_t island;
    double time, since, uncertain;
  };
  /// Notes the impacts, once. Returns the islands where they accumulate, and when they end there: where all
  /// that was struck has no way left. What has no restitution has none at once, beside others that still
  /// bounce.
  [[nodiscard]] std::vector<Limit> note(const Change& change, const Gaps& gaps);
  /// All that was struck in the impacts of these limits.
  [[nodiscard]] std::vector<std::size_t> struck(const std::vector<Limit>& limits) const;
  /// Brings all rates in these islands to 0, after the impacts there.
  void rest(const Coupling& coupling, const std::vector<std::size_t>& touching,
            const std::vector<Limit>& limits, Eigen::VectorXd& U, Change& change) const;

 private:
  [[nodiscard]] ContactState& contact_of(const EventRecord& event) const;
  [[nodiscard]] double error_of_time(const Change& change, std::size_t island, const Gaps& gaps) const;
  [[nodiscard]] bool hops_end(const ContactState& contact, double speed) const;

  const System* stated_;
  std::vector<ContactState>* contacts_;
  const ContactAccuracy* known_;
  Instant at_;
  double rounding_;  // of the positions
};

}  // namespace dalembert
