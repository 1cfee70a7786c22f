#include "dalembert/models/cone.h"

#include <dalembert/models/cone_equations.h>
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
  const ConeEquations<Real> equations(*this);
  const auto start = equations.start();
  std::vector<Observation<3>> seen;
  integrate(equations, State(start.begin(), start.end()), times,
            [&](const State& y) { seen.push_back(equations.observation(y)); });
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
