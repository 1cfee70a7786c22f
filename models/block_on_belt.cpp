#include "dalembert/models/block_on_belt.h"

#include <dalembert/models/event_times.h>

#include <cmath>
#include <numbers>

namespace dalembert::models {

double BlockOnBelt::slips() const {
  const double omega = std::sqrt(stiffness / mass), d = (mu_static - mu) * mass * gravity / stiffness;
  return (std::numbers::pi + 2.0 * std::atan2(belt, omega * d)) / omega;
}

double BlockOnBelt::period() const {
  return slips() + 2.0 * (mu_static - mu) * mass * gravity / (stiffness * belt);
}

EventModel BlockOnBelt::event_model() const {
  return {
      "block-on-belt", "-", [model = *this](Stepper stepper, double tolerance) {
        Scene<2> scene("block on belt");
        scene.add(UniformGravity<2>{{0.0, -model.gravity}});
        const auto block = scene.add_particle({.mass = model.mass, .velocity = {model.belt, 0.0}});
        const auto belt = scene.add(OnCurve{block, Plane<2>{}});
        const auto rough =
            scene.add(coulomb(belt, Slip{block, Plane<2>{}, {model.belt, 0.0}}, model.mu, model.mu_static));
        scene.add(
            potential(points(block), [k = model.stiffness](auto r) { return 0.5 * k * r.x() * r.x(); }));
        const double first = model.mu_static * model.mass * model.gravity / (model.stiffness * model.belt);
        const auto run = simulate(scene, {.t_end = first + (model.periods + 0.1) * model.period(),
                                          .samples = 2,
                                          .tolerance = tolerance,
                                          .stepper = stepper});
        std::vector<Timed> all;
        for (int k = 0; k <= model.periods; ++k) {
          const double begins = first + k * model.period();
          const auto number = std::to_string(k + 1);
          all.push_back(
              {"slides " + number, time_of(run, rough, Happened::slides, k), begins, time_limit(tolerance)});
          if (k == model.periods) break;
          all.push_back({"sticks " + number, time_of(run, rough, Happened::sticks, k), begins + model.slips(),
                         time_limit(tolerance)});
        }
        return all;
      }};
}

}  // namespace dalembert::models
