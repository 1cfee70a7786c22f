#pragma once

#include <dalembert/models/small_motions.h>

#include <vector>

namespace dalembert::bench {

/// Appends how Whipple's bicycle, disturbed at a stable speed, leans and steers in time, by both steppers,
/// against the published linear equations.
void bicycle_in_time(std::vector<models::Compared>& all);

}  // namespace dalembert::bench
