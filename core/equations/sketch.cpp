#include "dalembert/core/equations/sketch.h"

#include <Eigen/Geometry>

#include <cmath>
#include <utility>

namespace dalembert::detail {

void append_numbers(std::vector<double>& sizes, std::span<const double> numbers) {
  for (const double x : numbers) sizes.push_back(x);
}

bool is_direction(std::span<const double> map, std::size_t rows) {
  const std::size_t columns = map.size() / rows;
  double sum = 0.0;  // of the weights of the first coordinates: 1 of a place, 0 of a vector
  for (std::size_t k = 0; k < columns; k += rows) sum += map[k];
  return std::abs(sum) < 0.5;
}

Pose turned_about(const Vec<3>& point, const Vec<3>& axis, double angle) {
  const Mat<3, 3> turn = Eigen::AngleAxisd(angle, Eigen::Vector3d(axis)).toRotationMatrix();
  return {turn, point - turn * point};
}

Sketch carried(Sketch sketch, std::function<Pose(double t)> pose) {
  if (sketch.pose) {
    sketch.pose = [first = std::move(sketch.pose), then = std::move(pose)](double t) {
      const Pose a = first(t), b = then(t);
      return Pose{b.rotation * a.rotation, b.rotation * a.shift + b.shift};
    };
  } else {
    sketch.pose = std::move(pose);
  }
  return sketch;
}

}  // namespace dalembert::detail
