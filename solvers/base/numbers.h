#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace DALEMBERT_HIDDEN dalembert {

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// max |x_i|; 0 of none.
[[nodiscard]] inline double largest(std::span<const double> x) {
  double most = 0.0;
  for (const double value : x) most = std::max(most, std::abs(value));
  return most;
}

}  // namespace dalembert
