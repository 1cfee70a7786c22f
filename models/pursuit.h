#pragma once

#include <dalembert/models/model.h>

namespace dalembert::models {

/// A scene of a pursuer after its prey.
struct Chase {
  Scene<2> scene;
  Particle<2> pursuer;
  Constraint<1> aim;  ///< its multiplier is the sideways force, positive to the left of the velocity
};

/// A pursuer whose velocity always points at a prey that runs along the x axis, x = u t (notes, mex235).
///
/// From (0, h) the path x(y) has the slope p = dx/dy = -(u t - x)/y. With dt/dy = -sqrt(1 + p^2)/v,
/// the speed v being constant as the force is at right angles to the velocity,
/// d(y p)/dy = p - u dt/dy leaves
///
///   y dp/dy = k sqrt(1 + p^2),   k = u/v:     p = sinh(k ln Y),   Y = y/h.
///
/// Integrated, x from p and t from sqrt(1 + p^2) = cosh(k ln Y),
///
///   x = (h/2) [Y^(1+k)/(1+k) - Y^(1-k)/(1-k)] + k h/(1 - k^2)
///   t = (h/2v) [(1 - Y^(1+k))/(1+k) + (1 - Y^(1-k))/(1-k)]:
///
/// capture, Y = 0, at t = h v/(v^2 - u^2). The line of sight, of length rho = y cosh(k ln Y), turns
/// at the rate u sin(theta)/rho, sin(theta) = y/rho, and with it the velocity:
///
///   sideways force = m v u sin(theta)/rho = m v u y/rho^2,
///
/// which grows without bound towards capture if v > 2 u.
struct PursuitCurve {
  double mass = 1.0;
  double height = 1.0;         ///< h, where the pursuer starts [length]
  double prey_speed = 1.0;     ///< u > 0
  double pursuer_speed = 3.0;  ///< v > u
  double part_compared = 0.9;  ///< the run compared ends at this part of the time of capture

  [[nodiscard]] Chase scene() const;
  [[nodiscard]] double capture_time() const;
  [[nodiscard]] Observation<2> reference(double t) const;  ///< before capture
  [[nodiscard]] Model<2> model() const;
};

}  // namespace dalembert::models
