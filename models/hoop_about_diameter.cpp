#include "dalembert/models/hoop_about_diameter.h"

#include <dalembert/models/minimal_ode.h>

#include <array>
#include <cmath>
#include <utility>

namespace dalembert::models {

namespace {

Observation<3> observation(const HoopAboutDiameter& p, const State& y) {  // y = (phi, phi', t)
  const Real phi = y[0], rate = y[1], turned = p.spin * y[2], R = p.radius, Omega = p.spin;
  const Real sine = std::sin(phi), cosine = std::cos(phi);
  const VecOf<Real, 3> position = R * vec(sine * std::cos(turned), sine * std::sin(turned), -cosine);
  const Real inwards = p.mass * (R * (rate * rate + Omega * Omega * sine * sine) + p.gravity * cosine);
  const Real sideways = 2 * p.mass * R * Omega * rate * cosine;
  return {.positions = {position.cast<double>()},
          .forces = {static_cast<double>(inwards), static_cast<double>(sideways)}};
}

Observed<3> observed(BeadOnHoop built, double mass, double spin) {
  return {std::move(built.scene),
          [bead = built.bead, sphere = built.sphere, plane = built.plane](const Sample<3>& sample) {
            return Observation<3>{.positions = {sample.position(bead)},
                                  .forces = {-sample.multiplier(sphere), sample.multiplier(plane)}};
          },
          [bead = built.bead, mass, spin](const Sample<3>& sample) {
            return sample.energy() - spin * mass * sample.position(bead).cross(sample.velocity(bead)).z();
          }};
}

}  // namespace

double HoopAboutDiameter::equilibrium() const {
  const double cosine = gravity / (radius * spin * spin);
  return cosine < 1.0 ? std::acos(cosine) : 0.0;
}

BeadOnHoop HoopAboutDiameter::scene() const {
  BeadOnHoop built{.scene = Scene<3>("hoop-about-diameter"), .bead = {}, .sphere = {}, .plane = {}};
  built.scene.add(UniformGravity<3>{{0.0, 0.0, -gravity}});
  const double outwards = radius * std::sin(angle);
  built.bead = built.scene.add_particle({.mass = mass,
                                         .position = {outwards, 0.0, -radius * std::cos(angle)},
                                         .velocity = {0.0, spin * outwards, 0.0}});
  built.sphere = built.scene.add(OnSurface{built.bead, Sphere<3>{.radius = radius}});
  built.plane =
      built.scene.add(RotatingPlane{built.bead, Axis{}, [Omega = spin](const auto& t) { return Omega * t; }});
  return built;
}

std::vector<Observation<3>> HoopAboutDiameter::reference(std::span<const double> times) const {
  const Real Omega = spin, pull = gravity / Real(radius);
  const auto equations = [&](const State& y, State& y_rate) {
    y_rate[0] = y[1];
    y_rate[1] = std::sin(y[0]) * (Omega * Omega * std::cos(y[0]) - pull);
    y_rate[2] = 1;
  };
  std::vector<Observation<3>> seen;
  integrate(equations, State{angle, 0, 0}, times,
            [&](const State& y) { seen.push_back(observation(*this, y)); });
  return seen;
}

Observation<3> HoopAboutDiameter::reference(double t) const { return reference(std::array{t}).front(); }

Model<3> HoopAboutDiameter::model() const {
  return {.name = "hoop-about-diameter",
          .notes = "mex39",
          .reference = "equation of motion of the angle in extended precision, forces by Newton's law",
          .t_end = 10.0,
          .length = radius,
          .force = mass * gravity,
          .energy = mass * gravity * radius,
          .scene = [*this] { return observed(scene(), mass, spin); },
          .observations = [*this](std::span<const double> times) { return reference(times); }};
}

}  // namespace dalembert::models
