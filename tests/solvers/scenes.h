#pragma once

#include <dalembert/dalembert.h>

/// Small scenes that several tests run.
namespace dalembert {

/// A bob of 1 kg on a rod, released from horizontal. Every length, time and mass is measured in the
/// given units, so that the scene is the same scene in any of them.
struct Pendulum {
  double length_unit = 1.0, time_unit = 1.0, mass_unit = 1.0;
  Scene<2> scene{"pendulum"};
  Particle<2> bob =
      scene.add_particle({.mass = 1.0 * mass_unit, .position = {1.0 * length_unit, 0.0}}, "bob");
  Constraint<1> rod = scene.add(Distance{Fixed<2>{}, bob, 1.0 * length_unit}, "rod");

  explicit Pendulum(double length = 1.0, double time = 1.0, double mass = 1.0)
      : length_unit(length), time_unit(time), mass_unit(mass) {
    scene.add(UniformGravity<2>{{0.0, -9.81 * length / (time * time)}});
  }
};

/// One element of each kind, in motion: a chain of two rods from a driven point, a bead on a moving
/// curve, a skate, a pin; gravity, spring, damper, a potential and a force law.
struct EachKind {
  Scene<2> scene{"each kind"};
  Particle<2> upper = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "upper");
  Particle<2> lower = scene.add_particle({.mass = 1.0, .position = {1.0, -1.0}}, "lower");
  Particle<2> bead = scene.add_particle({.mass = 1.0, .position = {3.0, 0.0}}, "bead");
  Particle<2> rider = scene.add_particle({.mass = 0.5, .position = {3.0, 0.0}}, "rider");
  Particle<2> skate =
      scene.add_particle({.mass = 1.0, .position = {0.0, 2.0}, .velocity = {1.0, 0.0}}, "skate");
  Constraint<1> upper_rod;

  EachKind() {
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    upper_rod = scene.add(
        Distance{driven([](auto t) { return vec(0.1 - 0.1 * cos(3.0 * t), 0.0); }), upper, 1.0}, "upper rod");
    scene.add(Distance{upper, lower, 1.0}, "lower rod");
    scene.add(Coincident{bead, rider}, "pin");
    scene.add(
        OnCurve{bead, [](auto t, auto r) { return r.y() - 0.1 * (r.x() - 3.0) * r.x() - 0.05 * t * t; }},
        "wire");
    scene.add(nonholonomic(points(skate), [](auto r, auto v) { return v.y() - sin(r.x()) * v.x(); }),
              "blade");
    scene.add(Spring{lower, bead, 5.0, 1.0});
    scene.add(Damper{upper, bead, 0.3});
    scene.add(
        potential(points(skate), [](auto t, auto r) { return (1.0 + 0.1 * sin(t)) * r.squaredNorm(); }));
    scene.add(force_law(points(rider), [](auto, auto v) { return (-0.1 * v).eval(); }));
  }
};

}  // namespace dalembert
