#pragma once

#include <dalembert/solvers/base/constants.h>

#include <limits>

namespace DALEMBERT_HIDDEN dalembert {

/// The fraction of the largest number beside it below which a number is round-off.
[[nodiscard]] inline double round_off() {
  return constants.roundings_at_contacts * std::numeric_limits<double>::epsilon();
}

}  // namespace dalembert
