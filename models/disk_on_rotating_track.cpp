#include "dalembert/models/disk_on_rotating_track.h"

#include <cmath>
#include <utility>

namespace dalembert::models {

DiskOnTrack DiskOnRotatingTrack::scene() const {
  const auto ahead = driven([omega = spin](const auto& t) {
    using std::cos;
    using std::sin;
    return vec(cos(omega * t), sin(omega * t));
  });
  return disk_on_track("disk-on-rotating-track",
                       {.mass = mass,
                        .radius = radius,
                        .inertia = inertia_ratio * mass * radius * radius,
                        .position = {start, radius},
                        .velocity = {-radius * spin, start * spin},
                        .angular_velocity = spin},
                       ahead);
}

Observation<2> DiskOnRotatingTrack::reference(double t) const {
  using Real = long double;
  const Real omega = spin, c = inertia_ratio, growth = omega / std::sqrt(1 + c);
  const Real q = start * std::cosh(growth * t), q_rate = start * growth * std::sinh(growth * t);
  const Real cosine = std::cos(omega * t), sine = std::sin(omega * t);
  return {.positions = {vec(q * cosine - radius * sine, q * sine + radius * cosine).cast<double>()},
          .forces = {static_cast<double>(-c / (1 + c) * mass * omega * omega * q),
                     static_cast<double>(mass * (2 * omega * q_rate - omega * omega * radius))}};
}

Model<2> DiskOnRotatingTrack::model() const {
  const double pull = mass * spin * spin * start;
  return {.name = "disk-on-rotating-track",
          .notes = "mex116",
          .reference = "closed form: q = q0 cosh(omega t/sqrt(1 + c))",
          .t_end = 3.0 / spin,
          .length = start,
          .force = pull,
          .energy = pull * start,
          .scene =
              [*this] {
                DiskOnTrack built = scene();
                const auto jacobi = [centre = built.centre, wheel = built.wheel, m = mass,
                                     I = inertia_ratio * mass * radius * radius,
                                     omega = spin](const Sample<2>& sample) {
                  const Vec<2> r = sample.position(centre), v = sample.velocity(centre);
                  const double angular_momentum =
                      m * (r.x() * v.y() - r.y() * v.x()) + I * sample.angular_velocity(wheel);
                  return sample.energy() - omega * angular_momentum;
                };
                Observed<2> seen = observed(std::move(built));
                seen.conserved = jacobi;
                return seen;
              },
          .observations = [*this](std::span<const double> times) { return at_each<2>(*this, times); }};
}

}  // namespace dalembert::models
