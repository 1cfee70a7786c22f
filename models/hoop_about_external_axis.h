#pragma once

#include <dalembert/models/bead_on_curve.h>

namespace dalembert::models {

/// Bead on a horizontal hoop of radius R that turns at Omega about a vertical axis in its plane, at the
/// distance l from its centre (notes, mex25), released at rest relative to the hoop.
///
/// With e(a) the unit vector at the angle a, the centre is at l e(Omega t), the bead at R e(Omega t + theta)
/// from it. Its acceleration is  -l Omega^2 e(Omega t) - R (theta' + Omega)^2 e  along e = e(Omega t + theta)
/// and  R theta''  across; Newton's law across and along e:
///
///   theta'' + (Omega^2 l/R) sin theta = 0,
///   force towards the centre = m [R (theta' + Omega)^2 + l Omega^2 cos theta].
///
/// A pendulum about the point farthest from the axis, with omega0^2 = Omega^2 l/R: as for the plane pendulum,
/// sin(theta/2) = k sn(K - omega0 t), cos(theta/2) = dn, theta' = -2 k omega0 cn, k = sin(amplitude/2).
struct HoopAboutExternalAxis {
  double mass = 1.0;
  double radius = 1.0;     ///< R
  double offset = 0.5;     ///< l, of the centre from the axis [length], > 0
  double spin = 3.0;       ///< Omega [rad/time]
  double amplitude = 2.0;  ///< theta at t = 0 [rad], between 0 and pi

  [[nodiscard]] BeadOnCurve scene() const;
  [[nodiscard]] Observation<2> reference(double t) const;
  [[nodiscard]] double period() const;  ///< of theta, 4 K(k)/omega0
  [[nodiscard]] Model<2> model() const;
};

}  // namespace dalembert::models
