#include "dalembert/constraints/bodies/orthonormal.h"

#include <Eigen/LU>

namespace dalembert::detail {

namespace {
template <class Axes>
bool are_axes(const Axes& axes) {
  constexpr double rounding_of_the_user = 1e-8;
  return (axes.transpose() * axes - Axes::Identity()).norm() < rounding_of_the_user &&
         axes.determinant() > 0.0;
}
}  // namespace

bool orthonormal(const Eigen::Matrix2d& axes) { return are_axes(axes); }
bool orthonormal(const Eigen::Matrix3d& axes) { return are_axes(axes); }

}  // namespace dalembert::detail
