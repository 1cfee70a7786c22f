#include "dalembert/models/cone.h"

#include <dalembert/models/minimal_ode.h>

#include <array>
#include <cmath>

namespace dalembert::models {

ParticleOnCone ConeSlide::scene() const {
  ParticleOnCone built{.scene = Scene<3>("cone"), .particle = {}, .wall = {}};
  built.scene.add(UniformGravity<3>{{0.0, 0.0, -gravity}});
  built.particle =
      built.scene.add_particle({.mass = mass,
                                .position = {start_radius, 0.0, start_radius / std::tan(half_angle)},
                                .velocity = {0.0, speed_ratio * std::sqrt(gravity * start_radius), 0.0}});
  built.wall = built.scene.add(OnSurface{built.particle, Cone{.half_angle = half_angle}});
  return built;
}

std::vector<Observation<3>> ConeSlide::reference(std::span<const double> times) const {
  const Real sine = std::sin(Real(half_angle)), cosine = std::cos(Real(half_angle));
  const Real h = start_radius * speed_ratio * std::sqrt(Real(gravity) * start_radius);
  const auto equations = [&](const State& y, State& y_rate) {  // y = (r, r', phi)
    const Real r = y[0];
    y_rate[0] = y[1];
    y_rate[1] = sine * sine * h * h / (r * r * r) - gravity * sine * cosine;
    y_rate[2] = h / (r * r);
  };
  std::vector<Observation<3>> seen;
  integrate(equations, State{start_radius, 0, 0}, times, [&](const State& y) {
    const Real r = y[0], phi = y[2];
    const Vec<3> position(static_cast<double>(r * std::cos(phi)), static_cast<double>(r * std::sin(phi)),
                          static_cast<double>(r * cosine / sine));
    const Real normal_force = mass * (gravity * sine + h * h / (r * r * r) * cosine);
    seen.push_back({.positions = {position}, .forces = {static_cast<double>(normal_force)}});
  });
  return seen;
}

Observation<3> ConeSlide::reference(double t) const { return reference(std::array{t}).front(); }

Model<3> ConeSlide::model() const {
  return {.name = "cone",
          .notes = "mex133, mex135, mln77",
          .reference = "radial equation of motion in extended precision, force by Newton's law",
          .t_end = 10.0,
          .length = start_radius,
          .force = mass * gravity,
          .energy = mass * gravity * start_radius,
          .scene =
              [*this] {
                ParticleOnCone built = scene();
                return Observed<3>{std::move(built.scene),
                                   [particle = built.particle, wall = built.wall](const Sample<3>& sample) {
                                     return Observation<3>{.positions = {sample.position(particle)},
                                                           .forces = {sample.multiplier(wall)}};
                                   }};
              },
          .observations = [*this](std::span<const double> times) { return reference(times); }};
}

}  // namespace dalembert::models
