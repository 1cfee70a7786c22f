#pragma once

#include <dalembert/models/event_model.h>

namespace dalembert::models {

/// A block on a belt that moves at V, held by a spring to its place above the start: it rides along, breaks
/// loose, slides back, and is caught again (stick-slip; J. P. den Hartog, Mechanical Vibrations, 7.4).
///
/// It sticks until the spring's force is that of static friction, x = mu_static m g/k. Then, slower than the
/// belt, with omega^2 = k/m and y = x - mu m g/k,
///
///   y'' = -omega^2 y,   y = d cos omega t + (V/omega) sin omega t,   d = (mu_static - mu) m g/k
///
/// until y' = V again, which is at y = -d and omega t = pi + 2 phi, tan phi = V/(omega d). It rides from -d
/// to d. So it slides for the first time at mu_static m g/(k V), and then with the period
///
///   (pi + 2 phi)/omega + 2 d/V.
struct BlockOnBelt {
  double mass = 1.0;
  double stiffness = 40.0;  ///< k [force / length]
  double belt = 0.3;        ///< V > 0 [speed]
  double mu = 0.25, mu_static = 0.4;
  double gravity = 9.81;
  int periods = 5;

  [[nodiscard]] double slips() const;  ///< for how long it slides
  [[nodiscard]] double period() const;
  [[nodiscard]] EventModel event_model() const;
};

}  // namespace dalembert::models
