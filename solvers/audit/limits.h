#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/accuracy.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// What a run claims about its results: that a position errs by `accuracy` times `length`, a velocity by that
/// over `time` and relative to itself (angles: 1 in place of the length), a force by `accuracy` of the terms
/// that it is in balance with.
struct Claim {
  double length = 1.0, time = 1.0;
  double accuracy = 0.0;
};

/// The limits of an audit, all in this place. Each is what the claim allows to the quantities that a law is
/// stated in, carried to its residual by its own derivatives,
///
///   |g| <= sum_j |W_j| (accuracy unit_j + r |q_j|),     |psi| <= sum_j |W_j| (accuracy (unit_j/T + |v_j|) +
///   r |v_j|),   (1) |M a - F - W^T lambda| <= (accuracy + r) (|M a| + |F| + sum |W lambda| + M unit/T^2) (2)
///
/// and r, the round-off of the terms, is `roundings` epsilon: a sum of n terms errs by n epsilon of their
/// magnitudes, and a matrix of n rows is factored with that times n at most.
struct Limits {
  Limits(const System& system, const Claim& claim);

  void set(const Claim& claim);
  [[nodiscard]] double unit(std::size_t i) const { return angle[i] ? 1.0 : length; }
  [[nodiscard]] double position(std::size_t i, double q) const {
    return accuracy * unit(i) + round_off * std::abs(q);
  }
  [[nodiscard]] double velocity(std::size_t i, double v) const {
    return accuracy * (unit(i) / time + std::abs(v)) + round_off * std::abs(v);
  }
  /// A speed at which two slip velocities count as rest, where friction takes hold of them at once: twice
  /// that of the run, whose length may have grown since it looked.
  [[nodiscard]] double rest_in_space(std::size_t i) const {
    return 2.0 * Accuracy(accuracy).rest_in_space() * unit(i) / time;
  }
  /// A speed at which what touches counts as at rest, as users round what they state: of all contacts of one
  /// coordinate.
  [[nodiscard]] double rest_at_contacts(std::size_t i) const {
    return start_tolerance * static_cast<double>(contacts) * unit(i) / time;
  }
  /// How far a gap that changes at this rate may be off by the rounding of a time.
  [[nodiscard]] double by_time(double t, double rate) const { return round_off * std::abs(t * rate); }
  /// Of what is the sum of terms of these magnitudes.
  [[nodiscard]] double relative(double terms) const { return (accuracy + round_off) * terms; }

  /// Gradients closer than this count as dependent: forces shared among them may differ by as much.
  static constexpr double dependent = 1e-9;

  double length, time, accuracy, round_off;
  std::vector<char> angle;
  std::size_t contacts = 0;  ///< the most that act on one coordinate
};

}  // namespace dalembert
