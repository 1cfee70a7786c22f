#pragma once

#include <dalembert/bench/report.h>

namespace dalembert::bench {

struct EventsTable {
  ReportOptions report;
};

/// Do things happen when the closed forms say? By both steppers at several tolerances. Returns how many are
/// not within their limits.
[[nodiscard]] int events(const EventsTable& options);

}  // namespace dalembert::bench
