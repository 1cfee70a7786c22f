#pragma once

#include <dalembert/models/rolling_disk.h>

#include <string>

namespace dalembert::models {

/// The upright rolling disk on a plane tilted by beta (notes, mln37); x points down the slope.
///
/// No force turns the heading: alpha = Omega t. Along the heading gravity has the component
/// m g sin beta cos alpha, and with the friction f from I phi'' = -radius f, I = m radius^2/2,
///
///   phi'' = A cos(Omega t),   A = m g radius sin beta/(I + m radius^2),
///   phi'  = phi'_0 + (A/Omega) sin(Omega t).
///
/// r' = radius phi' e integrates to
///
///   x = (radius/Omega) [phi'_0 sin(Omega t) + (A/(2 Omega)) sin^2(Omega t)]
///   y = (radius/Omega) [phi'_0 (1 - cos(Omega t)) + (A/2) (t - sin(2 Omega t)/(2 Omega))]:
///
/// on the average the disk does not go down the slope but along it. Friction, and Newton's law
/// across the heading, where gravity has the component -m g sin beta sin alpha:
///
///   f = -(I/radius) A cos(Omega t),   force across = m radius phi' Omega + m g sin beta sin(Omega t).
struct RollingDiskOnSlope {
  double mass = 1.0;
  double radius = 0.5;
  double gravity = 9.81;
  double slope = 0.3;      ///< beta [rad]
  double spin_rate = 4.0;  ///< phi' at t = 0 [rad / time]
  double turn_rate = 1.5;  ///< Omega = alpha' [rad / time], not 0

  [[nodiscard]] UprightDisk scene() const;
  [[nodiscard]] Observation<2> reference(double t) const;
  [[nodiscard]] Model<2> model() const;
};

}  // namespace dalembert::models
