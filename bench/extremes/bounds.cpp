#include "dalembert/bench/extremes/bounds.h"

#include <string_view>

namespace dalembert::extremes {

Result unless_too_stiff(const std::function<Result()>& run, Stepper stepper) try {
  return run();
} catch (const IntegrationFailure& failure) {
  const std::string_view said = failure.what();
  if (stepper == Stepper::ida || said.find("max_steps") == std::string_view::npos) throw;
  return {.error = 0.0,
          .statistics = failure.trajectory<2>().statistics(),
          .outcome = "IntegrationFailure",
          .said = failure.what()};
}

}  // namespace dalembert::extremes
