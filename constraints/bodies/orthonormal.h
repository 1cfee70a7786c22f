#pragma once

#include <Eigen/Core>

namespace dalembert::detail {

/// Whether columns are right-handed axes of unit length, to the digits that a user writes down. False if one
/// of their numbers is NaN.
[[nodiscard]] bool orthonormal(const Eigen::Matrix2d& axes);
[[nodiscard]] bool orthonormal(const Eigen::Matrix3d& axes);

}  // namespace dalembert::detail
