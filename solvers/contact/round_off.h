#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <limits>

namespace DALEMBERT_HIDDEN dalembert {

/// What is below this part of the largest beside it is what some thousand roundings leave of 0.
inline constexpr double round_off = 1e4 * std::numeric_limits<double>::epsilon();

}  // namespace dalembert
