#pragma once

#include <dalembert/models/model.h>

#include <span>
#include <vector>

namespace dalembert::models {

/// A scene of a crank, a connecting rod with its slider, and what joins them.
struct SliderCrankScene {
  Scene<2> scene;
  RigidBody<2> crank, rod;
  Constraint<2> pin;    ///< crank pin: the multipliers are the force on the rod
  Constraint<1> guide;  ///< its multiplier is the force of the guide on the slider, upwards
};

/// Slider crank with a spring and a damper, the example of SUNDIALS' IDA (idasSlCrank).
///
/// Crank of radius a at the angle q, slider at (x, 0), connecting rod of length 1 at the angle p:
///
///   x = cos p + a cos q,    sin p + a sin q = 0.                                              (1)
///
/// The kinetic energy (J1 q'^2 + m2 x'^2 + J2 p'^2)/2 is that of a crank of inertia J1 about its
/// bearing and one body, slider and rod, with its centre of mass at the slider: no equimomental
/// replacement is needed. Spring and damper join the middles of crank and rod, with the tension
/// f = k (l - l0) + c l' of the length
///
///   l^2 = x^2 - x (cos p + a cos q) + (1 + a^2)/4 + a cos(q - p)/2;
///
/// the further forces F on x and -F sin p on p are those of a constant force (F, 0) at the rod's
/// far point, (x + cos p, sin p). With the generalised forces Q, and from (1)
/// P = dp/dq = -a cos q/cos p, X = dx/dq = -sin p P - a sin q and their derivatives P_q, X_q,
///
///   (J1 + m2 X^2 + J2 P^2) q'' = Q_q + X Q_x + P Q_p - (m2 X X_q + J2 P P_q) q'^2.
///
/// Newton's laws for the rod give the force R of the pin on it and that of the guide:
///
///   R_x = m2 x'' - Q_x,   R_y = (Q_p - J2 p'' + R_x sin p)/cos p,   guide = -R_y
///
/// (the two middles are at the same height, so the spring has no part in the last).
struct SliderCrank {
  double crank_radius = 0.5;    ///< a < 1
  double crank_inertia = 1.0;   ///< J1
  double slider_mass = 1.0;     ///< m2
  double rod_inertia = 2.0;     ///< J2
  double stiffness = 1.0;       ///< k
  double damping = 1.0;         ///< c
  double relaxed_length = 1.0;  ///< l0
  double drive = 1.0;           ///< F
  // It starts at rest with the crank upright: q = pi/2.

  [[nodiscard]] SliderCrankScene scene() const;
  [[nodiscard]] std::vector<Observation<2>> reference(std::span<const double> times) const;
  [[nodiscard]] Observation<2> reference(double t) const;
  [[nodiscard]] Model<2> model() const;
};

}  // namespace dalembert::models
