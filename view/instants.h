#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/certificate/two_runs.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// An instant that a page shows: a sample of the run, or what happened, before it and after.
struct Shown {
  const Record* record;
  std::size_t number;                    ///< of it in the record
  const Certainty* certainty = nullptr;  ///< if the run is certified,
  const Record* reference = nullptr;     ///< by the instant `certainty->counterpart` of this
  std::optional<std::size_t> event{};    ///< the number of what happens there

  [[nodiscard]] double time() const { return record->times[number]; }
  [[nodiscard]] FlatSample sample() const { return record->sample(number); }
  [[nodiscard]] bool of_run(const Record& run) const { return record == &run; }
};

/// The instants of a run in the order of time: every `every`-th sample, the last, and all that happened.
[[nodiscard]] std::vector<Shown> instants(const Record& run, const TwoRuns* certified, std::size_t every);

}  // namespace dalembert
