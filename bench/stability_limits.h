#pragma once

#include <dalembert/models/small_motions.h>

#include <vector>

namespace dalembert::bench {

/// Appends where equilibria lose their stability, by `follow_branches`, against closed forms.
void stability_limits(std::vector<models::Compared>& all);

}  // namespace dalembert::bench
