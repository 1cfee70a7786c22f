#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <cstddef>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Numbers between -1 and 1 without a pattern, which a scene might share.
[[nodiscard]] std::vector<double> irregular(std::size_t count);

}  // namespace dalembert
