#pragma once

#include <dalembert/bench/report.h>

#include <string>
#include <vector>

namespace dalembert::bench {

struct RequestsTable {
  std::vector<std::string> models = {"all"};
  std::vector<double> errors = {1e-3, 1e-6, 1e-9};  ///< of force, relative to the model's
  int repeats = 3;                                  ///< the median of whose times counts
  ReportOptions report;
};

/// Does `simulate_to` meet a requested error of force, and at what cost, compared with the cheapest single
/// run of either stepper that would have met it? Returns how many rows err by more than 1.25 times a
/// request that is said to be met; the heading says how many are not, and how many cost more than 4 times as
/// much.
[[nodiscard]] int requests(const RequestsTable& options);

}  // namespace dalembert::bench
