#include "dalembert/constraints/joints/frames.h"

#include <Eigen/Geometry>

namespace dalembert::detail {

Eigen::Matrix3d joint_axes(const Vec<3>& direction) {
  const Vec<3> z = direction.normalized(), x = z.unitOrthogonal();
  Eigen::Matrix3d axes;
  axes << x, z.cross(x), z;
  return axes;
}

Eigen::Matrix2d joint_axes(const Vec<2>& direction) {
  const Vec<2> x = direction.normalized();
  Eigen::Matrix2d axes;
  axes << x, Vec<2>(-x.y(), x.x());
  return axes;
}

Eigen::Matrix3d axes_across(const Vec<3>& axis, const Vec<3>& across) {
  const Vec<3> z = axis.normalized(), x = (across - z.dot(across) * z).normalized();
  Eigen::Matrix3d axes;
  axes << x, z.cross(x), z;
  return axes;
}

Eigen::Matrix3d axes_of_two(const Vec<3>& along_x, const Vec<3>& along_y) {
  const Vec<3> x = along_x.normalized(), y = along_y.normalized();
  Eigen::Matrix3d axes;
  axes << x, y, x.cross(y);
  return axes;
}

}  // namespace dalembert::detail
