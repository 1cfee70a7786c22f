#include "dalembert/models/disk_on_incline.h"

#include <cmath>

namespace dalembert::models {

DiskOnTrack DiskOnIncline::scene() const {
  const Vec<2> downhill(std::cos(slope), -std::sin(slope)), normal(std::sin(slope), std::cos(slope));
  DiskOnTrack built = disk_on_track("disk-on-incline",
                                    {.mass = mass,
                                     .radius = radius,
                                     .inertia = inertia_ratio * mass * radius * radius,
                                     .position = radius * normal,
                                     .velocity = speed * downhill,
                                     .angular_velocity = -speed / radius},
                                    Fixed<2>{downhill});
  built.scene.add(UniformGravity<2>{{0.0, -gravity}});
  return built;
}

Observation<2> DiskOnIncline::reference(double t) const {
  using Real = long double;
  const Real sine = std::sin(Real(slope)), cosine = std::cos(Real(slope)), c = inertia_ratio;
  const Real acceleration = gravity * sine / (1 + c);
  const Real s = speed * Real(t) + acceleration * t * t / 2;
  return {.positions = {vec(s * cosine + radius * sine, -s * sine + radius * cosine).cast<double>()},
          .forces = {static_cast<double>(-c * mass * acceleration),
                     static_cast<double>(mass * gravity * cosine)}};
}

Model<2> DiskOnIncline::model() const {
  return {.name = "disk-on-incline",
          .notes = "mln76",
          .reference = "closed form: constant acceleration g sin(alpha)/(1 + c)",
          .t_end = 2.0,
          .length = radius,
          .force = mass * gravity,
          .energy = mass * gravity * radius,
          .scene = [*this] { return observed(scene()); },
          .observations = [*this](std::span<const double> times) { return at_each<2>(*this, times); }};
}

}  // namespace dalembert::models
