#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <string>

namespace DALEMBERT_HIDDEN dalembert {

/// Thrown when a step cannot be taken; the integrator adds the trajectory so far.
struct StepFailure {
  std::string what;
  double time;
};

[[nodiscard]] inline StepFailure linearly_dependent(double time) {
  return {"the constraints became linearly dependent", time};
}

}  // namespace dalembert
