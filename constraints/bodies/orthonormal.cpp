#include "dalembert/constraints/bodies/orthonormal.h"

namespace dalembert::detail {

namespace {
template <int D>
bool are_axes(const Mat<D, D>& axes) {
  constexpr double rounding_of_the_user = 1e-8;
  return (axes.transpose() * axes - Mat<D, D>::Identity()).norm() < rounding_of_the_user;
}
}  // namespace

bool orthonormal(const Mat<2, 2>& axes) { return are_axes(axes) && moment(axes.col(0), axes.col(1)) > 0.0; }
bool orthonormal(const Mat<3, 3>& axes) {
  return are_axes(axes) && axes.col(0).cross(axes.col(1)).dot(axes.col(2)) > 0.0;
}

}  // namespace dalembert::detail
