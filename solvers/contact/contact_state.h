#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/accumulation.h>
#include <dalembert/solvers/manifold/scales.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A one-sided constraint of a run: what it is, and what has happened to it.
struct ContactState {
  std::size_t number;  ///< in the layout
  std::size_t row;
  double sign, restitution;
  std::size_t island;
  bool closed = false;
  bool moved = false;  ///< closed, but a change of the scene has set its surface moving
  std::optional<double>
      arrives{};         ///< U- of (1) of Contacts, where impulses of joints have changed it since,
  double unknown = 0.0;  ///< and how exactly these are known, as a rate of the gap
  double closed_at = 0.0;
  bool bears = false;     ///< by the forces of (2) of Contacts that were found when it was last closed
  double accepted = 0.0;  ///< the acceleration away from it, by which it was closed all the same
  std::optional<double> opened_at{};  ///< if it was closed before
  double rate_at_opening = 0.0;
  double gap_at_opening = 0.0;  ///< at most 0: round-off of times and positions
  bool parted = true;           ///< since then the gap has exceeded the error of a step
  Accumulation impacts{};
  double gradient = 1.0;  ///< its length at the start, in the unit of the gap by now

  void open(double t, double rate, double gap) {
    closed = parted = false;
    opened_at = t;
    rate_at_opening = rate;
    gap_at_opening = std::min(gap, 0.0);
  }
  void close(double t) {
    if (!closed) closed_at = t;
    closed = true;
  }
};

/// The gaps of the contacts at the instant looked at last, and how fast they grow.
class Gaps {
 public:
  explicit Gaps(const System& stated) : g_(stated.rows()), rates_(stated.rows()) {}

  void find(const System& stated, const Scales& scales, const Instant& at) {
    stated.gaps(at, g_, rates_);
    rounding_ = scales.rounding(at.q);
    time_ = at.t;
  }
  [[nodiscard]] bool found_at(double t) const { return time_ == t; }
  void forget() { time_ = std::numeric_limits<double>::quiet_NaN(); }

  [[nodiscard]] double gap(const ContactState& contact) const { return contact.sign * g_[contact.row]; }
  [[nodiscard]] double rate(const ContactState& contact) const { return contact.sign * rates_[contact.row]; }
  /// Of the positions, see Scales.
  [[nodiscard]] double rounding() const { return rounding_; }

 private:
  std::vector<double> g_, rates_;  // of all rows
  double rounding_ = 0.0;
  double time_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace dalembert
