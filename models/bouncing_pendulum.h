#pragma once

#include <dalembert/models/event_model.h>

namespace dalembert::models {

/// A pendulum, a bob on a rigid massless rod, swings against an upright wall with restitution e.
///
/// The wall is where the rod makes the angle beta with the downward vertical, and the bob on the side of
/// greater angles. With omega0^2 = g/l it leaves the wall at the rate w, swings out to the amplitude
/// sin(a/2) = k, and is back after
///
///   k^2 = sin^2(beta/2) + (w/(2 omega0))^2,
///   T(w) = (2/omega0) (K(k) - F(psi, k)),   sin psi = sin(beta/2)/k,                                 (1)
///        = (2/omega0) F(psi', k),           tan psi' = (w/(2 omega0))/(sin(beta/2) sqrt(1 - k^2)),   (2)
///
/// where (2), by the addition theorem of F, loses no digits in small bounces; beta < 0 puts psi' beyond
/// pi/2. Released at rest it strikes first after T(w_0)/2, w_0 being the rate there, k from 0 with
/// w_k = e^k w_0:
///
///   t_k = T(w_0)/2 + T(e w_0) + ... + T(e^k w_0).
///
/// With beta > 0 and e < 1 that converges, as T(w) -> 2 w/(omega0^2 sin beta) for w -> 0: at rest the wall
/// carries m g tan beta. Along the wall's normal the bob goes at l w cos beta; the wall's impulse P across
/// the rod is P cos beta = m l (1 + e) w, the rod's P sin beta.
struct BouncingPendulum {
  double mass = 1.5;
  double length = 1.0;
  double gravity = 9.81;
  double amplitude = 1.0;    ///< of the release, at rest [rad]
  double wall = 0.2;         ///< beta, between -amplitude and amplitude [rad]
  double restitution = 0.6;  ///< e

  struct Built {
    Scene<2> scene;
    Particle<2> bob;
    Constraint<1> rod, wall;
  };
  [[nodiscard]] Built scene() const;
  [[nodiscard]] double impact_rate(int k) const;  ///< w_k
  [[nodiscard]] double impact_time(int k) const;
  [[nodiscard]] double rest_time() const;  ///< of beta > 0, e < 1
  /// Impacts down to a hundredth of the first speed, of e = 1 ten, and rest if there is any.
  [[nodiscard]] EventModel event_model() const;

 private:
  [[nodiscard]] double swing(double rate) const;  // T
};

}  // namespace dalembert::models
