#include "dalembert/models/bouncing_ball.h"

#include <dalembert/models/event_times.h>
#include <dalembert/models/numbered.h>

#include <cmath>
#include <sstream>

namespace dalembert::models {

BouncingBall::Built BouncingBall::scene() const {
  Scene<2> scene("bouncing-ball");
  scene.add(UniformGravity<2>{{0.0, -gravity}});
  const auto ball =
      scene.add_particle({.mass = mass, .position = {0.0, height}, .velocity = {drift, 0.0}}, "ball");
  const auto floor = scene.add(
      unilateral(holonomic(points(ball), [](auto r) { return r.y(); }), {.restitution = restitution}),
      "floor");
  return {.scene = std::move(scene), .ball = ball, .floor = floor};
}

double BouncingBall::impact_time(int k) const {
  double flights = 1.0;
  for (int i = 1; i <= k; ++i) flights += 2.0 * std::pow(restitution, i);
  return flights * std::sqrt(2.0 * height / gravity);
}

double BouncingBall::rest_time() const {
  return std::sqrt(2.0 * height / gravity) * (1.0 + restitution) / (1.0 - restitution);
}

EventModel BouncingBall::event_model() const {
  std::ostringstream name;
  name << "bouncing-ball-" << restitution;
  return {.name = name.str(), .notes = "", .events = [*this](const EventRun& how) {
            const bool rests = restitution < 1.0;
            const int impacts = rests ? 1 + static_cast<int>(std::log(0.01) / std::log(restitution)) : 10;
            const Built built = scene();
            const auto run = how.run(
                built.scene, {.t_end = 1.1 * (rests ? rest_time() : impact_time(impacts - 1)), .samples = 2});
            const double limit = time_limit(how.tolerance);
            std::vector<Timed> all;
            for (int k = 0; k < impacts; ++k)
              all.push_back({numbered("impact ", k + 1), time_of(run, built.floor, EventKind::struck, k),
                             impact_time(k), limit});
            if (rests)
              all.push_back({"rests", time_of(run, built.floor, EventKind::rested), rest_time(), limit});
            return all;
          }};
}

}  // namespace dalembert::models
