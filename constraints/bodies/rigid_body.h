#pragma once

#include <dalembert/constraints/bodies/body_rod.h>
#include <dalembert/core/points/body_point.h>
#include <dalembert/core/results/sample.h>
#include <dalembert/core/scene/scene.h>

#include <array>
#include <string>

namespace dalembert {

/// A rigid body as its user states it.
template <int D>
struct BodyState;

template <>
struct BodyState<2> {
  double mass = 0.0;     ///< finite and > 0
  double inertia = 0.0;  ///< about the centre of mass [mass length^2], finite and > 0
  Vec<2> centre = Vec<2>::Zero();
  double angle = 0.0;  ///< of the body's first axis, counter-clockwise [rad]
  Vec<2> velocity = Vec<2>::Zero();
  double angular_velocity = 0.0;  ///< [rad / time]
};

template <>
struct BodyState<3> {
  double mass = 0.0;                ///< finite and > 0
  Vec<3> inertia = Vec<3>::Zero();  ///< principal moments about the centre of mass [mass length^2]
  Vec<3> centre = Vec<3>::Zero();
  Mat<3, 3> axes = Mat<3, 3>::Identity();  ///< columns: the principal axes, right-handed
  Vec<3> velocity = Vec<3>::Zero();
  Vec<3> angular_velocity = Vec<3>::Zero();  ///< components along the axes of space [rad / time]
};

/// A rigid body: an equimomental set of particles held by Distances (notes, mln36), with exactly the
/// body's mass, centre of mass and inertia. Any point fixed in the body is a constant linear map of
/// its particles, to be used in constraints and forces like any other point. No rotation parameters,
/// no singular attitudes, and the mass matrix stays diagonal.
///
/// In the plane, two particles of half the mass at centre -+ rho e, rho^2 = inertia/mass, e the
/// body's first axis. In space, the four of Equimomental, which are as far from each other in a slender
/// body or a plate as in any other; m a^2 = (I_2 + I_3 - I_1)/2 and so on.
///
/// How it moves, its energy and momentum are read by the functions of motion.h.
template <int D>
struct RigidBody {
  static constexpr int dimension = D;
  static constexpr int particle_count = BodyPoint<D>::count;  ///< 2 in the plane, 4 in space
  static constexpr int rod_count = D == 2 ? 1 : 6;            ///< between its particles
  using Axes = Mat<D, D>;                                     ///< a rotation matrix
  /// A number in the plane, three principal moments in space.
  using Inertia = decltype(BodyState<D>::inertia);

  /// With its mass, centre and inertia.
  std::array<Particle<D>, static_cast<std::size_t>(particle_count)> particles;
  std::array<Constraint<1>, static_cast<std::size_t>(rod_count)> rods;  ///< that hold them together
  Vec<D> arms = Vec<D>::Zero();  ///< (rho, rho) or (a, b, c): roots of the second moments over the mass
  std::array<double, static_cast<std::size_t>(particle_count)> masses{};  ///< of the particles
  Vec<D> stated_centre = Vec<D>::Zero();                                  ///< where it was added, and how:
  Axes stated_axes = Axes::Identity();                                    ///< columns

  /// As it was added: of a particle of it that was replaced (Scene::replace) the body does not know.
  [[nodiscard]] double mass() const;
  /// About the centre of mass; in space the principal moments, as BodyState has them.
  [[nodiscard]] Inertia inertia() const;

  /// The point at coordinates `local` from the centre of mass along the body's axes. Throws InvalidArgument
  /// if they are not finite, as do the next ones.
  [[nodiscard]] BodyPoint<D> point(const Vec<D>& local) const;
  /// Its centre of mass.
  [[nodiscard]] BodyPoint<D> centre() const { return point(Vec<D>::Zero()); }
  /// A vector that turns with the body, components `local` along its axes: its `position` is the vector
  /// itself, its `velocity` the vector's rate. In an equation it stands like a point of the body.
  [[nodiscard]] BodyPoint<D> vector(const Vec<D>& local) const;

  /// The same, given by where they were in space when the body was added.
  [[nodiscard]] BodyPoint<D> point_at(const Vec<D>& place) const {
    return point(stated_axes.transpose() * (place - stated_centre));
  }
  /// Components along the axes of space.
  [[nodiscard]] BodyPoint<D> vector_along(const Vec<D>& direction) const {
    return vector(stated_axes.transpose() * direction);
  }

  /// Columns: the body's axes. In the plane the first is (cos angle, sin angle).
  [[nodiscard]] Axes axes(const Sample<D>& sample) const;
};

/// Adds a rigid body to a scene; its particles and rods are named after it. Throws InvalidScene if
/// mass or inertia is not that of a body with extent in every direction (a thin rod in space is two
/// particles and a Distance; a lamina three).
template <int D>
RigidBody<D> add_body(Scene<D>& scene, const BodyState<D>& state, const std::string& name);

extern template struct RigidBody<2>;
extern template struct RigidBody<3>;

}  // namespace dalembert
