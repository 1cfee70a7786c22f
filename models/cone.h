#pragma once

#include <dalembert/models/model.h>

#include <numbers>
#include <span>
#include <vector>

namespace dalembert::models {

/// A scene of one particle on one surface.
struct ParticleOnCone {
  Scene<3> scene;
  Particle<3> particle;
  Constraint<1> wall;  ///< its multiplier is the normal force, positive away from the wall
};

/// Particle sliding without friction inside a cone that opens upwards (notes, mex133, mex135, mln77).
///
/// With r the distance from the axis, phi the angle about it and the height z = r cot a,
/// the Lagrangian m/2 (r'^2/sin^2 a + r^2 phi'^2) - m g r cot a conserves h = r^2 phi' and gives
///
///   r'' = sin^2 a (h^2/r^3) - g sin a cos a.
///
/// Of Newton's law the component along the inward normal (-cos a, sin a), in which the acceleration is
/// (r'' - r phi'^2, z''), leaves  -cos a r'' + sin a z'' = 0  and so
///
///   normal force = m (g sin a + r phi'^2 cos a),
///
/// always positive: the particle never leaves the wall. It starts on the x axis with a horizontal
/// speed along y, at a turning point of r.
struct ConeSlide {
  double mass = 1.0;
  double half_angle = std::numbers::pi / 6;  ///< [rad], between 0 and pi/2
  double gravity = 9.81;
  double start_radius = 1.0;  ///< distance from the axis at t = 0 [length]
  double speed_ratio = 0.8;   ///< start speed / sqrt(gravity start_radius), > 0

  [[nodiscard]] ParticleOnCone scene() const;
  [[nodiscard]] std::vector<Observation<3>> reference(std::span<const double> times) const;
  [[nodiscard]] Observation<3> reference(double t) const;
  [[nodiscard]] Model<3> model() const;
};

}  // namespace dalembert::models
