#pragma once

#include <dalembert/models/event_model.h>

#include <limits>
#include <string>

namespace dalembert::models {

/// A run of a few seconds errs by some tens of its tolerance, and so do the times at which it gets anywhere.
[[nodiscard]] constexpr double time_limit(double tolerance) { return 100.0 * tolerance; }

/// When something happened to a constraint for the k-th time, k from 0; NaN if it did not.
template <int D, int Rows>
[[nodiscard]] double time_of(const Trajectory<D>& run, Constraint<Rows> constraint, Happened what,
                             int k = 0) {
  for (const Occurrence& its : run.events()) {
    if (its.event != static_cast<std::size_t>(constraint.index) || its.what != what) continue;
    if (k-- == 0) return its.time;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace dalembert::models
