#include "dalembert/models/rolling_disk.h"

#include <cmath>
#include <utility>

namespace dalembert::models {

UprightDisk upright_disk(const std::string& name, const RollingDisk& d) {
  UprightDisk built{.scene = Scene<2>(name), .centre = {}, .heading = {}, .spin = {}, .rolling = {}};
  const double about_axis = d.mass * d.radius * d.radius / 2.0;
  built.centre = built.scene.add_particle({.mass = d.mass, .velocity = {d.radius * d.spin_rate, 0.0}});
  built.heading = built.scene.add_rotor({.inertia = about_axis / 2.0, .angular_velocity = d.turn_rate});
  built.spin = built.scene.add_rotor({.inertia = about_axis, .angular_velocity = d.spin_rate});
  built.rolling = built.scene.add(UprightRolling{built.centre, built.heading, built.spin, d.radius});
  return built;
}

Observed<2> observed(UprightDisk built) {
  return {
      std::move(built.scene), [centre = built.centre, rolling = built.rolling](const Sample<2>& sample) {
        const Vec<2> friction = sample.multiplier(rolling);
        return Observation<2>{.positions = {sample.position(centre)}, .forces = {friction[0], friction[1]}};
      }};
}

UprightDisk RollingDisk::scene() const { return upright_disk("rolling-disk", *this); }

Observation<2> RollingDisk::reference(double t) const {
  const double alpha = turn_rate * t;
  return {.positions = {path_radius() * Vec<2>(std::sin(alpha), 1.0 - std::cos(alpha))},
          .forces = {0.0, mass * radius * spin_rate * turn_rate}};
}

Model<2> RollingDisk::model() const {
  const double speed = radius * spin_rate;
  return {.name = "rolling-disk",
          .notes = "mln37",
          .reference = "closed form: a circle",
          .t_end = 10.0,
          .length = std::abs(path_radius()),
          .force = std::abs(mass * speed * turn_rate),
          .energy = 0.5 * mass * speed * speed,
          .scene = [*this] { return observed(scene()); },
          .observations = [*this](std::span<const double> times) { return at_each<2>(*this, times); }};
}

}  // namespace dalembert::models
