#pragma once

#include <dalembert/models/model.h>

#include <array>
#include <span>
#include <vector>

namespace dalembert::models {

/// A scene of one thin disk on a horizontal plane.
struct SpinningDiskScene {
  Scene<3> scene;
  Lamina disk;
  std::array<BodyPoint<3, 3>, 2> marks;  ///< points of the rim, the second a quarter turn on
  Constraint<1> contact;                 ///< its multiplier is the normal force
  Constraint<2> rolling;  ///< its multipliers: friction along the rim, and to the side the axis leans to
};

/// Thin uniform disk that rolls in space (notes, mln37, without keeping it upright).
///
/// The axis n leans by theta from the vertical z towards the horizontal h, which precesses at the rate
/// Omega. With rho up the disk and t = z x h along the rim,
///
///   n = sin(theta) h + cos(theta) z,   rho = -cos(theta) h + sin(theta) z,   t x rho = n,
///   angular velocity = w3 n + Omega sin(theta) rho + theta' t,
///
/// and with A = m r^2/4 across and C = m r^2/2 along the axis, L = C w3 n + A Omega sin(theta) rho + A
/// theta' t. Rolling, the centre has the velocity and, from the turning of the frame, the acceleration
///
///   v   = r (theta' n - w3 t),
///   a/r = (theta'' + Omega w3 sin(theta)) n - (theta'^2 + Omega w3 cos(theta)) rho
///         + (Omega theta' sin(theta) - w3') t.
///
/// The force of the plane is F = m (a + g z), its torque -r rho x F = dL/dt; along n, rho and t
///
///   (C + m r^2) w3' = m r^2 Omega theta' sin(theta)
///   A Omega' sin(theta) = C w3 theta' - 2 A Omega theta' cos(theta)
///   (A + m r^2) theta'' = A Omega^2 sin(theta) cos(theta) - (C + m r^2) Omega w3 sin(theta)
///                         - m g r cos(theta).
///
/// Steady precession needs the last right-hand side, f, to be 0; then the centre goes round a circle of
/// radius r |w3/Omega|. About it the first two give Omega and w3 by theta, and
///
///   -(A + m r^2) omega^2 = f_theta + f_Omega (C w3 - 2 A Omega cos(theta))/(A sin(theta))
///                          + f_w3 m r^2 Omega sin(theta)/(C + m r^2).
///
/// Straight on, theta = pi/2 and Omega = 0, 5 omega^2 = 4 (3 w3^2 - g/r): stable if v^2 > g r/3.
struct SpinningDisk {
  double mass = 1.0;
  double radius = 0.5;
  double gravity = 9.81;
  double lean = 1.0;        ///< theta at t = 0 [rad], between 0 and pi
  double lean_rate = 0.0;   ///< theta' at t = 0 [rad / time]
  double precession = 2.0;  ///< Omega at t = 0 [rad / time]
  double spin = -4.0;       ///< w3 at t = 0 [rad / time]

  [[nodiscard]] SpinningDiskScene scene() const;
  [[nodiscard]] std::vector<Observation<3>> reference(std::span<const double> times) const;
  [[nodiscard]] Observation<3> reference(double t) const;
  [[nodiscard]] double steady_spin() const;        ///< w3 of the steady precession with this lean and Omega
  [[nodiscard]] double frequency_squared() const;  ///< omega^2, if the precession is steady
  [[nodiscard]] Model<3> model() const;
};

}  // namespace dalembert::models
