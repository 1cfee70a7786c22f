#pragma once

#include <dalembert/models/model.h>

#include <vector>

namespace dalembert::models {

/// All models with their default parameters, in the order of the benchmark's tables.
[[nodiscard]] std::vector<AnyModel> catalogue();

}  // namespace dalembert::models
