#include "dalembert/models/sliding_ladder.h"

#include <dalembert/models/event_times.h>

#include <boost/math/quadrature/tanh_sinh.hpp>

#include <cmath>
#include <numbers>

namespace dalembert::models {

SlidingLadder::Built SlidingLadder::scene() const {
  Scene<2> scene("sliding-ladder");
  scene.add(UniformGravity<2>{{0.0, -gravity}});
  const auto ladder = add_thin_rod(
      scene, {.mass = mass, .start = {0.0, length * std::cos(angle)}, .end = {length * std::sin(angle), 0.0}},
      "ladder");
  const auto x = [](auto r) { return r.x(); };
  const auto y = [](auto r) { return r.y(); };
  const auto wall = scene.add(unilateral(holonomic(points(ladder.start()), x)), "wall");
  const auto floor = scene.add(unilateral(holonomic(points(ladder.end()), y)), "floor");
  const auto lies_down =
      scene.add(unilateral(holonomic(points(ladder.start()), y)), "floor under the upper end");
  return {.scene = std::move(scene), .ladder = ladder, .wall = wall, .floor = floor, .lies_down = lies_down};
}

double SlidingLadder::leaving_angle() const { return std::acos(2.0 / 3.0 * std::cos(angle)); }

double SlidingLadder::leaving_time() const {
  boost::math::quadrature::tanh_sinh<double> integrator;
  return integrator.integrate(
      [&](double w) {
        const double cosine = std::cos(angle) - length * w * w / (3.0 * gravity);
        return 1.0 / (1.5 * gravity / length * std::sqrt(1.0 - cosine * cosine));
      },
      0.0, std::sqrt(gravity / length * std::cos(angle)));
}

double SlidingLadder::drift() const {
  const double rate = std::sqrt(gravity / length * std::cos(angle));
  return length / 2.0 * rate * std::cos(leaving_angle());
}

double SlidingLadder::rate_after_leaving(double phi) const {
  const double s = std::sin(phi), u = drift();
  const double energy = gravity / 2.0 * (std::cos(angle) - std::cos(phi)) - u * u / (2.0 * length);
  return std::sqrt(24.0 / length * energy / (1.0 + 3.0 * s * s));
}

double SlidingLadder::lying_time() const {
  boost::math::quadrature::tanh_sinh<double> integrator;
  return leaving_time() + integrator.integrate([&](double phi) { return 1.0 / rate_after_leaving(phi); },
                                               leaving_angle(), std::numbers::pi / 2.0);
}

EventModel SlidingLadder::event_model() const {
  return {.name = "sliding-ladder", .notes = "", .events = [*this](const EventRun& how) {
            const Built built = scene();
            const double lies = lying_time(), limit = time_limit(how.tolerance);
            const auto run = how.run(built.scene, {.t_end = 1.1 * lies, .samples = 2});
            return std::vector<Timed>{
                {"leaves the wall", time_of(run, built.wall, EventKind::opened), leaving_time(), limit},
                {"lies down", time_of(run, built.lies_down, EventKind::struck), lies, limit}};
          }};
}

}  // namespace dalembert::models
