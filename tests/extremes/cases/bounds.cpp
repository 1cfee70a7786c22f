#include "dalembert/tests/extremes/cases/bounds.h"

#include <string>

namespace dalembert::extremes {

Run unless_refused(const std::function<Run()>& run, bool may_be_refused, std::string_view why) try {
  return run();
} catch (const IntegrationFailure& failure) {
  if (!may_be_refused || std::string(failure.what()).find(why) == std::string::npos) throw;
  return ended_by(failure, 0.0);
}

}  // namespace dalembert::extremes
