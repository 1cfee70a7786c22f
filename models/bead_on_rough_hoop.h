#pragma once

#include <dalembert/models/event_model.h>

#include <vector>

namespace dalembert::models {

/// A bead on a rough circular wire in a vertical plane swings to and fro until it sticks.
///
/// With theta in the direction it goes, from the lowest point, y = theta'^2 and G = g/R the wire exerts
/// lambda = m R (y + G cos theta) towards the centre: from rest above the centre's height it is negative at
/// first, as the wire holds both ways. With its sign s
///
///   dy/dtheta = -2 G sin theta - M (y + G cos theta),   M = 2 mu s,                                  (1)
///   y = A cos theta + B sin theta + C e^(-M theta),   A = G (2 - M^2)/(1 + M^2),  B = -3 M G/(1 + M^2).
///
/// From a known y at a the other follows, without a difference of large numbers where y is small,
///
///   y - y(a) = 2 sin(e/2) (B cos(a + e/2) - A sin(a + e/2)) + (y(a) - A cos a - B sin a) (e^(-M e) - 1),
///   e = theta - a.                                                                                   (2)
///
/// A swing from rest at -theta_k has up to three such parts, joined where y + G cos theta = 0, and ends in
/// the root theta_k+1 of y. It takes int dtheta/sqrt(y). There it would be held by m g sin theta: it sticks
/// if |tan theta_k+1| <= mu_static, below the centre, else it slides back.
struct BeadOnRoughHoop {
  double mass = 1.5;
  double radius = 0.8;
  double angle = 2.2;      ///< theta_0, of the start at rest, too steep to stick [rad]
  double friction = 0.1;   ///< mu
  double sticking = 0.25;  ///< mu_static
  double gravity = 9.81;

  struct Built {
    Scene<2> scene;
    Particle<2> bead;
    Constraint<1> wire, rough;
  };
  /// What theory says of a turning point.
  struct Turn {
    double angle;  ///< on which side, as the start's is positive [rad]
    double time;
    bool sticks;
  };
  [[nodiscard]] Built scene() const;
  /// All of them, the last of which sticks.
  [[nodiscard]] std::vector<Turn> turns() const;
  [[nodiscard]] EventModel event_model() const;

 private:
  struct Part {  // of a swing
    double sign, from, square, to, square_to;
  };
  [[nodiscard]] double gained(double sign, double from, double square, double e) const;  // (2)
  [[nodiscard]] Part part(double sign, double from, double square) const;
  [[nodiscard]] double time(const Part& part) const;
};

}  // namespace dalembert::models
