#pragma once

#include <dalembert/dalembert.h>

#include <array>
#include <complex>

namespace dalembert::models {

/// A top on its point.
struct HeavyTopScene {
  Scene<3> scene;
  RigidBody<3> top;
  Constraint<3> point;  ///< its multipliers: the force on the top there
};

/// A symmetric top in steady precession about its fixed point, a distance l below its centre, with moments of
/// inertia A across (about the point) and C along its axis. The axis leans by theta and precesses at p; n is
/// the whole rate about it, and C n and the angular momentum along z are constant (Routh):
///
///   A p^2 cos theta - C n p + m g l = 0
///   nutation: omega^2 = (C n/A)^2 - 4 p (C n/A) cos theta + p^2 (1 + 3 cos^2 theta)
///   force of the point: m g upwards, m l p^2 sin theta towards the vertical.
///
/// (n = 0 is the conical pendulum.) Asleep, with theta (x + i y) for the horizontal axis,
///
///   A z'' - i C n z' - m g l z = 0,   s = i (C n +- sqrt(C^2 n^2 - 4 A m g l))/(2 A).
struct HeavyTop {
  double lean = 0.0;        ///< theta [rad]
  double precession = 0.0;  ///< p [rad / time]
  double spin = 0.0;        ///< n [rad / time]

  static constexpr double gravity = 9.81, mass = 1.0, arm = 0.5, across = 0.3, along = 0.02;  // A and C

  [[nodiscard]] HeavyTopScene scene() const;
  [[nodiscard]] std::array<double, 2> steady_precessions() const;  ///< of this lean and spin, the slow first
  [[nodiscard]] double nutation() const;                           ///< omega [rad / time]
  /// The s above with + and -, of a top that sleeps; stable if the spin is above the critical one.
  [[nodiscard]] std::array<std::complex<double>, 2> asleep() const;
  [[nodiscard]] static double critical_spin();
};

}  // namespace dalembert::models
