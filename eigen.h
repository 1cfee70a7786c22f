#pragma once

#include <dalembert/core/vec.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

/// For code that works with Eigen. Vectors of the library and Eigen's convert to each other by themselves,
/// also without this header:
///
///   Eigen::Vector3d f = run.constraint_force(rod, p, i);
///   scene.add_particle({.mass = 1.0, .position = Eigen::Vector3d::UnitX()});
///
/// Where a function of Eigen takes any expression, as AngleAxisd(angle, axis) and n.dot(r) do, it sees no
/// conversion: there `eigen(v)` is the vector as one of Eigen's. In an equation, whose numbers carry
/// derivatives, write r.dot(n) in place of n.dot(r), and r.cross(n), with n one of Eigen's.
namespace dalembert {

template <class S, int N>
[[nodiscard]] Eigen::Matrix<S, N, 1> eigen(const VecOf<S, N>& v) {
  return v;
}

}  // namespace dalembert
