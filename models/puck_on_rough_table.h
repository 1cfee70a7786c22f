#pragma once

#include <dalembert/models/event_model.h>

namespace dalembert::models {

/// A puck slides over a rough table and is pulled along x by m f, less than friction can hold: a = mu g > f.
///
///   u' = -a u/|u| + f e_x:   d(a |u| + f u_x)/dt = -(a^2 - f^2),                                     (1)
///
/// so it rests after  (a |u0| + f u0_x)/(a^2 - f^2), whatever the bend of its path. With u = w (cos psi,
/// sin psi), psi from 0 to pi,
///
///   w' = f cos psi - a,   w psi' = -f sin psi,                                                       (2)
///   w = w0 (tan(psi/2)/tan(psi0/2))^(a/f) sin psi0/sin psi:
///
/// it comes to rest in the direction of the pull. Friction takes a m along its path.
struct PuckOnRoughTable {
  double mass = 2.0;
  double speed = 2.0;      ///< w0
  double direction = 2.0;  ///< psi0 [rad]
  double pull = 1.5;       ///< f [acceleration]
  double friction = 0.3;   ///< mu
  double gravity = 9.81;

  struct Built {
    Scene<3> scene;
    Particle<3> puck;
    Constraint<1> table;
    Constraint<2> rough;
  };
  [[nodiscard]] Built scene() const;
  [[nodiscard]] double rest_time() const;              ///< (1)
  [[nodiscard]] double speed_along(double psi) const;  ///< w, of f > 0
  [[nodiscard]] EventModel event_model() const;
};

}  // namespace dalembert::models
