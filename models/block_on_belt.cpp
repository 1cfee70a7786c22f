#include "dalembert/models/block_on_belt.h"

#include <dalembert/models/event_times.h>
#include <dalembert/models/numbered.h>

#include <cmath>
#include <numbers>

namespace dalembert::models {

double BlockOnBelt::frequency() const { return std::sqrt(stiffness / mass); }

BlockOnBelt::Built BlockOnBelt::scene() const {
  Scene<2> scene("block-on-belt");
  scene.add(UniformGravity<2>{{0.0, -gravity}});
  const auto block = scene.add_particle({.mass = mass}, "block");
  const auto table = scene.add(OnCurve{block, Plane<2>{}}, "belt");
  const auto rough =
      scene.add(coulomb(table, Slip{block, Plane<2>{}, Vec<2>(belt, 0.0)}, friction, sticking), "rough");
  const auto spring = scene.add(
      potential(points(block), [k = stiffness](const auto& r) { return 0.5 * k * r.x() * r.x(); }), "spring");
  return {.scene = std::move(scene), .block = block, .belt = table, .rough = rough, .spring = spring};
}

double BlockOnBelt::slip_time() const {
  return 2.0 / frequency() * (std::numbers::pi - std::atan(frequency() * excess() / belt));
}

double BlockOnBelt::period() const { return slip_time() + 2.0 * excess() / belt; }

double BlockOnBelt::sticking_time(int k) const {
  if (k > 0) return slipping_time(k - 1) + slip_time();
  return std::asin(belt / (balance() * frequency())) / frequency();
}

double BlockOnBelt::slipping_time(int k) const {
  const double caught = balance() * (1.0 - std::cos(frequency() * sticking_time()));
  return sticking_time() + (balance() + excess() - caught) / belt + k * period();
}

double BlockOnBelt::heat_of_period() const {
  return friction * weight() * (belt * slip_time() + 2.0 * excess());
}

EventModel BlockOnBelt::event_model() const {
  return {.name = "block-on-belt", .notes = "", .events = [*this](const EventRun& how) {
            constexpr int periods = 5;
            const Built built = scene();
            const double limit = time_limit(how.tolerance);
            const auto run =
                how.run(built.scene, {.t_end = slipping_time(periods) + 0.1 * slip_time(), .samples = 2});
            std::vector<Timed> all;
            for (int k = 0; k <= periods; ++k) {
              all.push_back({numbered("sticks ", k + 1), time_of(run, built.rough, EventKind::sticks, k),
                             sticking_time(k), limit});
              all.push_back({numbered("slips ", k + 1), time_of(run, built.rough, EventKind::slides, k),
                             slipping_time(k), limit});
            }
            return all;
          }};
}

}  // namespace dalembert::models
