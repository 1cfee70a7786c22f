#pragma once

#include <dalembert/models/model.h>
#include <dalembert/tests/extremes/cases/case.h>

namespace dalembert::extremes {

/// A bob of 1 kg on a spring of 1 m from the origin, released from horizontal:
///
///   r'' = r phi'^2 + g cos phi - (k/m)(r - l),    r phi'' = -g sin phi - 2 r' phi'.
struct SpringPendulum {
  double stiffness;  ///< infinite is a rigid rod

  /// With the spring given as a force, compared with these equations or with the pendulum on a rigid rod.
  [[nodiscard]] models::Model<2> as_force(bool with_rigid) const;
  /// With the spring given as a compliant constraint; its tension is compared too.
  [[nodiscard]] models::Model<2> as_constraint(bool with_rigid) const;
};

/// A pendulum of 1 m and 1 kg in a viscous liquid, c its drag: l phi'' = -g sin phi - (c/m) l phi'. With much
/// drag it creeps, phi' = -(m g/(c l)) sin phi:
///
///   tan(phi/2) = tan(phi0/2) exp(-m g t/(c l)),
///
/// in error by the neglected inertia, of the order of (m/c)^2 g/l.
struct CreepingPendulum {
  double drag;
  [[nodiscard]] double t_end() const { return 2.0 * drag / 9.81; }
  /// 0 where the equation is integrated; of the creeping solution the transient to it from rest displaces the
  /// bob by g (m/c)^2, and inertia slows the motion by less than that part in every c l/(m g), of which
  /// there are 2.
  [[nodiscard]] double error_of_reference() const;
  [[nodiscard]] models::Model<2> model() const;

 private:
  [[nodiscard]] bool creeps() const { return drag > 1e3; }
};

/// Two beads of 1 kg on a wire, 2 m apart, joined by a damper c and a spring k = 1 N/m relaxed at 1 m. The
/// stretch u = x_b - x_a - 1 obeys u'' + 2 c u' + 2 k u = 0 from u = 1 at rest: with the rates
/// p = c + sqrt(c^2 - 2 k) and s = 2 k/p, u = (p exp(-s t) - s exp(-p t))/(p - s).
struct DampedPair {
  double damping;  ///< > sqrt(2 k)
  [[nodiscard]] double t_end() const { return 3.0 * damping; }
  [[nodiscard]] models::Model<2> model() const;
};

/// The car axis of the Test Set for IVP Solvers (F. Mazzia, C. Magherini, release 2.4): an axle of length 1
/// on two springs, the left one on level ground, the right one on a road y = 0.1 sin(10 t), whose foot stays
/// 1 from the left one's. Error of the four coordinates at t = 3 against the published ones.
[[nodiscard]] Run car_axis_at_3(const Options& options);

/// The governor of the catalogue with a spring k and a damper 2 sqrt(k m2) that hold its sleeve z where it
/// starts, z0. To the Lagrangian's equation (see models/governor.h), divided by L, they add
///
///   (m1 + 2 m2 sin^2 theta) L theta'' = ... + sin theta F,    F = -k (z - z0) - c z',
///   z = -2 L cos theta.
struct SprungGovernor {
  double stiffness;
  [[nodiscard]] models::Model<3> model() const;
};

/// A pendulum of 1 m and 1 kg from a block of 1 kg that slides along the vertical on a spring k with the
/// damper c = 2 sqrt(k): with y the block's height above the relaxed spring,
///
///   2 y'' + phi'' sin phi + phi'^2 cos phi = -k y - c y' - 2 g,
///   phi'' + y'' sin phi + g sin phi = 0.
struct SprungPivot {
  double stiffness;
  [[nodiscard]] models::Model<2> model() const;
};

}  // namespace dalembert::extremes
