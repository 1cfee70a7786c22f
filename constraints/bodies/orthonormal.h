#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

namespace dalembert::detail {

/// Whether columns are right-handed axes of unit length, to the digits that a user writes down. False if one
/// of their numbers is NaN.
template <int D>
[[nodiscard]] bool orthonormal(const Eigen::Matrix<double, D, D>& axes) {
  constexpr double rounding_of_the_user = 1e-8;
  using Axes = Eigen::Matrix<double, D, D>;
  return (axes.transpose() * axes - Axes::Identity()).norm() < rounding_of_the_user &&
         axes.determinant() > 0.0;
}

}  // namespace dalembert::detail
