#include "dalembert/models/bouncing_pendulum.h"

#include <dalembert/models/event_times.h>
#include <dalembert/models/numbered.h>

#include <boost/math/special_functions/ellint_1.hpp>

#include <cmath>
#include <limits>
#include <sstream>

namespace dalembert::models {

BouncingPendulum::Built BouncingPendulum::scene() const {
  Scene<2> scene("bouncing-pendulum");
  scene.add(UniformGravity<2>{{0.0, -gravity}});
  const auto bob = scene.add_particle(
      {.mass = mass, .position = length * Vec<2>(std::sin(amplitude), -std::cos(amplitude))}, "bob");
  const auto rod = scene.add(Distance{Fixed<2>{}, bob, length}, "rod");
  const double x = length * std::sin(wall);
  const auto stop = scene.add(
      unilateral(holonomic(points(bob), [x](auto r) { return r.x() - x; }), {.restitution = restitution}),
      "wall");
  return {.scene = std::move(scene), .bob = bob, .rod = rod, .wall = stop};
}

double BouncingPendulum::swing(double rate) const {
  const double omega0 = std::sqrt(gravity / length), s = std::sin(wall / 2.0), w = rate / (2.0 * omega0);
  const double k2 = s * s + w * w;
  return 2.0 / omega0 * boost::math::ellint_1(std::sqrt(k2), std::atan2(w, s * std::sqrt(1.0 - k2)));
}

double BouncingPendulum::impact_rate(int k) const {
  const double fallen = 2.0 * std::sin((amplitude + wall) / 2.0) * std::sin((amplitude - wall) / 2.0);
  return std::pow(restitution, k) * std::sqrt(2.0 * gravity / length * fallen);
}

double BouncingPendulum::impact_time(int k) const {
  double time = swing(impact_rate(0)) / 2.0;
  for (int i = 1; i <= k; ++i) time += swing(impact_rate(i));
  return time;
}

double BouncingPendulum::rest_time() const {
  int last = 0;  // what follows is no more than its last digit
  while (impact_rate(last) > std::numeric_limits<double>::epsilon() * impact_rate(0)) ++last;
  return impact_time(last);
}

EventModel BouncingPendulum::event_model() const {
  std::ostringstream name;
  name << "bouncing-pendulum-" << restitution;
  return {.name = name.str(), .notes = "", .events = [*this](const EventRun& how) {
            const bool rests = wall > 0.0 && restitution < 1.0;
            const int impacts =
                restitution < 1.0 ? 1 + static_cast<int>(std::log(0.01) / std::log(restitution)) : 10;
            const Built built = scene();
            const auto run = how.run(
                built.scene, {.t_end = 1.1 * (rests ? rest_time() : impact_time(impacts - 1)), .samples = 2});
            const double limit = time_limit(how.tolerance);
            std::vector<Timed> all;
            for (int k = 0; k < impacts; ++k)
              all.push_back({numbered("impact ", k + 1), time_of(run, built.wall, EventKind::struck, k),
                             impact_time(k), limit});
            if (rests)
              all.push_back({"rests", time_of(run, built.wall, EventKind::rested), rest_time(), limit});
            return all;
          }};
}

}  // namespace dalembert::models
