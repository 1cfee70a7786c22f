#pragma once

#include <dalembert/models/bead_on_curve.h>

#include <span>
#include <vector>

namespace dalembert::models {

/// Bead sliding without friction on the parabola y = A x^2 (notes, mex131), released from rest.
///
/// With s = sqrt(1 + 4 A^2 x^2) the speed is s x', and the Lagrangian m/2 s^2 x'^2 - m g A x^2 gives
///
///   s^2 x'' + 4 A^2 x x'^2 + 2 g A x = 0.
///
/// Of the acceleration (x'', 2 A x'^2 + 2 A x x'') the part along the upward normal (-2 A x, 1)/s is
/// 2 A x'^2/s, that of gravity -g/s, so that
///
///   normal force = m (g + 2 A x'^2)/s,
///
/// always positive: the parabola need not hold the bead from above. Energy conservation
/// s^2 x'^2 = 2 g A (a^2 - x^2) with x = a sin u and omega^2 = 2 g A gives the period
///
///   T = (4/omega) int_0^(pi/2) sqrt(1 + c^2 sin^2 u) du = (4/omega) sqrt(1 + c^2) E(c/sqrt(1 + c^2)),
///   c = 2 A a,     T = (2 pi/omega)(1 + A^2 a^2 + ...).
struct ParabolicSlide {
  double mass = 1.0;
  double curvature = 0.5;  ///< A [1/length]
  double gravity = 9.81;
  double amplitude = 1.0;  ///< a = x at t = 0 [length], > 0

  [[nodiscard]] BeadOnCurve scene() const;
  [[nodiscard]] std::vector<Observation<2>> reference(std::span<const double> times) const;
  [[nodiscard]] Observation<2> reference(double t) const;
  [[nodiscard]] double period() const;
  [[nodiscard]] Model<2> model() const;
};

}  // namespace dalembert::models
