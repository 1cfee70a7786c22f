#pragma once

#include <dalembert/bench/method.h>
#include <dalembert/bench/report.h>

#include <string>
#include <vector>

namespace dalembert::bench {

/// Up to this many beads the end of a run is compared with the chain's hand derivation.
inline constexpr int largest_compared = 1000;

struct Scaling {
  std::string model = "chain";
  std::vector<int> sizes = {10, 100, 1000};  ///< run in increasing order
  std::vector<Method> steppers = {Method::ida};
  double tolerance = 1e-6;
  double t_end = 1.0;
  ReportOptions report;
};

/// How do run time and memory grow with the size of a scene? error_position is that of the last
/// positions, nan above `largest_compared`; peak_memory_mib the resident memory of the whole process
/// at its peak so far, taken before the comparison. A run that was refused has its outcome in the table.
void scaling(const Scaling& options);

}  // namespace dalembert::bench
