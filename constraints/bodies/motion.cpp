#include "dalembert/constraints/bodies/motion.h"

#include <cmath>

namespace dalembert {

namespace {

/// What one axis e of three gives: omega = sum e_k x e_k'/2.
Vec<3> turning(const Vec<3>& e, const Vec<3>& e_rate) { return 0.5 * e.cross(e_rate); }

/// Of a vector of any length that turns in its plane, or across itself in space.
template <int D>
Turn<D> turning_of_line(const Vec<D>& d, const Vec<D>& d_rate) {
  return detail::moment(d, d_rate) / d.squaredNorm();
}

Eigen::Quaterniond of_axes(const Eigen::Matrix3d& axes) {
  Eigen::Quaterniond q(axes);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  return q.normalized();
}

template <int D>
Vec<D> direction(const Sample<D>& sample, const ThinRod<D>& rod) {
  return sample.position(rod.particles[1]) - sample.position(rod.particles[0]);
}
template <int D>
Vec<D> direction_rate(const Sample<D>& sample, const ThinRod<D>& rod) {
  return sample.velocity(rod.particles[1]) - sample.velocity(rod.particles[0]);
}

}  // namespace

double angle(const Sample<2>& sample, const RigidBody<2>& body) {
  const Eigen::Matrix2d axes = body.axes(sample);
  return std::atan2(axes(1, 0), axes(0, 0));
}

double angle(const Sample<2>& sample, const ThinRod<2>& rod) {
  const Vec<2> d = direction(sample, rod);
  return std::atan2(d.y(), d.x());
}

Eigen::Quaterniond quaternion(const Sample<3>& sample, const RigidBody<3>& body) {
  return of_axes(body.axes(sample));
}

Eigen::Quaterniond quaternion(const Sample<3>& sample, const Lamina& body) {
  return of_axes(body.axes(sample));
}

double angular_velocity(const Sample<2>& sample, const RigidBody<2>& body) {
  const auto e = body.vector({body.arms.x(), 0.0});
  return turning_of_line<2>(sample.position(e), sample.velocity(e));
}

double angular_velocity(const Sample<2>& sample, const ThinRod<2>& rod) {
  return turning_of_line<2>(direction(sample, rod), direction_rate(sample, rod));
}

Vec<3> angular_velocity(const Sample<3>& sample, const RigidBody<3>& body) {
  const double far = body.arms.norm();  // as far as particles, for small round-off
  Vec<3> omega = Vec<3>::Zero();
  for (int k = 0; k < 3; ++k) {
    const auto e = body.vector(far * Vec<3>::Unit(k));
    omega += turning(sample.position(e) / far, sample.velocity(e) / far);
  }
  return omega;
}

Vec<3> angular_velocity(const Sample<3>& sample, const Lamina& body) {
  const double far = body.arms.norm();
  const auto x = body.vector({far, 0.0}), y = body.vector({0.0, far});
  const Vec<3> e_x = sample.position(x) / far, e_y = sample.position(y) / far;
  const Vec<3> rate_x = sample.velocity(x) / far, rate_y = sample.velocity(y) / far;
  return turning(e_x, rate_x) + turning(e_y, rate_y) +
         turning(e_x.cross(e_y), rate_x.cross(e_y) + e_x.cross(rate_y));
}

Vec<3> angular_velocity(const Sample<3>& sample, const ThinRod<3>& rod) {
  return turning_of_line<3>(direction(sample, rod), direction_rate(sample, rod));
}

}  // namespace dalembert
