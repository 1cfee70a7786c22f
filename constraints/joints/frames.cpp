#include "dalembert/constraints/joints/frames.h"

namespace dalembert::detail {

Mat<3, 3> joint_axes(const Vec<3>& direction) {
  const Vec<3> z = direction.normalized(), x = z.unitOrthogonal();
  return Mat<3, 3>(x, z.cross(x), z);
}

Mat<2, 2> joint_axes(const Vec<2>& direction) {
  const Vec<2> x = direction.normalized();
  return Mat<2, 2>(x, Vec<2>(-x.y(), x.x()));
}

Mat<3, 3> axes_across(const Vec<3>& axis, const Vec<3>& across) {
  const Vec<3> z = axis.normalized(), x = (across - z.dot(across) * z).normalized();
  return Mat<3, 3>(x, z.cross(x), z);
}

Mat<3, 3> axes_of_two(const Vec<3>& along_x, const Vec<3>& along_y) {
  const Vec<3> x = along_x.normalized(), y = along_y.normalized();
  return Mat<3, 3>(x, y, x.cross(y));
}

}  // namespace dalembert::detail
