#pragma once

#include <dalembert/solvers/base/accuracy.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/contact_state.h>
#include <dalembert/solvers/manifold/scales.h>

namespace DALEMBERT_HIDDEN dalembert {

/// What counts as 0 of a contact, and how exactly it is known.
struct ContactAccuracy {
  Scales scales;
  Accuracy accuracy;
  double duration;  ///< of the run

  /// Gaps: the rounding of the positions, see Scales.
  [[nodiscard]] double no_gap(const ContactState& contact, double rounding) const;
  /// Rates: round-off of the scene's own speed, however slow it is just then. What slides back may be found
  /// to rest a round-off beyond, see DryFriction::switching.
  [[nodiscard]] double no_rate(const ContactState& contact) const;
  /// Rates of velocities at the start and after impacts at one time.
  [[nodiscard]] double still(const ContactState& contact) const;
  /// Accelerations of what rests without a force: they change a gap by its round-off in the run.
  [[nodiscard]] double no_acceleration(const ContactState& contact, double rounding) const;
  /// Of its gap, where the scene's speeds change in the scene's time.
  [[nodiscard]] double own_acceleration(const ContactState& contact) const;
  /// The error of a step in a gap.
  [[nodiscard]] double error_of_gap(const ContactState& contact) const;
  /// By how much a gap that changes at this rate may differ from 0 where it was found to close: by that, by
  /// the rounding of the positions that it was found from and is read from, or by that of the time.
  [[nodiscard]] double error_where_closed(const ContactState& contact, double rounding, double t,
                                          double rate) const;
};

}  // namespace dalembert
