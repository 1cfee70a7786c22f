#pragma once

#include <dalembert/models/hanging_rods.h>

#include <numbers>

namespace dalembert::models {

/// Plane pendulum swinging between two turning points (notes, mex132, mex146; IFToMM A01).
///
/// With phi the angle from the downward vertical and omega0^2 = g/l, energy conservation
///
///   phi'^2 = 4 omega0^2 (k^2 - sin^2(phi/2)),   k = sin(amplitude/2)
///
/// is solved from rest at phi = amplitude by  sin(phi/2) = k sn(K(k) - omega0 t),
/// hence cos(phi/2) = dn and phi' = -2 k omega0 cn. The radial component of Newton's law gives
///
///   tension = m (l phi'^2 + g cos phi).
struct PlanePendulum {
  double mass = 1.0;
  double length = 1.0;
  double gravity = 9.81;
  double amplitude = std::numbers::pi / 2;  ///< [rad], between 0 and pi; pi/2 is horizontal

  [[nodiscard]] HangingRods scene() const;
  [[nodiscard]] Observation<2> reference(double t) const;
  [[nodiscard]] double period() const;  ///< 4 K(k) / omega0
  [[nodiscard]] Model<2> model() const;
};

}  // namespace dalembert::models
