#pragma once

#include <dalembert/core/mat.h>

namespace dalembert::detail {

/// Whether columns are right-handed axes of unit length, to the digits that a user writes down. False if one
/// of their numbers is NaN.
[[nodiscard]] bool orthonormal(const Mat<2, 2>& axes);
[[nodiscard]] bool orthonormal(const Mat<3, 3>& axes);

}  // namespace dalembert::detail
