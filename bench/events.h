#pragma once

#include <dalembert/bench/report.h>
#include <dalembert/models/event_model.h>

#include <vector>

namespace dalembert::bench {

struct EventsTable {
  ReportOptions report;
};

/// All models whose events have times in closed form.
[[nodiscard]] std::vector<models::EventModel> models_of_events();

/// Do things happen when the closed forms say? By both steppers at several tolerances. Returns how many are
/// not within their limits.
[[nodiscard]] int events(const EventsTable& options);

}  // namespace dalembert::bench
