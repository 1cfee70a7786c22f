#pragma once

#include <dalembert/core/errors.h>

#include <functional>
#include <string>

namespace dalembert::bench {

/// What became of a run, for the column `outcome`: "ok", or the type of the error that refused or stopped
/// it. A refused run is a row of its table like any other, no failure of the benchmark.
struct Outcome {
  std::string name = "ok";
  std::string said = {};  ///< what the error said

  [[nodiscard]] bool ok() const { return said.empty(); }
};

/// The outcome that an error is.
[[nodiscard]] Outcome refused_by(const Error& error);

/// What `run` came to. `what` was run is shown on the terminal with the reason of a refusal.
[[nodiscard]] Outcome outcome_of(const std::string& what, const std::function<void()>& run);

/// Tells a reader at the terminal why `what` was refused.
void tell(const std::string& what, const Outcome& outcome);

}  // namespace dalembert::bench
