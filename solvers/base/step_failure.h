#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <string>

namespace DALEMBERT_HIDDEN dalembert {

/// Thrown when a step cannot be taken; the integrator adds the trajectory so far.
struct StepFailure {
  std::string what;
  double time;
};

}  // namespace dalembert
