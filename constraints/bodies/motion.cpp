#include "dalembert/constraints/bodies/motion.h"

#include <cmath>

namespace dalembert {

namespace {

// For vectors e_k fixed in a body that turns with omega, e' = omega x e and e'' = omega' x e + omega x e', so
// that what gives omega from the first derivatives gives omega' from the second:
//
//   omega = sum e_k x e_k'/2,   omega' = sum e_k x e_k''/2     over three axes,                         (1)
//   omega = d x d'/|d|^2,       omega' = d x d''/|d|^2         of a line d across which it turns.       (2)

Vec<3> turning(const Vec<3>& e, const Vec<3>& derivative) { return 0.5 * e.cross(derivative); }

template <int D>
MomentOf<D> turning_of_line(const Vec<D>& d, const Vec<D>& derivative) {
  return detail::moment(d, derivative) / d.squaredNorm();
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

template <int D>
Vec<D> direction_acceleration(const Sample<D>& sample, const ThinRod<D>& rod) {
  return sample.acceleration(rod.particles[1]) - sample.acceleration(rod.particles[0]);
}

/// As far as particles, for small round-off.
double far(const RigidBody<3>& body) { return body.arms.norm(); }
double far(const Lamina& body) { return body.arms.norm(); }

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
  const double l = far(body);
  Vec<3> omega = Vec<3>::Zero();
  for (int k = 0; k < 3; ++k) {
    const auto e = body.vector(l * Vec<3>::Unit(k));
    omega += turning(sample.position(e) / l, sample.velocity(e) / l);
  }
  return omega;
}

Vec<3> angular_velocity(const Sample<3>& sample, const Lamina& body) {
  const double l = far(body);
  const auto x = body.vector({l, 0.0}), y = body.vector({0.0, l});
  const Vec<3> e_x = sample.position(x) / l, e_y = sample.position(y) / l;
  const Vec<3> rate_x = sample.velocity(x) / l, rate_y = sample.velocity(y) / l;
  return turning(e_x, rate_x) + turning(e_y, rate_y) +
         turning(e_x.cross(e_y), rate_x.cross(e_y) + e_x.cross(rate_y));
}

Vec<3> angular_velocity(const Sample<3>& sample, const ThinRod<3>& rod) {
  return turning_of_line<3>(direction(sample, rod), direction_rate(sample, rod));
}

double angular_acceleration(const Sample<2>& sample, const RigidBody<2>& body) {
  const auto e = body.vector({body.arms.x(), 0.0});
  return turning_of_line<2>(sample.position(e), sample.acceleration(e));
}

double angular_acceleration(const Sample<2>& sample, const ThinRod<2>& rod) {
  return turning_of_line<2>(direction(sample, rod), direction_acceleration(sample, rod));
}

Vec<3> angular_acceleration(const Sample<3>& sample, const RigidBody<3>& body) {
  const double l = far(body);
  Vec<3> alpha = Vec<3>::Zero();
  for (int k = 0; k < 3; ++k) {
    const auto e = body.vector(l * Vec<3>::Unit(k));
    alpha += turning(sample.position(e) / l, sample.acceleration(e) / l);
  }
  return alpha;
}

Vec<3> angular_acceleration(const Sample<3>& sample, const Lamina& body) {
  const double l = far(body);
  const auto x = body.vector({l, 0.0}), y = body.vector({0.0, l});
  const Vec<3> e_x = sample.position(x) / l, e_y = sample.position(y) / l;
  const Vec<3> rate_x = sample.velocity(x) / l, rate_y = sample.velocity(y) / l;
  const Vec<3> second_x = sample.acceleration(x) / l, second_y = sample.acceleration(y) / l;
  return turning(e_x, second_x) + turning(e_y, second_y) +
         turning(e_x.cross(e_y), second_x.cross(e_y) + 2.0 * rate_x.cross(rate_y) + e_x.cross(second_y));
}

Vec<3> angular_acceleration(const Sample<3>& sample, const ThinRod<3>& rod) {
  return turning_of_line<3>(direction(sample, rod), direction_acceleration(sample, rod));
}

}  // namespace dalembert
