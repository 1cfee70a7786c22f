#include "dalembert/models/particle_off_sphere.h"

#include <dalembert/models/event_times.h>

#include <boost/math/quadrature/tanh_sinh.hpp>

#include <cmath>

namespace dalembert::models {

ParticleOffSphere::Built ParticleOffSphere::scene() const {
  Scene<2> scene("particle-off-sphere");
  scene.add(UniformGravity<2>{{0.0, -gravity}});
  const auto particle = scene.add_particle(
      {.mass = mass, .position = radius * Vec<2>(std::sin(angle), std::cos(angle))}, "particle");
  const auto sphere = scene.add(unilateral(OnSurface{particle, Sphere<2>{.radius = radius}}), "sphere");
  const auto floor =
      scene.add(unilateral(holonomic(points(particle), [R = radius](auto r) { return r.y() + R; })), "floor");
  return {.scene = std::move(scene), .particle = particle, .sphere = sphere, .floor = floor};
}

double ParticleOffSphere::leaving_angle() const { return std::acos(2.0 / 3.0 * std::cos(angle)); }

double ParticleOffSphere::leaving_time() const {
  boost::math::quadrature::tanh_sinh<double> integrator;
  const double p = gravity / radius;
  return integrator.integrate(
      [&](double w) {
        const double cosine = std::cos(angle) - w * w / (2.0 * p);
        return 1.0 / (p * std::sqrt(1.0 - cosine * cosine));
      },
      0.0, std::sqrt(p * std::cos(leaving_angle())));
}

double ParticleOffSphere::falling_time() const {
  const double c = std::cos(leaving_angle()), s = std::sin(leaving_angle());
  const double down = std::sqrt(gravity * radius * c) * s;
  return (std::sqrt(down * down + 2.0 * gravity * radius * (1.0 + c)) - down) / gravity;
}

Vec<2> ParticleOffSphere::landing_place() const {
  return {radius * std::sin(leaving_angle()) + landing_velocity().x() * falling_time(), -radius};
}

Vec<2> ParticleOffSphere::landing_velocity() const {
  const double c = std::cos(leaving_angle()), s = std::sin(leaving_angle());
  const double v = std::sqrt(gravity * radius * c);
  return {v * c, -v * s - gravity * falling_time()};
}

EventModel ParticleOffSphere::event_model() const {
  return {.name = "particle-off-sphere", .notes = "", .events = [*this](const EventRun& how) {
            const double leaves = leaving_time(), lands = leaves + falling_time();
            const Built built = scene();
            const auto run = how.run(built.scene, {.t_end = 1.1 * lands, .samples = 2});
            const double limit = time_limit(how.tolerance);
            return std::vector<Timed>{
                {"leaves the sphere", time_of(run, built.sphere, EventKind::opened), leaves, limit},
                {"lands", time_of(run, built.floor, EventKind::struck), lands, limit}};
          }};
}

}  // namespace dalembert::models
