#pragma once

#include <dalembert/models/model.h>

#include <span>
#include <vector>

namespace dalembert::models {

/// A bead on a hoop, which is where a sphere meets a turning plane.
struct BeadOnHoop {
  Scene<3> scene;
  Particle<3> bead;
  Constraint<1> sphere;  ///< the hoop's force towards the centre is -multiplier
  Constraint<1> plane;   ///< the hoop's sideways force, positive the way it turns, is +multiplier
};

/// Bead on a hoop of radius R that turns at Omega about its vertical diameter (notes, mex39), released at
/// rest relative to the hoop.
///
/// With phi from the downward vertical the bead is at R (sin phi, -cos phi) outwards and up, in the plane
/// that turns. Its acceleration is  R (phi'' - Omega^2 sin phi cos phi)  along the hoop, -R (phi'^2 + Omega^2
/// sin^2 phi) away from the centre and 2 R Omega phi' cos phi sideways. Newton's law:
///
///   phi'' = sin phi (Omega^2 cos phi - g/R),
///   force towards the centre = m [R (phi'^2 + Omega^2 sin^2 phi) + g cos phi],
///   sideways force = 2 m R Omega phi' cos phi.
///
/// The bead rests at the bottom if Omega^2 <= g/R, else at cos phi0 = g/(R Omega^2), and swings about there
/// with omega^2 = g/R - Omega^2 or Omega^2 sin^2 phi0. Conserved is the Jacobi integral
/// m R^2 (phi'^2 - Omega^2 sin^2 phi)/2 - m g R cos phi, which is energy - Omega times the angular momentum
/// about the axis.
struct HoopAboutDiameter {
  double mass = 1.0;
  double radius = 1.0;  ///< R
  double gravity = 9.81;
  double spin = 4.5;   ///< Omega [rad/time]
  double angle = 1.4;  ///< phi at t = 0 [rad]

  [[nodiscard]] double equilibrium() const;  ///< the stable one, phi >= 0 [rad]
  [[nodiscard]] BeadOnHoop scene() const;
  [[nodiscard]] std::vector<Observation<3>> reference(std::span<const double> times) const;
  [[nodiscard]] Observation<3> reference(double t) const;
  [[nodiscard]] Model<3> model() const;
};

}  // namespace dalembert::models
