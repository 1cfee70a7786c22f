#pragma once

#include <dalembert/models/model.h>

namespace dalembert::models {

/// A scene of one upright disk on a plane, seen from above.
struct UprightDisk {
  Scene<2> scene;
  Particle<2> centre;
  Rotor heading, spin;
  Constraint<2> rolling;  ///< its multipliers: friction along the heading, and across to its left
};

/// Thin uniform disk on a plane, upright, rolling without slip (notes, mln37).
///
/// With heading alpha, spin phi and the unit vectors e = (cos alpha, sin alpha) along and n = (-sin
/// alpha, cos alpha) across, the centre obeys r' = radius phi' e and so
///
///   r'' = radius (phi'' e + phi' alpha' n).
///
/// Nothing acts on the free disk but the forces of rolling: along e the friction f with
/// m radius phi'' = f and I phi'' = -radius f, hence f = 0; across it turns nothing. So phi' and
/// alpha' are constant, the path is a circle of radius radius phi'/alpha', and
///
///   force across = m radius phi' alpha',
///
/// the centripetal force. It starts at the origin along +x.
struct RollingDisk {
  double mass = 1.0;
  double radius = 0.5;
  double spin_rate = 4.0;  ///< phi' [rad / time]
  double turn_rate = 1.5;  ///< alpha' [rad / time], not 0

  [[nodiscard]] UprightDisk scene() const;
  [[nodiscard]] Observation<2> reference(double t) const;
  [[nodiscard]] double path_radius() const { return radius * spin_rate / turn_rate; }
  [[nodiscard]] Model<2> model() const;
};

/// An upright thin uniform disk in motion at the origin along +x, with no force on it yet.
[[nodiscard]] UprightDisk upright_disk(const std::string& name, const RollingDisk& disk);

/// Observes the centre, and the friction along the heading and across to its left.
[[nodiscard]] Observed<2> observed(UprightDisk disk);

}  // namespace dalembert::models
