#pragma once

#include <dalembert/core/results/sample.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/contact_accuracy.h>
#include <dalembert/solvers/contact/coupling.h>

#include <Eigen/Core>

#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// What (2) of Contacts gives for a contact, and the unit and the largest without forces of what it is
/// coupled with.
struct PairOfContact {
  double acceleration = 0.0, force = 0.0, unit = 0.0, largest = 0.0;
};

/// The accelerations of touching contacts at an instant, (2) of Contacts.
class ContactAccelerations {
 public:
  /// Of these contacts; all must outlive it.
  ContactAccelerations(const System& stated, std::vector<ContactState>& contacts,
                       const ContactAccuracy& known, const Instant& at)
      : stated_(&stated),
        contacts_(&contacts),
        known_(&known),
        at_(at),
        rounding_(known.scales.rounding(at.q)) {}

  /// Without forces of those that touch. What neither leaves nor is pressed, to round-off, has none; nor has
  /// what leaves no faster than accelerations are known, or for no longer than times are, and is pressed
  /// soon: an error of its positions is what parts it. Notes what each has been accepted by.
  [[nodiscard]] Eigen::VectorXd without_forces(Coupling& coupling, const std::vector<std::size_t>& touching);
  /// One for each that touches, filled for those that rest, at these places; `free` is what `without_forces`
  /// gave. Throws StepFailure where nothing satisfies (2).
  [[nodiscard]] std::vector<PairOfContact> pairs(const Coupling& coupling,
                                                 const std::vector<std::size_t>& touching,
                                                 const Coupling::Places& resting,
                                                 const Eigen::VectorXd& free) const;

 private:
  const System* stated_;
  std::vector<ContactState>* contacts_;
  const ContactAccuracy* known_;
  Instant at_;
  double rounding_;  // of the positions
};

/// See Contacts::require_separation.
void require_open_at_rest(const System& stated, std::span<const ContactState> contacts,
                          const ContactAccuracy& known, const Gaps& gaps, const FlatSample& now);

}  // namespace dalembert
