#pragma once

#include <dalembert/models/model.h>

#include <array>
#include <span>
#include <vector>

namespace dalembert::models {

/// Four rods, two masses carried round, and a sleeve on the axis.
struct GovernorParts {
  std::array<Particle<3>, 2> masses;
  Particle<3> sleeve;
  std::array<Constraint<1>, 2> upper, lower;  ///< rods; their tension is -multiplier
  std::array<Constraint<1>, 2> drives;        ///< their multiplier is the sideways force on each mass, ahead
  std::array<Constraint<1>, 2> axis;          ///< hold the sleeve on the axis, from x = 0 and from y = 0
};

/// Watt's governor (notes, mex23): two masses m1 on rods of length L from the top of an axis that forces them
/// round at Omega, two more rods from them down to a sleeve m2 on the axis; released with the rods at rest.
///
/// With theta the angle of the rods from the axis the masses are at L (sin theta, -cos theta), outwards and
/// up, the sleeve at -2 L cos theta:
///
///   Lagrangian = m1 L^2 (theta'^2 + Omega^2 sin^2 theta) + 2 m2 L^2 theta'^2 sin^2 theta
///                + 2 (m1 + m2) g L cos theta,
///   (m1 + 2 m2 sin^2 theta) L theta'' = sin theta cos theta L (m1 Omega^2 - 2 m2 theta'^2)
///                                       - (m1 + m2) g sin theta.
///
/// The masses rise by z1'' = L (sin theta theta'' + cos theta theta'^2), the sleeve by 2 z1''. Newton's law
/// for the sleeve and for a mass along the vertical, and for a mass sideways:
///
///   lower rod:  2 T_l cos theta = m2 (g + 2 z1''),        upper rod:  (T_u - T_l) cos theta = m1 (g + z1''),
///   drive of a mass = 2 m1 L Omega theta' cos theta.
///
/// At rest cos theta0 = (m1 + m2) g/(m1 L Omega^2) if that is < 1, where T_l = m2 g/(2 cos theta0) and
/// T_u = (m1 + m2/2) g/cos theta0; about it omega^2 = m1 Omega^2 sin^2 theta0/(m1 + 2 m2 sin^2 theta0).
/// Conserved is the Jacobi integral, energy - Omega times the angular momentum about the axis.
struct Governor {
  double mass = 1.0;         ///< m1, of each of the two
  double sleeve_mass = 2.0;  ///< m2
  double length = 1.0;       ///< L, of each rod
  double gravity = 9.81;
  double spin = 7.0;   ///< Omega [rad/time]
  double angle = 0.7;  ///< theta at t = 0 [rad], between 0 and pi/2, and so it must remain

  [[nodiscard]] double equilibrium() const;  ///< theta0, 0 below the speed that lifts the masses [rad]
  struct Built {
    Scene<3> scene;
    GovernorParts parts;
  };
  [[nodiscard]] Built scene() const;
  /// Positions: masses and sleeve; forces: upper rods, lower rods, drives.
  [[nodiscard]] std::vector<Observation<3>> reference(std::span<const double> times) const;
  [[nodiscard]] Observation<3> reference(double t) const;
  [[nodiscard]] Model<3> model() const;
};

}  // namespace dalembert::models
