#include "dalembert/models/slack_string.h"

#include <dalembert/models/event_times.h>

#include <boost/math/quadrature/tanh_sinh.hpp>

#include <cmath>
#include <numbers>

namespace dalembert::models {

SlackString::Built SlackString::scene() const {
  Scene<2> scene("slack-string");
  scene.add(UniformGravity<2>{{0.0, -gravity}});
  const auto bob =
      scene.add_particle({.mass = mass, .position = {0.0, -length}, .velocity = {speed, 0.0}}, "bob");
  const auto string =
      scene.add(unilateral(Distance{Fixed<2>{}, bob, length}, {.allowed = Allowed::negative}), "string");
  return {.scene = std::move(scene), .bob = bob, .string = string};
}

double SlackString::slack_angle() const {
  const double gl = gravity * length;
  return std::asin((speed * speed - 2.0 * gl) / (3.0 * gl));
}

double SlackString::slack_speed() const { return std::sqrt(gravity * length * std::sin(slack_angle())); }

double SlackString::slack_time() const {
  boost::math::quadrature::tanh_sinh<double> integrator;
  return integrator.integrate(
      [&](double phi) {
        return length / std::sqrt(speed * speed - 2.0 * gravity * length * (1.0 - std::cos(phi)));
      },
      0.0, std::numbers::pi / 2.0 + slack_angle());
}

double SlackString::catch_time() const {
  const double a = slack_angle();
  return slack_time() + length * (std::cos(a) - std::cos(3.0 * a)) / (slack_speed() * std::sin(a));
}

Vec<2> SlackString::catch_place() const {
  return length * Vec<2>(std::cos(3.0 * slack_angle()), -std::sin(3.0 * slack_angle()));
}

Vec<2> SlackString::catch_velocity() const {
  const double a = slack_angle(), v = slack_speed();
  return {-v * std::sin(a), v * std::cos(a) - gravity * (catch_time() - slack_time())};
}

EventModel SlackString::event_model() const {
  return {.name = "slack-string", .notes = "", .events = [*this](const EventRun& how) {
            const Built built = scene();
            const double caught = catch_time(), limit = time_limit(how.tolerance);
            const auto run = how.run(built.scene, {.t_end = 1.1 * caught, .samples = 2});
            return std::vector<Timed>{
                {"goes slack", time_of(run, built.string, EventKind::opened), slack_time(), limit},
                {"is caught", time_of(run, built.string, EventKind::struck), caught, limit}};
          }};
}

}  // namespace dalembert::models
