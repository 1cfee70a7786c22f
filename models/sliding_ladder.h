#pragma once

#include <dalembert/models/event_model.h>

namespace dalembert::models {

/// A ladder, a uniform thin rod of length l, slides from rest down a smooth wall and along a smooth floor.
///
/// With phi from upright the centre is (l/2)(sin phi, cos phi) as long as both hold it: it goes on a circle,
///
///   phi'' = (3 g/(2 l)) sin phi,   phi'^2 = (3 g/l)(cos phi0 - cos phi),                              (1)
///   wall force = m x_c'' = (3 m g/4) sin phi (3 cos phi - 2 cos phi0):
///
/// it leaves the wall at cos phi1 = (2/3) cos phi0, phi1'^2 = (g/l) cos phi0. As of ParticleOffSphere
///
///   t1 = int_0^phi1' dw/phi'',   cos phi = cos phi0 - l w^2/(3 g).
///
/// From there nothing pushes along the floor: u = x_c' = (l/2) phi1' cos phi1 stays, and the energy gives
///
///   (l/24)(1 + 3 sin^2 phi) phi'^2 = (g/2)(cos phi0 - cos phi) - u^2/(2 l),   t2 - t1 = int dphi/phi' (2)
///
/// to phi = pi/2, where it lies down. The end that falls strikes with U = l phi', the other lies already:
/// without restitution impulses P1, P2 >= 0 at both end the motion,
///
///   4 P1 - 2 P2 = m U,  4 P2 - 2 P1 = 0:   P1 = m U/3,  P2 = m U/6.
struct SlidingLadder {
  double mass = 2.0;
  double length = 1.5;
  double gravity = 9.81;
  double angle = 0.3;  ///< phi0, of the start, at rest [rad]

  struct Built {
    Scene<2> scene;
    ThinRod<2> ladder;                     ///< from its upper end to its lower one
    Constraint<1> wall, floor, lies_down;  ///< of the upper end, the lower, and the upper on the floor
  };
  [[nodiscard]] Built scene() const;
  [[nodiscard]] double leaving_angle() const;  ///< phi1
  [[nodiscard]] double leaving_time() const;
  [[nodiscard]] double drift() const;  ///< u, from there on
  [[nodiscard]] double lying_time() const;
  [[nodiscard]] double rate_after_leaving(double phi) const;  ///< phi' by (2)
  [[nodiscard]] EventModel event_model() const;
};

}  // namespace dalembert::models
