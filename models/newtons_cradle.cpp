#include "dalembert/models/newtons_cradle.h"

#include <dalembert/models/event_times.h>
#include <dalembert/models/numbered.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dalembert::models {

NewtonsCradle::Built NewtonsCradle::scene() const {
  Built built{.scene = Scene<2>("newtons-cradle"), .balls = {}, .contacts = {}};
  const double stiffness = mass * gravity / thread;
  for (int i = 0; i < balls; ++i) {
    const double place = i * (diameter + gap), start = i == 0 ? -amplitude : place;
    const double nearer = i == 0 || gap > 0.0 ? 0.0 : press * diameter * (i - balls / 2.0);
    const double middle = place - nearer;
    const auto ball =
        built.scene.add_particle({.mass = mass, .position = {start, 0.0}}, numbered("ball", i + 1));
    built.scene.add(potential(points(ball), [stiffness, middle](auto r) {
      return 0.5 * stiffness * (r.x() - middle) * (r.x() - middle);
    }));
    built.balls.push_back(ball);
  }
  for (std::size_t i = 1; i < built.balls.size(); ++i) {
    const auto apart = [d = diameter](auto a, auto b) { return b.x() - a.x() - d; };
    built.contacts.push_back(
        built.scene.add(unilateral(holonomic(points(built.balls[i - 1], built.balls[i]), apart),
                                   {.restitution = restitution}),
                        numbered("contact", i)));
  }
  return built;
}

double NewtonsCradle::frequency() const { return std::sqrt(gravity / thread); }

double NewtonsCradle::pressing_force(int j) const {
  return mass * frequency() * frequency() * press * diameter * j * (balls - 1 - j) / 2.0;
}

double NewtonsCradle::impact_time(int k) const {
  const double omega = frequency(), pi = std::numbers::pi;
  if (gap == 0.0) return (k + 0.5) * pi / omega;
  double phase = pi / 2.0 + std::asin(gap / amplitude), handed_on = amplitude;  // V/omega
  for (int i = 1; i <= k; ++i) {
    handed_on = std::sqrt(amplitude * amplitude - i * gap * gap);
    phase += i < balls - 1 ? std::asin(gap / handed_on) : 2.0 * (pi - std::atan(handed_on / gap));
  }
  return phase / omega;
}

EventModel NewtonsCradle::event_model() const {
  const std::string name = gap == 0.0 ? "newtons-cradle" : "newtons-cradle-with-gaps";
  return {.name = name, .notes = "", .events = [*this](const EventRun& how) {
            const bool touch = gap == 0.0;
            const int impacts = touch ? 4 : balls;
            const Built built = scene();
            const auto run = how.run(built.scene, {.t_end = impact_time(impacts - 1) + 0.1, .samples = 2});
            std::vector<Timed> all;
            for (int k = 0; k < impacts; ++k) {
              // With gaps the contacts are struck in their order, and the last one again.
              const int contact = touch ? 0 : std::min(k, balls - 2);
              const int which = touch ? k : k - contact;
              all.push_back(
                  {numbered("impact ", k + 1),
                   time_of(run, built.contacts[static_cast<std::size_t>(contact)], EventKind::struck, which),
                   impact_time(k), time_limit(how.tolerance)});
            }
            return all;
          }};
}

}  // namespace dalembert::models
