#include "dalembert/constraints/bodies/motion.h"

#include <Eigen/Geometry>

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

/// From its start to its end.
template <int D>
BodyPoint<D, 2> direction(const ThinRod<D>& rod) {
  BodyPoint<D, 2> d = rod.end();
  d.L -= rod.start().L;
  return d;
}

/// As far as particles, for small round-off.
double far(const RigidBody<3>& body) { return body.arms.norm(); }
double far(const Lamina& body) { return body.arms.norm(); }

/// What a derivative of the vectors of a body gives by (1) or (2): `derivative(vector)`.
double turning_of(const Sample<2>& sample, const RigidBody<2>& body, const auto& derivative) {
  const auto e = body.vector({body.arms.x(), 0.0});
  return turning_of_line<2>(sample.position(e), derivative(e));
}
Vec<3> turning_of(const Sample<3>& sample, const RigidBody<3>& body, const auto& derivative) {
  const double l = far(body);
  Vec<3> sum = Vec<3>::Zero();
  for (int k = 0; k < 3; ++k) {
    const auto e = body.vector(l * Vec<3>::Unit(k));
    sum += turning(sample.position(e) / l, derivative(e) / l);
  }
  return sum;
}
template <int D>
MomentOf<D> turning_of(const Sample<D>& sample, const ThinRod<D>& rod, const auto& derivative) {
  const auto d = direction(rod);
  return turning_of_line<D>(sample.position(d), derivative(d));
}

template <int D, class Body>
MomentOf<D> velocity_of(const Sample<D>& sample, const Body& body) {
  return turning_of(sample, body, [&sample](const auto& e) { return sample.velocity(e); });
}
template <int D, class Body>
MomentOf<D> acceleration_of(const Sample<D>& sample, const Body& body) {
  return turning_of(sample, body, [&sample](const auto& e) { return sample.acceleration(e); });
}

}  // namespace

double angle(const Sample<2>& sample, const RigidBody<2>& body) {
  const Mat<2, 2> axes = body.axes(sample);
  return std::atan2(axes(1, 0), axes(0, 0));
}

double angle(const Sample<2>& sample, const ThinRod<2>& rod) {
  const Vec<2> d = sample.position(direction(rod));
  return std::atan2(d.y(), d.x());
}

Eigen::Quaterniond quaternion(const Sample<3>& sample, const RigidBody<3>& body) {
  return of_axes(body.axes(sample));
}

Eigen::Quaterniond quaternion(const Sample<3>& sample, const Lamina& body) {
  return of_axes(body.axes(sample));
}

double angular_velocity(const Sample<2>& sample, const RigidBody<2>& body) {
  return velocity_of(sample, body);
}
double angular_velocity(const Sample<2>& sample, const ThinRod<2>& rod) { return velocity_of(sample, rod); }
Vec<3> angular_velocity(const Sample<3>& sample, const RigidBody<3>& body) {
  return velocity_of(sample, body);
}
Vec<3> angular_velocity(const Sample<3>& sample, const ThinRod<3>& rod) { return velocity_of(sample, rod); }

Vec<3> angular_velocity(const Sample<3>& sample, const Lamina& body) {
  const double l = far(body);
  const auto x = body.vector({l, 0.0}), y = body.vector({0.0, l});
  const Vec<3> e_x = sample.position(x) / l, e_y = sample.position(y) / l;
  const Vec<3> rate_x = sample.velocity(x) / l, rate_y = sample.velocity(y) / l;
  return turning(e_x, rate_x) + turning(e_y, rate_y) +
         turning(e_x.cross(e_y), rate_x.cross(e_y) + e_x.cross(rate_y));
}

double angular_acceleration(const Sample<2>& sample, const RigidBody<2>& body) {
  return acceleration_of(sample, body);
}
double angular_acceleration(const Sample<2>& sample, const ThinRod<2>& rod) {
  return acceleration_of(sample, rod);
}
Vec<3> angular_acceleration(const Sample<3>& sample, const RigidBody<3>& body) {
  return acceleration_of(sample, body);
}
Vec<3> angular_acceleration(const Sample<3>& sample, const ThinRod<3>& rod) {
  return acceleration_of(sample, rod);
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

}  // namespace dalembert
