#pragma once

#include <dalembert/models/hanging_rods.h>

namespace dalembert::models {

/// Pendulum that turns over the top (notes, mex147), from the bottom at t = 0.
///
/// With E > 2 m g l counted from the bottom, kappa^2 = 2 m g l / E < 1 and omega0^2 = g/l,
///
///   phi'^2 = (2 omega0/kappa)^2 (1 - kappa^2 sin^2(phi/2))
///
/// is solved by phi/2 = am(omega0 t/kappa): sin(phi/2) = sn, cos(phi/2) = cn and
/// phi' = (2 omega0/kappa) dn, all of modulus kappa. The tension is m (l phi'^2 + g cos phi) as
/// for the libration; at the top it is 2 E/l - 5 m g, so a rod must push if E < 2.5 m g l.
struct PendulumRotation {
  double mass = 1.0;
  double length = 1.0;
  double gravity = 9.81;
  double energy_ratio = 1.5;  ///< E / (2 m g l), > 1

  [[nodiscard]] HangingRods scene() const;
  [[nodiscard]] Observation<2> reference(double t) const;
  [[nodiscard]] double period() const;  ///< of one turn, 2 kappa K(kappa) / omega0
  [[nodiscard]] Model<2> model() const;
};

}  // namespace dalembert::models
