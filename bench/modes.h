#pragma once

#include <dalembert/bench/report.h>

namespace dalembert::bench {

struct ModesTable {
  int beads = 10'000;  ///< of the long chain
  ReportOptions report;
};

/// Are equilibria, forces of constraint there and small motions those of the closed forms? Returns how many
/// are not within their limits.
[[nodiscard]] int modes(const ModesTable& options);

}  // namespace dalembert::bench
