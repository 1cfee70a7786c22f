#include "dalembert/models/rolling_disk_on_slope.h"

#include <cmath>

namespace dalembert::models {

UprightDisk RollingDiskOnSlope::scene() const {
  UprightDisk built = upright_disk("rolling-disk-on-slope", {mass, radius, spin_rate, turn_rate});
  built.scene.add(UniformGravity<2>{{gravity * std::sin(slope), 0.0}});
  return built;
}

Observation<2> RollingDiskOnSlope::reference(double t) const {
  const double Omega = turn_rate, I = mass * radius * radius / 2.0;
  const double pull = mass * gravity * std::sin(slope);
  const double A = pull * radius / (I + mass * radius * radius);
  const double sine = std::sin(Omega * t), cosine = std::cos(Omega * t);
  const double spin = spin_rate + A / Omega * sine;
  const double down = spin_rate * sine + A / (2.0 * Omega) * sine * sine;
  const double along = spin_rate * (1.0 - cosine) + A / 2.0 * (t - sine * cosine / Omega);
  return {.positions = {radius / Omega * Vec<2>(down, along)},
          .forces = {-I / radius * A * cosine, mass * radius * spin * Omega + pull * sine}};
}

Model<2> RollingDiskOnSlope::model() const {
  const double speed = radius * spin_rate;
  return {.name = "rolling-disk-on-slope",
          .notes = "mln37",
          .reference = "closed form",
          .t_end = 10.0,
          .length = std::abs(speed / turn_rate),
          .force = mass * gravity,
          .energy = 0.5 * mass * speed * speed,
          .scene = [*this] { return observed(scene()); },
          .observations = [*this](std::span<const double> times) { return at_each<2>(*this, times); }};
}

}  // namespace dalembert::models
