#pragma once

#include <ctime>

namespace dalembert::bench {

/// Processor time of this thread [s], the clock of Statistics::run_time.
[[nodiscard]] inline double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace dalembert::bench
