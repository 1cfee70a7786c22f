#pragma once

#include "scenes.h"

#include <cmath>
#include <limits>
#include <numbers>

/// Shared by the tests of readings.
namespace dalembert {

constexpr Stepper both[] = {Stepper::ida, Stepper::erk};

/// Round-off of a linear system of a few equations with numbers of size 1 to 100, in units in the last place:
/// each of its quantities is a sum of some tens of products, and its condition here is below 10.
constexpr double round_off = 1e3 * std::numeric_limits<double>::epsilon() * 100.0;

/// A compound pendulum of mass m, inertia I about its centre, whose hinge is d from it: with the angle phi of
/// the arm from the vertical, (I + m d^2) phi'' = -m g d sin phi and (I + m d^2) phi'^2/2 = m g d (cos phi -
/// cos phi_0).
struct CompoundPendulum {
  static constexpr double m = 3.0, I = 0.4, d = 0.6, g = 9.81, start = 1.2;
  Scene<2> scene{"compound"};
  RigidBody<2> body;
  BodyPoint<2> pin, tip;
  Constraint<2> hinge;

  CompoundPendulum() {
    scene.add(UniformGravity<2>{{0.0, -g}});
    // The body's first axis points from the hinge to the centre.
    body = add_body(scene,
                    BodyState<2>{.mass = m,
                                 .inertia = I,
                                 .centre = {d * std::sin(start), -d * std::cos(start)},
                                 .angle = start - 0.5 * std::numbers::pi},
                    "body");
    pin = body.point({-d, 0.0});
    tip = body.point({2.0 * d, 0.0});
    hinge = scene.add(Coincident{Fixed<2>{}, pin}, "hinge");
  }
  struct State {
    Vec<2> along, across;  ///< the arm, and to its left
    double square, rate;   ///< of the angular velocity; angular acceleration
  };
  [[nodiscard]] State at(const Sample<2>& now) const {
    const Vec<2> along = now.position(body.centre()).normalized(), across{-along.y(), along.x()};
    const double inertia = I + m * d * d;
    const double cosine = -along.y(), sine = along.x();
    return {along, across, 2.0 * m * g * d * (cosine - std::cos(start)) / inertia,
            -m * g * d * sine / inertia};
  }
};

/// The energy integral holds to the error of the run: the tolerance in each step, and 2 m g d/(I + m d^2),
/// about 24, times as much in the square of the angular velocity and in its rate.
inline double error_of(const Trajectory<2>& run) {
  return 1e-10 * static_cast<double>(run.statistics().steps) * 24.0;
}

}  // namespace dalembert
