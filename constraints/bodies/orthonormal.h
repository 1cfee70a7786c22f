#pragma once

#include <dalembert/core/vec.h>

#include <Eigen/Core>
#include <Eigen/LU>

namespace dalembert::detail {

/// A matrix by its columns.
template <class... Column>
[[nodiscard]] auto by_columns(const Column&... column) {
  constexpr int D = static_cast<int>(sizeof...(Column));
  Eigen::Matrix<double, D, D> all;
  int k = 0;
  const auto put = [&all, &k](const Vec<D>& x) { all.col(k++) = Eigen::Matrix<double, D, 1>(x); };
  (put(column), ...);
  return all;
}

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
