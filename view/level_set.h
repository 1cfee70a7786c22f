#pragma once

#include <dalembert/core/equations/sketch.h>
#include <dalembert/solvers/base/hidden.h>

#include <Eigen/Geometry>

#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Where a function is 0 in a box: line segments in the plane, triangles in space, the numbers of their
/// corners one after the other. Linear in the simplices (Freudenthal's) of a grid of `cells` along the
/// longest side. Where the function throws or has no value there is nothing.
[[nodiscard]] std::vector<double> level_set(const std::function<double(const Sketch::Place&)>& function,
                                            const Eigen::AlignedBox3d& box, int dimension, int cells);

}  // namespace dalembert
