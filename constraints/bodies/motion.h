#pragma once

#include <dalembert/constraints/bodies/lamina.h>
#include <dalembert/constraints/bodies/rigid_body.h>
#include <dalembert/constraints/bodies/thin_rod.h>

#include <Eigen/Geometry>

#include <type_traits>

/// How a body moves at an instant of a run: `angular_velocity(run.sample(i), body)`. What particles have the
/// mass, centre and inertia of a body have also its energy and momentum, so that these are sums over them.
namespace dalembert {

/// A turn or torque: a number in the plane, counter-clockwise; a vector in space.
template <int D>
using Turn = std::conditional_t<D == 2, double, Vec<3>>;

namespace detail {
/// r x F.
[[nodiscard]] inline double moment(const Vec<2>& r, const Vec<2>& F) { return r.x() * F.y() - r.y() * F.x(); }
[[nodiscard]] inline Vec<3> moment(const Vec<3>& r, const Vec<3>& F) { return r.cross(F); }
}  // namespace detail

/// A RigidBody, Lamina or ThinRod.
template <class B, int D>
concept BodyIn = requires(const B& body) {
  { body.particles[0] } -> std::convertible_to<Particle<D>>;
  { body.masses[0] } -> std::convertible_to<double>;
};

/// Of the body's first axis against that of the plane, between -pi and pi [rad].
[[nodiscard]] double angle(const Sample<2>& sample, const RigidBody<2>& body);
/// Of the rod's direction from start to end.
[[nodiscard]] double angle(const Sample<2>& sample, const ThinRod<2>& rod);

/// The rotation from the axes of space to those of the body, as a unit quaternion with w >= 0. (As a matrix
/// it is `body.axes(sample)`.)
[[nodiscard]] Eigen::Quaterniond quaternion(const Sample<3>& sample, const RigidBody<3>& body);
[[nodiscard]] Eigen::Quaterniond quaternion(const Sample<3>& sample, const Lamina& body);

/// [rad / time], in space along the axes of space; along those of the body it is `body.axes(sample)^T` times
/// that. A ThinRod in space has no turn about itself: what is given is across it.
[[nodiscard]] double angular_velocity(const Sample<2>& sample, const RigidBody<2>& body);
[[nodiscard]] double angular_velocity(const Sample<2>& sample, const ThinRod<2>& rod);
[[nodiscard]] Vec<3> angular_velocity(const Sample<3>& sample, const RigidBody<3>& body);
[[nodiscard]] Vec<3> angular_velocity(const Sample<3>& sample, const Lamina& body);
[[nodiscard]] Vec<3> angular_velocity(const Sample<3>& sample, const ThinRod<3>& rod);

/// Of its motion and its turning together.
template <int D, BodyIn<D> Body>
[[nodiscard]] double kinetic_energy(const Sample<D>& sample, const Body& body) {
  double T = 0.0;
  for (std::size_t i = 0; i < body.particles.size(); ++i)
    T += 0.5 * body.masses[i] * sample.velocity(body.particles[i]).squaredNorm();
  return T;
}

/// Mass times velocity of the centre.
template <int D, BodyIn<D> Body>
[[nodiscard]] Vec<D> momentum(const Sample<D>& sample, const Body& body) {
  Vec<D> p = Vec<D>::Zero();
  for (std::size_t i = 0; i < body.particles.size(); ++i)
    p += body.masses[i] * sample.velocity(body.particles[i]);
  return p;
}

/// About a point of space.
template <int D, BodyIn<D> Body>
[[nodiscard]] Turn<D> angular_momentum(const Sample<D>& sample, const Body& body,
                                       const std::type_identity_t<Vec<D>>& about) {
  const Vec<D> zero = Vec<D>::Zero();
  Turn<D> L = detail::moment(zero, zero);
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const auto& p = body.particles[i];
    L += body.masses[i] * detail::moment(Vec<D>(sample.position(p) - about), sample.velocity(p));
  }
  return L;
}
/// About the centre of mass.
template <int D, BodyIn<D> Body>
[[nodiscard]] Turn<D> angular_momentum(const Sample<D>& sample, const Body& body) {
  return angular_momentum(sample, body, sample.position(body.centre()));
}

}  // namespace dalembert
