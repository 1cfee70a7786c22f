#include "readings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dalembert::accelerations_test {
namespace {

/// On a circle of radius L the acceleration is -v^2 r/L^2 along the rod and the part of g across it.
TEST(Accelerations, PendulumHasThoseOfTheCircle) {
  for (const Stepper stepper : both) {
    const Pendulum pendulum;
    const auto run = simulate(pendulum.scene, {.t_end = 3.0, .stepper = stepper});
    for (const auto& now : run) {
      const Vec<2> r = now.position(pendulum.bob), v = now.velocity(pendulum.bob), g{0.0, -9.81};
      const Vec<2> expected = -v.squaredNorm() * r + g - g.dot(r) * r;
      EXPECT_LT((now.acceleration(pendulum.bob) - expected).norm(), round_off);
    }
  }
}

TEST(Accelerations, PointOfABodyHasThoseOfTheRotation) {
  for (const Stepper stepper : both) {
    const CompoundPendulum pendulum;
    const auto run = simulate(pendulum.scene, {.t_end = 2.0, .tolerance = 1e-10, .stepper = stepper});
    for (const auto& now : run) {
      const auto s = pendulum.at(now);
      const Vec<2> tip = 3.0 * CompoundPendulum::d * (s.rate * s.across - s.square * s.along);
      EXPECT_LT((now.acceleration(pendulum.tip) - tip).norm(), 3.0 * error_of(run));
      EXPECT_LT(now.acceleration(pendulum.pin).norm(), 10.0 * round_off);
    }
  }
}

/// phi'' = torque/inertia.
TEST(Accelerations, RotorHasItsTorqueOverItsInertia) {
  Scene<2> scene;
  const auto wheel = scene.add_rotor({.inertia = 0.5}, "wheel");
  const auto motor = scene.add(Torque{wheel, 3.0}, "motor");
  const auto run = simulate(scene, {.t_end = 1.0});
  for (std::size_t i = 0; i < run.size(); ++i) {
    EXPECT_DOUBLE_EQ(run.angular_acceleration(wheel, i), 6.0);
    EXPECT_DOUBLE_EQ(run.torque(motor, wheel, i), 3.0);
  }
}

/// Friction moves the accelerations: a block on a plane of slope alpha slides at g (sin - mu cos).
TEST(Accelerations, ContainFriction) {
  const double alpha = 0.6, mu = 0.3;
  Scene<2> scene;
  const auto block =
      scene.add_particle({.mass = 2.0, .velocity = {std::cos(alpha), -std::sin(alpha)}}, "block");
  const auto weight = scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto slope =
      scene.add(OnCurve{block, Plane<2>{{0.0, 0.0}, {std::sin(alpha), std::cos(alpha)}}}, "slope");
  const auto friction = scene.add(
      friction_law(slope, points(block),
                   [mu](auto lambda, auto, auto v) { return (-mu * lambda * v.normalized()).eval(); }),
      "friction");
  const double size = 9.81 * (std::sin(alpha) - mu * std::cos(alpha));
  for (const Stepper stepper : both) {
    for (const auto& now : simulate(scene, {.t_end = 1.0, .stepper = stepper})) {
      EXPECT_NEAR(now.acceleration(block).norm(), size, round_off);
      EXPECT_NEAR(now.force(friction, block).norm(), mu * 2.0 * 9.81 * std::cos(alpha), round_off);
      const Vec<2> all = now.force(weight, block) + now.force(friction, block) + now.constraint_force(block);
      EXPECT_LT((all - 2.0 * now.acceleration(block)).norm(), round_off);
    }
  }
}

/// Also where a constraint is compliant, from nearly rigid to a soft spring: its multiplier and the
/// accelerations satisfy Newton's law together.
TEST(Accelerations, ContainCompliantConstraints) {
  for (const Stepper stepper : both) {
    for (const double compliance : {1e-8, 1e-4, 1e-2, 1.0}) {
      Scene<2> scene;
      const auto weight = scene.add(UniformGravity<2>{{0.0, -9.81}});
      const auto bob = scene.add_particle({.mass = 2.0, .position = {1.0, 0.0}}, "bob");
      scene.add(compliant(Distance{Fixed<2>{}, bob, 1.0}, compliance), "yields");
      const auto run = simulate(scene, {.t_end = 1.0, .samples = 11, .stepper = stepper});
      for (const auto& now : run) {
        const Vec<2> all = now.constraint_force(bob) + now.force(weight, bob);
        EXPECT_LT((all - 2.0 * now.acceleration(bob)).norm(), round_off) << compliance;
      }
    }
  }
}

/// A parallelogram of massless rods, 1 m and 2 m, with 1 kg at either joint, passes the position in which all
/// are in line. There the rods' forces are not determined, but each joint moves like a pendulum. An
/// acceleration is that pendulum's, to the root of the tolerance as forces are, or cannot be read. (The way
/// there is that of a pendulum from there, backwards.)
TEST(Accelerations, CloseToASingularPositionAreRightOrCannotBeRead) {
  const double tolerance = 1e-8, way = 0.3, rate = 3.0;
  Scene<2> single;
  single.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = single.add_particle({.mass = 1.0, .position = {1.0, 0.0}, .velocity = {0.0, rate}});
  single.add(Distance{Fixed<2>{}, bob, 1.0});
  const auto back =
      simulate(single, {.t_end = way, .samples = 2, .tolerance = 1e-12, .stepper = Stepper::erk});
  const Vec<2> r = back.position(bob, 1), v = -back.velocity(bob, 1);

  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const Vec<2> pivot{2.0, 0.0};
  const auto a = scene.add_particle({.mass = 1.0, .position = r, .velocity = v}, "a");
  const auto b = scene.add_particle({.mass = 1.0, .position = r + pivot, .velocity = v}, "b");
  scene.add(Distance{Fixed<2>{}, a, 1.0});
  scene.add(Distance{Fixed<2>{pivot}, b, 1.0});
  scene.add(Distance{a, b, 2.0});
  const std::vector<double> off{-1e-2, -1e-3, -1e-4, -1e-5, -1e-6, 0.0, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2};
  std::vector<double> times;
  for (const double d : off) times.push_back(way + d);
  for (const Stepper stepper : both) {
    const auto run =
        simulate(scene, {.t_end = 1.0, .times = times, .tolerance = tolerance, .stepper = stepper});
    std::size_t readable = 0;
    for (const auto& now : run) {
      const Vec<2> q = now.position(a), u = now.velocity(a), g{0.0, -9.81};
      const Vec<2> expected = -u.squaredNorm() * q + g - g.dot(q) * q;
      try {
        EXPECT_LT((now.acceleration(a) - expected).norm(), std::sqrt(tolerance) * expected.norm())
            << now.time() - way;
        ++readable;
      } catch (const UndeterminedForce&) {
      }
    }
    EXPECT_GE(readable, 2U) << "10 ms away, where the rods are 0.03 from in line, at least";
  }
}

}  // namespace
}  // namespace dalembert::accelerations_test
