#pragma once

#include <dalembert/constraints/bodies/body_rod.h>
#include <dalembert/core/points/body_point.h>
#include <dalembert/core/results/sample.h>
#include <dalembert/core/scene/scene.h>

#include <array>
#include <string>

namespace dalembert {

/// A plane body of no thickness in space, as its user states it.
struct LaminaState {
  double mass = 0.0;  ///< finite and > 0
  Vec<2> inertia =
      Vec<2>::Zero();  ///< about its two axes in the plane [mass length^2]; their sum is the third
  Vec<3> centre = Vec<3>::Zero();            ///< of mass
  Mat<3, 3> axes = Mat<3, 3>::Identity();    ///< columns: two in the plane, then the normal
  Vec<3> velocity = Vec<3>::Zero();          ///< of the centre of mass
  Vec<3> angular_velocity = Vec<3>::Zero();  ///< components along the axes of space [rad / time]
};

/// A plane rigid body of no thickness in space: three particles held by Distances, with exactly its mass,
/// centre of mass and inertia. (A RigidBody needs extent in every direction for its four.) They are those of
/// Equimomental in its plane, with m a^2 = I_2, m b^2 = I_1.
///
/// A thin disk has I_1 = I_2 = m radius^2/4.
struct Lamina {
  static constexpr int dimension = 3;
  std::array<Particle<3>, 3> particles;  ///< with its mass, centre and inertia
  std::array<Constraint<1>, 3> rods;     ///< between particles 1 and 2, 2 and 3, 3 and 1
  Vec<2> arms = Vec<2>::Zero();          ///< (a, b): roots of the second moments over the mass

  /// The point of the plane at coordinates `local` from the centre of mass along the body's axes.
  [[nodiscard]] BodyPoint<3, 3> point(const Vec<2>& local) const;
  /// Its centre of mass.
  [[nodiscard]] BodyPoint<3, 3> centre() const { return point(Vec<2>::Zero()); }
  /// A vector in its plane that turns with it; see RigidBody::vector.
  [[nodiscard]] BodyPoint<3, 3> vector(const Vec<2>& local) const;

  /// Columns: its two axes in the plane, then the normal.
  [[nodiscard]] Mat<3, 3> axes(const Sample<3>& sample) const;
};

/// Adds a lamina to a scene; its particles and rods are named after it. Throws InvalidScene if mass
/// or inertia is not positive, or the axes are not right-handed and of unit length.
Lamina add_lamina(Scene<3>& scene, const LaminaState& state, const std::string& name);

}  // namespace dalembert
