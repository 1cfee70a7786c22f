#include "dalembert/tests/extremes/cases/stiff_scenes.h"
#include <dalembert/models/governor.h>
#include <dalembert/models/minimal_ode.h>
#include <dalembert/models/plane_pendulum.h>
#include <dalembert/tests/extremes/cases/bounds.h>

#include <numbers>

namespace dalembert::extremes {

namespace {

using models::Model;
using models::Observation;
using models::Observed;
using models::Real;
using models::State;

/// Where a planar pendulum's bob is.
Vec<2> at_angle(Real r, Real phi) {
  return {static_cast<double>(r * std::sin(phi)), static_cast<double>(-r * std::cos(phi))};
}

/// A planar scene in which one particle is observed.
Observed<2> watched(Scene<2> scene, Particle<2> particle) {
  return {std::move(scene), [particle](const Sample<2>& sample) {
            return Observation<2>{.positions = {sample.position(particle)}, .forces = {}};
          }};
}

using Observations = std::function<std::vector<Observation<2>>(std::span<const double>)>;

Model<2> planar(double length, std::function<Observed<2>()> scene, Observations observations) {
  return {.name = "",
          .notes = "",
          .reference = "",
          .t_end = 0.0,
          .length = length,
          .force = 1.0,
          .energy = 1.0,
          .scene = std::move(scene),
          .observations = std::move(observations)};
}

Scene<2> spring_scene() {
  Scene<2> built("spring-pendulum");
  built.add(UniformGravity<2>{{0.0, -g}});
  return built;
}

/// A bob on a spring, with its tension.
Observations on_spring(double k) {
  return [k](std::span<const double> times) {
    std::vector<Observation<2>> seen;
    const auto equations = [k](const State& y, State& rate) {  // y = (r, r', phi, phi')
      rate = {y[1], y[0] * y[3] * y[3] + Real(g) * std::cos(y[2]) - k * (y[0] - 1), y[3],
              -(Real(g) * std::sin(y[2]) + 2 * y[1] * y[3]) / y[0]};
    };
    models::integrate(equations, State{1, 0, std::numbers::pi_v<Real> / 2, 0}, times, [&](const State& y) {
      seen.push_back({.positions = {at_angle(y[0], y[2])}, .forces = {static_cast<double>(k * (y[0] - 1))}});
    });
    return seen;
  };
}

Observations on_rod() {
  return [](std::span<const double> times) { return models::at_each<2>(models::PlanePendulum{}, times); };
}

Observations without_forces(Observations observations) {
  return [all = std::move(observations)](std::span<const double> times) {
    auto seen = all(times);
    for (Observation<2>& at : seen) at.forces.clear();
    return seen;
  };
}

}  // namespace

Model<2> SpringPendulum::as_force(bool with_rigid) const {
  const auto scene = [k = stiffness] {
    Scene<2> built = spring_scene();
    const auto bob = built.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
    built.add(Spring{Fixed<2>{}, bob, k, 1.0});
    return watched(std::move(built), bob);
  };
  return planar(1.0, scene, without_forces(with_rigid ? on_rod() : on_spring(stiffness)));
}

Model<2> SpringPendulum::as_constraint(bool with_rigid) const {
  const auto scene = [k = stiffness] {
    Scene<2> built = spring_scene();
    const auto bob = built.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
    const auto rod = built.add(compliant(Distance{Fixed<2>{}, bob, 1.0}, 1.0 / k));
    return Observed<2>{std::move(built), [bob, rod](const Sample<2>& sample) {
                         return Observation<2>{.positions = {sample.position(bob)},
                                               .forces = {-sample.multiplier(rod)}};
                       }};
  };
  Model<2> model = planar(1.0, scene, with_rigid ? on_rod() : on_spring(stiffness));
  model.force = g;  // its weight
  return model;
}

double CreepingPendulum::error_of_reference() const { return creeps() ? 3.0 * g / (drag * drag) : 0.0; }

Model<2> CreepingPendulum::model() const {
  const auto scene = [c = drag] {
    Scene<2> built("creeping-pendulum");
    built.add(UniformGravity<2>{{0.0, -g}});
    const auto bob = built.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
    built.add(Distance{Fixed<2>{}, bob, 1.0});
    built.add(LinearDrag{bob, c});
    return watched(std::move(built), bob);
  };
  const auto inert = [c = drag](std::span<const double> times) {
    std::vector<Observation<2>> seen;
    const auto equations = [c](const State& y, State& rate) {
      rate = {y[1], -Real(g) * std::sin(y[0]) - c * y[1]};
    };
    models::integrate(equations, State{std::numbers::pi_v<Real> / 2, 0}, times, [&](const State& y) {
      seen.push_back({.positions = {at_angle(1, y[0])}, .forces = {}});
    });
    return seen;
  };
  const auto creeping = [c = drag](std::span<const double> times) {
    std::vector<Observation<2>> seen;
    for (const double t : times)
      seen.push_back({.positions = {at_angle(1, 2 * std::atan(std::exp(-Real(g) * t / c)))}, .forces = {}});
    return seen;
  };
  if (creeps()) return planar(1.0, scene, creeping);
  return planar(1.0, scene, inert);
}

Model<2> DampedPair::model() const {
  const auto scene = [c = damping] {
    Scene<2> built("damped-pair");
    const auto a = built.add_particle({.mass = 1.0, .position = {-1.0, 0.0}});
    const auto b = built.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
    for (const auto& bead : {a, b}) built.add(OnCurve{bead, Plane<2>{}});
    built.add(Spring{a, b, 1.0, 1.0});
    built.add(Damper{a, b, c});
    return watched(std::move(built), b);
  };
  return planar(2.0, scene, [c = Real(damping)](std::span<const double> times) {
    const Real p = c + std::sqrt(c * c - 2), s = 2 / p;
    std::vector<Observation<2>> seen;
    for (const double t : times) {
      const Real u = (p * std::exp(-s * t) - s * std::exp(-p * t)) / (p - s);
      seen.push_back({.positions = {Vec<2>(static_cast<double>((1 + u) / 2), 0.0)}, .forces = {}});
    }
    return seen;
  });
}

Model<3> SprungGovernor::model() const {
  const models::Governor governor{};
  const double c = 2.0 * std::sqrt(stiffness * governor.sleeve_mass);
  Model<3> model = governor.model();
  model.scene = [=, k = stiffness] {
    models::Governor::Built built = governor.scene();
    const Particle<3> sleeve = built.parts.sleeve;
    const Fixed<3> below{{0.0, 0.0, -4.0 * governor.length}};
    const double relaxed = 4.0 * governor.length - 2.0 * governor.length * std::cos(governor.angle);
    built.scene.add(Spring{below, sleeve, k, relaxed});
    built.scene.add(Damper{below, sleeve, c});
    return Observed<3>{std::move(built.scene),
                       [sleeve](const Sample<3>& sample) {
                         return Observation<3>{.positions = {sample.position(sleeve)}, .forces = {}};
                       },
                       {}};
  };
  model.observations = [=, k = stiffness](std::span<const double> times) {
    const Real m1 = governor.mass, m2 = governor.sleeve_mass, L = governor.length, spin = governor.spin;
    const Real z0 = -2 * L * std::cos(Real(governor.angle));
    const auto equations = [=](const State& y, State& rate) {
      const Real sine = std::sin(y[0]), cosine = std::cos(y[0]);
      const Real F = -k * (-2 * L * cosine - z0) - c * 2 * L * sine * y[1];
      const Real forces =
          cosine * L * (m1 * spin * spin - 2 * m2 * y[1] * y[1]) - (m1 + m2) * governor.gravity;
      rate = {y[1], sine * (forces + F) / (L * (m1 + 2 * m2 * sine * sine))};
    };
    std::vector<Observation<3>> seen;
    models::integrate(equations, State{Real(governor.angle), 0}, times, [&](const State& y) {
      seen.push_back(
          {.positions = {Vec<3>(0.0, 0.0, static_cast<double>(-2 * L * std::cos(y[0])))}, .forces = {}});
    });
    return seen;
  };
  return model;
}

Model<2> SprungPivot::model() const {
  const double k = stiffness, c = 2.0 * std::sqrt(stiffness);
  const auto scene = [k, c] {
    Scene<2> built("sprung-pivot");
    built.add(UniformGravity<2>{{0.0, -g}});
    const auto block = built.add_particle({.mass = 1.0});
    const auto bob = built.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
    built.add(OnCurve{block, Plane<2>{.normal = Vec<2>::UnitX()}});
    built.add(Distance{block, bob, 1.0});
    const Fixed<2> above{{0.0, 2.0}};
    built.add(Spring{above, block, k, 2.0});
    built.add(Damper{above, block, c});
    return watched(std::move(built), bob);
  };
  return planar(1.0, scene, [k, c](std::span<const double> times) {
    const auto equations = [k, c](const State& y, State& rate) {  // y = (height, height', phi, phi')
      const Real sine = std::sin(y[2]), F = -k * y[0] - c * y[1] - 2 * Real(g);
      const Real up = (F - y[3] * y[3] * std::cos(y[2]) + Real(g) * sine * sine) / (2 - sine * sine);
      rate = {y[1], up, y[3], -(up + Real(g)) * sine};
    };
    std::vector<Observation<2>> seen;
    models::integrate(equations, State{0, 0, std::numbers::pi_v<Real> / 2, 0}, times, [&](const State& y) {
      const Vec<2> block(0.0, static_cast<double>(y[0]));
      seen.push_back({.positions = {block + at_angle(1, y[2])}, .forces = {}});
    });
    return seen;
  });
}

}  // namespace dalembert::extremes
