#include "dalembert/tests/extremes/cases/bounds.h"

#include <string>

namespace dalembert::extremes {

Result unless_refused(const std::function<Result()>& run, bool may_be_refused, std::string_view why) try {
  return run();
} catch (const IntegrationFailure& failure) {
  if (!may_be_refused || std::string(failure.what()).find(why) == std::string::npos) throw;
  return {.error = 0.0,
          .statistics = failure.trajectory<2>().statistics(),
          .outcome = "IntegrationFailure",
          .said = failure.what()};
}

}  // namespace dalembert::extremes
