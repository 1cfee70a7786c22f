#pragma once

#include <dalembert/models/hanging_rods.h>

namespace dalembert::models {

/// Pendulum with just the energy E = 2 m g l to reach the top, which it never does (notes, mex147).
///
/// From the bottom, phi' = 2 omega0 cos(phi/2) with omega0^2 = g/l has the solution
///
///   sin(phi/2) = tanh(omega0 t),   phi' = 2 omega0 sech(omega0 t),
///   tension = m (l phi'^2 + g cos phi) = m g (6 sech^2(omega0 t) - 1):
///
/// beyond cosh(omega0 t) = sqrt 6 the rod pushes. The motion is unstable: any deviation d, be it the
/// round-off of the initial speed, has grown to about d exp(omega0 t) by the time t. At the t_end = 2 of the
/// model (one metre, on Earth) that is a factor of 500, which still allows a comparison; after 10 it is 4e13
/// and double precision retains nothing of the exact motion.
struct PendulumSeparatrix {
  double mass = 1.0;
  double length = 1.0;
  double gravity = 9.81;

  [[nodiscard]] HangingRods scene() const;
  [[nodiscard]] Observation<2> reference(double t) const;
  [[nodiscard]] Model<2> model() const;
};

}  // namespace dalembert::models
