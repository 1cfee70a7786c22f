#pragma once

#include "draft.h"

#include <cstdint>
#include <optional>
#include <string>

namespace dalembert::fuzz {

/// What became of a scene. `fault` is empty unless the library did what it must not: then it says what.
struct Verdict {
  std::string outcome;  ///< "ran", or the type of the error
  std::string message;  ///< of the error
  std::string fault;
  std::string log;     ///< how to write the scene down by hand
  std::string detail;  ///< size of what was measured, for whoever looks into limits
};

/// Makes the scene of a seed and runs it.
[[nodiscard]] Verdict judge(std::uint64_t seed, Stepper stepper);

/// What is wrong with a run's samples; empty if nothing. `complete` tells a run that came to its end
/// from what an IntegrationFailure kept.
template <int D>
[[nodiscard]] std::string fault_of_run(const Draft<D>& draft, const Trajectory<D>& run,
                                       std::optional<double> failed_at, std::string& detail);

}  // namespace dalembert::fuzz
