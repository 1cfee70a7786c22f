#pragma once

#include <dalembert/constraints/bodies/lamina.h>
#include <dalembert/constraints/bodies/rigid_body.h>
#include <dalembert/constraints/bodies/thin_rod.h>

#include <type_traits>

namespace Eigen {
template <class Scalar, int Options>
class Quaternion;
}

/// How a body moves at an instant of a run: `angular_velocity(run.sample(i), body)`. What particles have the
/// mass, centre and inertia of a body have also its energy and momentum, so that these are sums over them.
namespace dalembert {

namespace detail {
/// As in the scene that was run: it may have been stated anew since the body was added.
template <int D>
[[nodiscard]] double mass(const Sample<D>& sample, Particle<D> particle) {
  sample.layout().require(particle);
  return sample.layout().particles[static_cast<std::size_t>(particle.index)].mass;
}
}  // namespace detail

/// Of the body's first axis against that of the plane, between -pi and pi [rad].
[[nodiscard]] double angle(const Sample<2>& sample, const RigidBody<2>& body);
/// Of the rod's direction from start to end.
[[nodiscard]] double angle(const Sample<2>& sample, const ThinRod<2>& rod);

/// The rotation from the axes of space to those of the body, as a unit quaternion with w >= 0. As a matrix
/// it is `body.axes(sample)`. Who calls it includes <Eigen/Geometry>: most programs do without.
[[nodiscard]] Eigen::Quaternion<double, 0> quaternion(const Sample<3>& sample, const RigidBody<3>& body);
/// Likewise.
[[nodiscard]] Eigen::Quaternion<double, 0> quaternion(const Sample<3>& sample, const Lamina& body);

/// [rad / time], in space along the axes of space; along those of the body it is `body.axes(sample)^T` times
/// that. A ThinRod in space has no turn about itself: what is given is across it.
[[nodiscard]] double angular_velocity(const Sample<2>& sample, const RigidBody<2>& body);
/// Likewise.
[[nodiscard]] double angular_velocity(const Sample<2>& sample, const ThinRod<2>& rod);
/// Likewise.
[[nodiscard]] Vec<3> angular_velocity(const Sample<3>& sample, const RigidBody<3>& body);
/// Likewise.
[[nodiscard]] Vec<3> angular_velocity(const Sample<3>& sample, const Lamina& body);
/// Likewise, across the rod.
[[nodiscard]] Vec<3> angular_velocity(const Sample<3>& sample, const ThinRod<3>& rod);

/// [rad / time^2], along the same axes. Throws like Sample::acceleration.
[[nodiscard]] double angular_acceleration(const Sample<2>& sample, const RigidBody<2>& body);
/// Likewise.
[[nodiscard]] double angular_acceleration(const Sample<2>& sample, const ThinRod<2>& rod);
/// Likewise.
[[nodiscard]] Vec<3> angular_acceleration(const Sample<3>& sample, const RigidBody<3>& body);
/// Likewise.
[[nodiscard]] Vec<3> angular_acceleration(const Sample<3>& sample, const Lamina& body);
/// Likewise, across the rod.
[[nodiscard]] Vec<3> angular_acceleration(const Sample<3>& sample, const ThinRod<3>& rod);

/// Of its motion and its turning together.
template <int D, MadeOfParticles<D> Body>
[[nodiscard]] double kinetic_energy(const Sample<D>& sample, const Body& body) {
  double T = 0.0;
  for (std::size_t i = 0; i < body.particles.size(); ++i)
    T += 0.5 * detail::mass(sample, body.particles[i]) * sample.velocity(body.particles[i]).squaredNorm();
  return T;
}

/// Mass times velocity of the centre.
template <int D, MadeOfParticles<D> Body>
[[nodiscard]] Vec<D> momentum(const Sample<D>& sample, const Body& body) {
  Vec<D> p = Vec<D>::Zero();
  for (std::size_t i = 0; i < body.particles.size(); ++i)
    p += detail::mass(sample, body.particles[i]) * sample.velocity(body.particles[i]);
  return p;
}

/// About a point of space.
template <int D, MadeOfParticles<D> Body>
[[nodiscard]] MomentOf<D> angular_momentum(const Sample<D>& sample, const Body& body,
                                           const std::type_identity_t<Vec<D>>& about) {
  const Vec<D> zero = Vec<D>::Zero();
  MomentOf<D> L = detail::moment(zero, zero);
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const auto& p = body.particles[i];
    L += detail::mass(sample, p) * detail::moment(Vec<D>(sample.position(p) - about), sample.velocity(p));
  }
  return L;
}
/// About the centre of mass.
template <int D, MadeOfParticles<D> Body>
[[nodiscard]] MomentOf<D> angular_momentum(const Sample<D>& sample, const Body& body) {
  return angular_momentum(sample, body, sample.position(body.centre()));
}

}  // namespace dalembert
