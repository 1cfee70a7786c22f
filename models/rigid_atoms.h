#pragma once

#include <dalembert/models/model.h>

#include <span>
#include <vector>

namespace dalembert::models {

/// Particles held together by a Distance between every two: a rigid body as the notes define it
/// (mln36), with N(N-1)/2 constraints of which no more than 3N - 6 (in the plane 2N - 3) are
/// independent.
template <int D>
struct BoundAtoms {
  Scene<D> scene;
  std::vector<Particle<D>> atoms;
  std::vector<Constraint<1>> bonds;  ///< in the order (1,2), (1,3), ..., (2,3), ...
};

template <int D>
[[nodiscard]] BoundAtoms<D> bind(const std::string& name, std::span<const ParticleState<D>> atoms);

/// Rigid body of N atoms in torque-free motion (notes, mln36).
///
/// The atoms, of equal masses, are placed on a zigzag ring: x = a cos u, y = b sin u, z = +-c in turn, u = 2
/// pi k/N (three of them are a triangle). With R the body's attitude and I its inertia tensor about
/// the centre of mass in body axes, Euler's equations
///
///   I w' = (I w) x w,   R' = R [w]x
///
/// give each atom at s in the body the place R s and, by Newton's law, the force
///
///   Z = m R (w' x s + w x (w x s))
///
/// of all its bonds together: it is unique, while the forces in the single bonds of more than four
/// atoms are not. For even N the axes of the ring are principal; with a = b it is a symmetric top,
/// whose axis turns about the angular momentum L at the rate L/I_1.
struct RigidAtoms {
  int atoms = 8;                              ///< N >= 3
  double mass = 1.0;                          ///< of all atoms together
  Vec<3> semi_axes = {1.0, 0.7, 0.4};         ///< (a, b, c) [length]
  Vec<3> angular_velocity = {1.0, 2.0, 0.5};  ///< at t = 0 [rad / time]

  [[nodiscard]] BoundAtoms<3> scene() const;
  [[nodiscard]] std::vector<Observation<3>> reference(std::span<const double> times) const;
  [[nodiscard]] Observation<3> reference(double t) const;
  [[nodiscard]] std::vector<Vec<3>> places() const;  ///< of the atoms in the body, from the centre of mass
  [[nodiscard]] Mat<3, 3> inertia() const;           ///< about the centre of mass
  [[nodiscard]] Model<3> model() const;
};

}  // namespace dalembert::models
