#include "dalembert/models/chaplygin_sleigh.h"

#include <dalembert/models/minimal_ode.h>

#include <array>
#include <cmath>
#include <utility>

namespace dalembert::models {

SleighScene ChaplyginSleigh::scene() const {
  Scene<2> scene("chaplygin-sleigh");
  const RigidBody<2> body = add_body(scene,
                                     {.mass = mass,
                                      .inertia = inertia,
                                      .centre = {arm, 0.0},
                                      .velocity = {speed, arm * turn_rate},
                                      .angular_velocity = turn_rate},
                                     "sleigh");
  const BodyPoint<2> blade = body.point({-arm, 0.0});
  const Constraint<1> edge = scene.add(KnifeEdge{blade, blade, body.centre()}, "blade");
  return {std::move(scene), body, blade, edge};
}

std::vector<Observation<2>> ChaplyginSleigh::reference(std::span<const double> times) const {
  const Real m = mass, a = arm, J = blade_inertia();
  const auto equations = [&](const State& y, State& y_rate) {  // y = (u, w, theta, x, y of the blade)
    const Real u = y[0], w = y[1], theta = y[2];
    y_rate[0] = a * w * w;
    y_rate[1] = -m * a * u * w / J;
    y_rate[2] = w;
    y_rate[3] = u * std::cos(theta);
    y_rate[4] = u * std::sin(theta);
  };
  std::vector<Observation<2>> seen;
  integrate(equations, State{speed, turn_rate, 0, 0, 0}, times, [&](const State& y) {
    const Real u = y[0], w = y[1], theta = y[2];
    const VecOf<Real, 2> blade = vec(y[3], y[4]);
    const VecOf<Real, 2> centre = blade + a * vec(std::cos(theta), std::sin(theta));
    seen.push_back({.positions = {blade.cast<double>(), centre.cast<double>()},
                    .forces = {static_cast<double>(m * u * w * inertia / J)}});
  });
  return seen;
}

Observation<2> ChaplyginSleigh::reference(double t) const { return reference(std::array{t}).front(); }

Model<2> ChaplyginSleigh::model() const {
  const double twice_energy = mass * speed * speed + blade_inertia() * turn_rate * turn_rate;
  return {.name = "chaplygin-sleigh",
          .notes = "mln37",
          .reference = "Newton's laws for blade speed and turning in extended precision",
          .t_end = 10.0,
          .length = arm,
          .force = twice_energy / arm,
          .energy = 0.5 * twice_energy,
          .scene =
              [*this] {
                SleighScene built = scene();
                return Observed<2>{std::move(built.scene), [body = built.body, blade = built.blade,
                                                            edge = built.edge](const Sample<2>& sample) {
                                     return Observation<2>{.positions = {sample.position(blade),
                                                                         sample.position(body.centre())},
                                                           .forces = {sample.multiplier(edge)}};
                                   }};
              },
          .observations = [*this](std::span<const double> times) { return reference(times); }};
}

}  // namespace dalembert::models
