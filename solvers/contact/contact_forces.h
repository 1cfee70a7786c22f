#pragma once

#include <dalembert/core/results/sample.h>
#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/contact_accuracy.h>

#include <limits>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The forces of the instant looked at last, and how exactly they are known where a contact is.
class ContactForces {
 public:
  explicit ContactForces(const System& stated) : e_(stated.evaluation()) {}

  void forget() { time_ = std::numeric_limits<double>::quiet_NaN(); }
  /// What is no pull of a closed contact yet, with those constraints in force: a part, as positions are
  /// known, of the forces on what it touches, as they act on its gap; what springs make of the rounding of
  /// positions; and what that rounding and `accepted`, accelerations of its gap, come to. What acts elsewhere
  /// tells nothing about how exactly its force is known.
  [[nodiscard]] double no_pull(const System& in_force, const ContactState& contact, const FlatSample& now,
                               const ContactAccuracy& known, double accepted);

 private:
  void find(const System& in_force, const FlatSample& now, const Scales& scales);

  System::Evaluation e_;
  std::vector<double> forces_;  // of constraints on each coordinate,
  std::vector<double> noise_;   // and what springs do not know of them
  double rounding_ = 0.0;       // of the positions
  double time_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace dalembert
