#pragma once

#include <dalembert/models/event_model.h>

namespace dalembert::models {

/// A bob on a string is sent off at its lowest point so fast that it rises above the pivot, but not so fast
/// that it goes round, 2 g l < v0^2 < 5 g l: the string goes slack, the bob falls and is caught.
///
/// With phi from the lowest point, (l phi')^2 = v0^2 - 2 g l (1 - cos phi), and the tension is
/// m (l phi'^2 + g cos phi): 0 at phi1 = pi/2 + a where
///
///   sin a = (v0^2 - 2 g l)/(3 g l),   v1^2 = g l sin a,   t1 = int_0^phi1 l dphi/(l phi').
///
/// The parabola from there osculates the circle of the string: of their four common points three fall
/// together at the angle a from the horizontal. For any parabola with an upright axis the angles of the four
/// add up to 0, so that the fourth, where the string is straight again, is at -3 a. Across it goes at
/// v1 sin a, hence
///
///   t2 - t1 = l (cos a - cos 3 a)/(v1 sin a).
///
/// The bob rises to the right and falls to the left: x = -v1 sin a s + l cos a. The string takes the
/// velocity's part along it, and the bob goes on with the rest.
struct SlackString {
  double mass = 1.0;
  double length = 1.0;
  double gravity = 9.81;
  double speed = 6.2;  ///< v0 [length/time]

  struct Built {
    Scene<2> scene;  ///< the pivot is the origin
    Particle<2> bob;
    Constraint<1> string;
  };
  [[nodiscard]] Built scene() const;
  [[nodiscard]] double slack_angle() const;  ///< a, above the horizontal
  [[nodiscard]] double slack_time() const;
  [[nodiscard]] double slack_speed() const;  ///< v1
  [[nodiscard]] double catch_time() const;
  /// When it is caught, before that.
  [[nodiscard]] Vec<2> catch_place() const;
  [[nodiscard]] Vec<2> catch_velocity() const;
  [[nodiscard]] EventModel event_model() const;
};

}  // namespace dalembert::models
