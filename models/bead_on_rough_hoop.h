#pragma once

#include <dalembert/models/event_model.h>

#include <vector>

namespace dalembert::models {

/// A bead on a rough circular wire in a vertical plane, let go at an angle theta from the lowest point, below
/// the height of the centre. The wire carries R theta'^2 + g cos theta of it, so with G = g/R, y = theta'^2,
/// and s the sign of theta',
///
///   theta'' = -G sin theta - mu s (y + G cos theta),   dy/dtheta = 2 theta''
///   y = A cos theta + B sin theta + C exp(-m theta),   m = 2 mu s
///   A = G (2 - m^2)/(1 + m^2),   B = -3 m G/(1 + m^2)
///
/// with C such that y = 0 where the swing began. It ends at the next zero of y; there the bead stays if
/// |tan theta| <= mu_static, else it turns back. A swing takes the integral of dtheta/sqrt(y).
struct BeadOnRoughHoop {
  double radius = 1.0;
  double angle = 1.2;  ///< at which it is let go [rad], 0 to pi/2, beyond what friction holds
  double mu = 0.15, mu_static = 0.2;
  double gravity = 9.81;

  /// Where and when swings end, the last one where the bead stays.
  struct Swing {
    double angle, time;
  };
  [[nodiscard]] std::vector<Swing> swings() const;
  [[nodiscard]] EventModel event_model() const;
};

}  // namespace dalembert::models
