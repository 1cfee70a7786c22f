#pragma once

#include <dalembert/bench/report.h>

#include <vector>

namespace dalembert::bench {

struct AuditTable {
  std::vector<double> tolerances = {1e-4, 1e-6, 1e-8, 1e-10};
  int repeats = 5;  ///< pairs of runs, with the audit and without, of which the median ratio of times counts
  bool quick = false;
  ReportOptions report;
};

/// Do the results of every model and of every extreme scene obey the laws of mechanics, and what does looking
/// cost? Returns how many rows are beyond their limit.
[[nodiscard]] int audit(const AuditTable& options);

}  // namespace dalembert::bench
