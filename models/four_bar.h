#pragma once

#include <dalembert/models/model.h>

#include <span>
#include <vector>

namespace dalembert::models {

/// A scene of pinned rods.
struct FourBarScene {
  Scene<2> scene;
  std::vector<ThinRod<2>> uprights;        ///< A_i B_i
  std::vector<ThinRod<2>> crossbars;       ///< B_i B_(i+1)
  std::vector<Constraint<2>> ground_pins;  ///< at A_i; the multipliers are the force on the upright
};

/// N four-bar linkages in a row (IFToMM benchmark A02): N + 1 equal uniform rods A_i B_i standing
/// upright on pins at A_i = (i L, 0), joined by N equal rods B_i B_(i+1). It starts upright with the
/// speed v of the B_i along x.
///
/// All uprights turn by the same angle p from upright, the crossbars do not turn. Uprights have the
/// inertia m L^2/3 about their pins, crossbars the speed L p', so
///
///   T = [(N+1)/3 + N] m L^2 p'^2/2,    V = [(N+1)/2 + N] m g L cos p
///   p'' = W^2 sin p,                   W^2 = (g/L) 3 (3N+1)/(2 (4N+1)).
///
/// When the rods all lie on the x axis the linkage could bend: its degrees of freedom jump from 1 to
/// N + 1 and the constraints are dependent for an instant. There the forces along the crossbars
/// grow without bound, like 1/cos p, and opposite to each other. What the ground carries in all does
/// not; by Newton's law for the whole,
///
///   force of the ground = m L [(N+1)/2 + N] (p'' t - p'^2 e) + (2N+1) m g (0, 1),
///   e = (sin p, cos p),   t = (cos p, -sin p).
struct FourBar {
  int loops = 2;        ///< N >= 1
  double mass = 1.0;    ///< of each rod
  double length = 1.0;  ///< of each rod
  double gravity = 9.81;
  double speed = 1.0;  ///< v

  [[nodiscard]] FourBarScene scene() const;
  [[nodiscard]] std::vector<Observation<2>> reference(std::span<const double> times) const;
  [[nodiscard]] Observation<2> reference(double t) const;
  [[nodiscard]] Model<2> model() const;
};

}  // namespace dalembert::models
