#pragma once

#include <dalembert/models/event_model.h>

namespace dalembert::models {

/// A ball falls from rest at a height h, drifting sideways, and bounces on a floor with restitution e.
///
/// It strikes first after T = sqrt(2 h/g) with u_0 = g T, the k-th time with u_k = e^k u_0, k from 0; between
/// impacts it flies for 2 e^k T. Hence, as a geometric series,
///
///   t_k = T + 2 T (e + ... + e^k) = T (1 + e - 2 e^(k+1))/(1 - e),   at rest from T (1 + e)/(1 - e);
///
/// of e = 1 the times are (2 k + 1) T without end. Each impulse is m (1 + e) u_k.
struct BouncingBall {
  double mass = 2.0;
  double height = 1.0;
  double gravity = 9.81;
  double restitution = 0.5;
  double drift = 0.3;  ///< velocity sideways [length/time]

  struct Built {
    Scene<2> scene;
    Particle<2> ball;
    Constraint<1> floor;
  };
  [[nodiscard]] Built scene() const;
  [[nodiscard]] double impact_time(int k) const;
  [[nodiscard]] double rest_time() const;  ///< infinite if e = 1
  /// Impacts down to a hundredth of the first speed, of e = 1 ten, and rest.
  [[nodiscard]] EventModel event_model() const;
};

}  // namespace dalembert::models
