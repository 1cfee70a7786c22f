#pragma once

#include <dalembert/models/small_motions.h>

#include <vector>

namespace dalembert::bench {

/// Appends where equilibria and steady motions lose their stability, by `follow_branches` and
/// `follow_steady`, against closed forms and published values.
void stability_limits(std::vector<models::Compared>& all);

}  // namespace dalembert::bench
