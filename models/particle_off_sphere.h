#pragma once

#include <dalembert/models/event_model.h>

namespace dalembert::models {

/// A particle slides from rest off a smooth sphere that lies on a floor: in the plane, a circle.
///
/// With theta from the top of a sphere of radius R, theta'' = (g/R) sin theta while it touches, and
///
///   theta'^2 = (2 g/R)(cos theta0 - cos theta),   normal force = m (g cos theta - R theta'^2)         (1)
///
/// so that it leaves at cos theta1 = (2/3) cos theta0, with theta1'^2 = (g/R) cos theta1. As time passes by
/// dw/theta'' while the rate w grows, and (1) gives theta by w,
///
///   t1 = int_0^theta1' dw/((g/R) sin theta),   cos theta = cos theta0 - R w^2/(2 g),
///
/// whose integrand is smooth. (Over theta it is singular at the start.) Then a parabola, at v = R theta1'
/// along (cos theta1, -sin theta1), down to the floor at y = -R:
///
///   R cos theta1 - v sin theta1 s - g s^2/2 = -R,   s the time since t1.
struct ParticleOffSphere {
  double mass = 1.0;
  double radius = 1.0;
  double gravity = 9.81;
  double angle = 0.1;  ///< theta0, of the start, at rest [rad]

  struct Built {
    Scene<2> scene;  ///< the sphere's centre is the origin
    Particle<2> particle;
    Constraint<1> sphere, floor;
  };
  [[nodiscard]] Built scene() const;
  [[nodiscard]] double leaving_angle() const;  ///< theta1
  [[nodiscard]] double leaving_time() const;
  [[nodiscard]] double falling_time() const;  ///< from there to the floor
  /// Where and how fast it is at the floor.
  [[nodiscard]] Vec<2> landing_place() const;
  [[nodiscard]] Vec<2> landing_velocity() const;
  [[nodiscard]] EventModel event_model() const;
};

}  // namespace dalembert::models
