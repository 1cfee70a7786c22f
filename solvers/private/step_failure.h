#pragma once

#include <string>

namespace [[gnu::visibility("hidden")]] dalembert {

/// Thrown when a step cannot be taken; the integrator adds the trajectory so far.
struct StepFailure {
  std::string what;
  double time;
};

}  // namespace gnu::visibility("hidden")]]dalembert
