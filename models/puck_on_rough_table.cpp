#include "dalembert/models/puck_on_rough_table.h"

#include <dalembert/models/event_times.h>

#include <cmath>

namespace dalembert::models {

PuckOnRoughTable::Built PuckOnRoughTable::scene() const {
  Scene<3> scene("puck-on-rough-table");
  scene.add(UniformGravity<3>{{pull, 0.0, -gravity}});
  const auto puck = scene.add_particle(
      {.mass = mass, .velocity = speed * Vec<3>(std::cos(direction), std::sin(direction), 0.0)}, "puck");
  const auto table = scene.add(OnSurface{puck, Plane<3>{}}, "table");
  const auto rough = scene.add(coulomb(table, Slip{puck, Plane<3>{}}, friction), "rough");
  return {.scene = std::move(scene), .puck = puck, .table = table, .rough = rough};
}

double PuckOnRoughTable::rest_time() const {
  const double a = friction * gravity;
  return speed * (a + pull * std::cos(direction)) / (a * a - pull * pull);
}

double PuckOnRoughTable::speed_along(double psi) const {
  const double exponent = friction * gravity / pull;
  return speed * std::pow(std::tan(0.5 * psi) / std::tan(0.5 * direction), exponent) * std::sin(direction) /
         std::sin(psi);
}

EventModel PuckOnRoughTable::event_model() const {
  return {.name = "puck-on-rough-table", .notes = "", .events = [*this](const EventRun& how) {
            const Built built = scene();
            const auto run = how.run(built.scene, {.t_end = 1.1 * rest_time(), .samples = 2});
            return std::vector<Timed>{{"sticks", time_of(run, built.rough, EventKind::sticks), rest_time(),
                                       time_limit(how.tolerance)}};
          }};
}

}  // namespace dalembert::models
