#pragma once

#include <dalembert/models/event_model.h>

#include <string>

namespace dalembert::models {

/// A run of a few seconds errs by some tens of its tolerance, and so do the times at which it gets anywhere.
[[nodiscard]] constexpr double time_limit(double tolerance) { return 100.0 * tolerance; }

/// When something happened to a constraint for the k-th time, k from 0.
template <int D, int Rows>
[[nodiscard]] HappenedAt time_of(const Trajectory<D>& run, Constraint<Rows> constraint, EventKind what,
                                 int k = 0) {
  for (std::size_t number = 0; number < run.events().size(); ++number) {
    const EventRecord& its = run.events()[number];
    if (its.source != static_cast<std::size_t>(constraint.index) || its.kind != what) continue;
    if (k-- == 0) return {its.time, number};
  }
  return {};
}

}  // namespace dalembert::models
