#pragma once

#include <dalembert/models/model.h>

#include <span>
#include <vector>

namespace dalembert::models {

/// A scene of one sleigh.
struct SleighScene {
  Scene<2> scene;
  RigidBody<2> body;
  BodyPoint<2> blade;
  Constraint<1> edge;  ///< its multiplier is the sideways force on the blade, positive to its left
};

/// Chaplygin's sleigh: a body on a plane whose blade, a distance a behind its centre of mass, moves
/// only along the body's axis (notes, mln37: a constraint that is not integrable).
///
/// With u the speed of the blade along the axis, w the rate of turning, J = I + m a^2 and the blade's
/// sideways force Z, the centre's velocity is u along the axis and a w across, so Newton's laws along,
/// across and about the blade are
///
///   u' - a w^2 = 0,     m (u w + a w') = Z,     J w' = -m a u w     (the last: I w' = -a Z).
///
/// u^2 + (J/m) w^2 = U^2 is conserved, and
///
///   u = U tanh s,   w = U sqrt(m/J) sech s,   s = artanh(u_0/U) + (a U m/J) t:
///
/// whatever the start, in the end it runs straight on with the blade behind. From end to end it turns
/// by pi sqrt(1 + I/(m a^2)). Eliminating w', Z = m u w I/J.
struct ChaplyginSleigh {
  double mass = 1.0;
  double inertia = 0.5;    ///< I, about the centre of mass
  double arm = 0.5;        ///< a > 0, from the blade to the centre of mass [length]
  double speed = -1.0;     ///< u at t = 0; < 0 is blade first
  double turn_rate = 0.5;  ///< w at t = 0 [rad / time]

  [[nodiscard]] SleighScene scene() const;
  [[nodiscard]] std::vector<Observation<2>> reference(std::span<const double> times) const;
  [[nodiscard]] Observation<2> reference(double t) const;
  [[nodiscard]] double blade_inertia() const { return inertia + mass * arm * arm; }  ///< J
  [[nodiscard]] Model<2> model() const;
};

}  // namespace dalembert::models
