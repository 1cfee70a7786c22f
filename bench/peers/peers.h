#pragma once

#include <dalembert/bench/method.h>
#include <dalembert/models/hanging_rods.h>

#include <vector>

namespace dalembert::bench {

/// The peers that were found when this was built.
[[nodiscard]] std::vector<Method> peers();

/// Rods hung one below the other, in plane gravity along -y, as each peer integrates them.
[[nodiscard]] Methods<2> peers(double gravity, const std::vector<models::RodAndBead>& rods);

}  // namespace dalembert::bench
