#pragma once

#include <dalembert/models/event_model.h>

namespace dalembert::models {

/// A uniform block 2 b wide and 2 h high rocks on a floor, about one lower corner and the other (Housner, The
/// behavior of inverted pendulum structures during earthquakes, 1963).
///
/// With R^2 = b^2 + h^2, tan a = b/h, I = m R^2/3 and theta >= 0 the tilt, to either side, the centre is at
/// y = R cos(a - theta), as the corner stays on the floor. On a rough floor it stays in its place too; on a
/// smooth one nothing pushes sideways, and the centre goes up and down only:
///
///   J(theta) theta'^2/2 = m g R (cos(a - theta_k) - cos(a - theta)),   theta_k the largest,             (1)
///   J = I + m R^2 (rough),   J = I + m R^2 sin^2(a - theta) (smooth).
///
/// When it is upright, turning at w, the other corner strikes at 2 b w. Let P be its impulse, upwards, and Q
/// the one along the floor, which keeps the base from sliding: it turns the block as if its inertia were
/// I' = I + m h^2; on a smooth floor Q = 0 and I' = I. With v the velocity of the centre upwards, from -b w
/// to +b w+ (the corner struck rests without restitution),
///
///   m b (w + w+) = P,  I' (w - w+) = b P:   w+ = r w,  r = (I' - m b^2)/(I' + m b^2)                    (2)
///
/// and the corner that it turned about lifts off at 2 b w+: it takes no impulse, as Moreau's law requires, if
/// r > 0. For a rough floor r = 1 - (3/2) sin^2 a, Housner's. Each time the energy of (1) is scaled by r^2;
/// with Q(theta_k) = int_0^theta_k dtheta/theta', and x_k = cos(a - theta_k) - cos a = r^2k x_0,
///
///   t_k = Q(theta_0) + 2 Q(theta_1) + ... + 2 Q(theta_k),   k from 0,
///   tan(theta_k/2) = x_k/(sin a + sqrt(sin^2 a - x_k (2 cos a + x_k))).
///
/// As Q goes with r^k that converges: it stands still at the limit. In (1) theta = theta_k - u^2 makes the
/// integrand smooth.
///
/// That the lower corner stays in its place is one equation for both. With x_m the middle of the base and s
/// the sine of the tilt it is x_m = b (1 - cos theta) sign s: both sides have the same gradient at s = 0,
///
///   g = x_m - b s |s|/(1 + sqrt(1 - s^2)).
struct RockingBlock {
  enum class Floor { rough, smooth };

  double mass = 1.0;
  double half_width = 0.4;   ///< b
  double half_height = 1.0;  ///< h
  double gravity = 9.81;
  double tilt = 0.2;  ///< theta_0, at rest, to the right [rad]
  Floor floor = Floor::rough;

  struct Built {
    Scene<2> scene;
    RigidBody<2> block;
    Constraint<1> left, right;  ///< corners on the floor
  };
  [[nodiscard]] Built scene() const;
  [[nodiscard]] double ratio() const;             ///< r
  [[nodiscard]] double impact_rate(int k) const;  ///< w of the k-th impact, before it
  [[nodiscard]] double impact_time(int k) const;  ///< of the left corner if k is even
  [[nodiscard]] double rest_time() const;
  /// Impacts down to a hundredth of the first speed; by the explicit stepper also rest.
  [[nodiscard]] EventModel event_model() const;

 private:
  [[nodiscard]] double inertia(double theta) const;  // J
  [[nodiscard]] double drop(int k) const;            // x_k
  [[nodiscard]] double quarter(int k) const;         // Q(theta_k)
};

}  // namespace dalembert::models
