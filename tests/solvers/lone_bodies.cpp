#include <dalembert/tests/solvers/with_events.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dalembert::lone_bodies_test {
namespace {

/// One particle and what it touches: the scene has no length but that of its path.
class LoneBodies : public WithEvents {};
INSTANTIATE_TEST_SUITE_P(Runs, LoneBodies, at_usual_tolerance, tolerance_name);

TEST_P(LoneBodies, BounceInTheScaleOfTheirHeight) {
  // However long the run: without the floor it would lead a million times as far.
  constexpr int impacts = 1000;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto ball = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}});
  scene.add(unilateral(OnCurve{ball, Plane<2>{}}, {.restitution = 1.0}));
  const double fall = std::sqrt(2.0 / g);
  const auto run = simulate(scene, options(2.0 * impacts * fall));
  EXPECT_LE(run.statistics().length, 1.0 + bound);
  ASSERT_EQ(run.events().size(), std::size_t{impacts});
  // A flight errs by the tolerance in height and in speed: in energy, of g 1 m, by 3 of them at most.
  for (std::size_t i = 0; i < run.size(); ++i)
    EXPECT_NEAR(run.energy(i), g, 3.0 * impacts * tolerance * g) << i;
}

TEST_P(LoneBodies, LeaveASphereFromWhereTheyStart) {
  // Hardly faster than gravity holds: the gap opens as t^2, less than a step errs by at first.
  for (const double looser : {1e-4, 1e-6, 1e-10}) {
    Scene<3> scene;
    scene.add(UniformGravity<3>{{0.0, 0.0, -7.52}});
    const Vec<3> r(0.0187133, -0.374519, 0.378247), v(-1.26777, -0.885417, -0.813967);
    const auto body = scene.add_particle({.mass = 1.0, .position = r, .velocity = v});
    scene.add(unilateral(OnSurface{body, Sphere<3>{.radius = r.norm()}}));
    const auto run = simulate(
        scene, {.t_end = 1.0, .samples = 2, .tolerance = looser, .stepper = GetParam(), .max_steps = 1000});
    const Vec<3> n = r.normalized(), left = v - std::min(0.0, n.dot(v)) * n;
    const Vec<3> due = r + left - 0.5 * 7.52 * Vec<3>::UnitZ();
    EXPECT_LE((run.position(body, 1) - due).norm(), 100.0 * looser) << looser;
  }
}

TEST_P(LoneBodies, StickWhereTheyStartFarFromTheOrigin) {
  for (const double slope : {-0.4375, -0.1755, 0.1122, 0.1755, 0.3742, 0.5281, 0.5927}) {
    for (const double at : {-1.126, -0.5817, -0.1674, 0.721, 1.46, 1.971, 1e3}) {
      Scene<2> scene;
      scene.add(UniformGravity<2>{{0.0, -g}});
      const Vec<2> r = at * Vec<2>(1.0, slope).normalized();
      const Plane<2> plane{{0.0, 0.0}, Vec<2>(-slope, 1.0).normalized()};
      const auto block = scene.add_particle({.mass = 1.0, .position = r});
      const auto floor = scene.add(OnCurve{block, plane});
      const auto rough = scene.add(coulomb(floor, Slip{block, plane}, 1.0));
      const auto run = simulate(scene, options(1.0));
      EXPECT_TRUE(run.events().empty());
      // Round-off of the plane's equation, some of |r|.
      EXPECT_LE((run.position(block, 10) - r).norm(), 1e-14 * std::abs(at)) << slope << ' ' << at;
      EXPECT_NEAR(std::abs(run.multiplier(rough, 10)), g * std::abs(slope) / std::hypot(1.0, slope),
                  bound * g);
    }
  }
}

/// A start at a wall has no way to the nearest contact; its first steps advance the time.
TEST_P(LoneBodies, GoOnFromAnImpactBetweenTwoWalls) {
  for (const double v : {0.7, 1.9, 2.6}) {
    Scene<2> scene;
    const auto ball = scene.add_particle({.mass = 1.0, .position = {0.3, 0.0}, .velocity = {v, 0.0}});
    scene.add(OnCurve{ball, Plane<2>{}});
    for (const double wall : {0.0, 1.0})
      scene.add(
          unilateral(OnCurve{ball, Plane<2>{{wall, 0.0}, {1.0 - 2.0 * wall, 0.0}}}, {.restitution = 1.0}));
    const auto run = simulate(scene, options(2.0));
    for (const auto& from : {run.event_sample(0), run.sample_after(0)}) {
      const auto rest = simulate(scene, from, options(2.0));
      EXPECT_NEAR((rest.position(ball, 10) - run.position(ball, 10)).norm(), 0.0, bound) << v;
    }
  }
}

/// A disc of radius R spins in a corner, mu on both walls: N_1 = m g/(1 + mu^2) on the floor, mu N_1 on the
/// wall, and so M = mu (1 + mu) m g R/(1 + mu^2). Its centre is held; how long the run is does not matter.
TEST_P(LoneBodies, SpinInACornerHoweverLongTheRun) {
  constexpr double m = 4.0, R = 0.15, mu = 0.2, w = 50.0, inertia = 0.5 * m * R * R;
  const double slows = mu * (1.0 + mu) / (1.0 + mu * mu) * m * g * R / inertia;
  for (const double t_end : {2.0, 20.0, 200.0}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto centre = scene.add_particle({.mass = m, .position = {R, R}});
    const auto spin = scene.add_rotor({.inertia = inertia, .angular_velocity = w});
    const auto floor = scene.add(OnCurve{centre, Plane<2>{{0.0, R}, {0.0, 1.0}}}),
               wall = scene.add(OnCurve{centre, Plane<2>{{R, 0.0}, {1.0, 0.0}}});
    scene.add(coulomb(
        floor,
        nonholonomic(points(centre, spin), [](auto, auto, auto v, auto rate) { return v.x() + R * rate[0]; }),
        mu));
    scene.add(coulomb(
        wall,
        nonholonomic(points(centre, spin), [](auto, auto, auto v, auto rate) { return v.y() - R * rate[0]; }),
        mu));
    const auto run = simulate(scene, options(t_end));
    ASSERT_EQ(run.events().size(), 2U) << t_end;
    EXPECT_NEAR(run.events()[0].time, w / slows, bound) << t_end;
    EXPECT_NEAR(run.angle(spin, 10), 0.5 * w * w / slows, bound * w) << t_end;
  }
}

/// The wall of that corner is smooth: mu m g R alone slows it.
TEST_P(LoneBodies, SpinInACornerWithASmoothWall) {
  constexpr double m = 4.0, R = 0.15, mu = 0.2, w = 50.0, slows = mu * g / (0.5 * R);
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto centre = scene.add_particle({.mass = m, .position = {R, R}});
  const auto spin = scene.add_rotor({.inertia = 0.5 * m * R * R, .angular_velocity = w});
  const auto floor = scene.add(OnCurve{centre, Plane<2>{{0.0, R}, {0.0, 1.0}}}),
             wall = scene.add(OnCurve{centre, Plane<2>{{R, 0.0}, {1.0, 0.0}}});
  scene.add(coulomb(
      floor,
      nonholonomic(points(centre, spin), [](auto, auto, auto v, auto rate) { return v.x() + R * rate[0]; }),
      mu));
  scene.add(coulomb(
      wall,
      nonholonomic(points(centre, spin), [](auto, auto, auto v, auto rate) { return v.y() - R * rate[0]; }),
      0.0));
  const auto run = simulate(scene, options(3.0));
  ASSERT_EQ(run.events().size(), 1U);
  EXPECT_EQ(run.events()[0].kind, EventKind::sticks);
  EXPECT_NEAR(run.events()[0].time, w / slows, bound);
}

/// By m g t: where that has grown to the weight both are round-off of each other, however far the origin is.
TEST_P(LoneBodies, AreLiftedFarFromTheOrigin) {
  for (const double x : {0.0, 7.3, 812.4}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto block = scene.add_particle({.mass = 1.3, .position = {x, 2.0 * x}});
    scene.add(unilateral(OnCurve{block, Plane<2>{{x, 2.0 * x}}}));
    scene.add(force_law(points(block), [](auto t, auto, auto) { return vec(0.0 * t, 1.3 * g * t); }));
    const auto run = simulate(scene, options(2.0));
    ASSERT_EQ(run.events().size(), 1U) << x;
    EXPECT_NEAR(run.events()[0].time, 1.0, bound) << x;
    EXPECT_NEAR(run.position(block, 10).y(), 2.0 * x + g / 6.0, error_of(run)) << x;
  }
}

TEST_P(LoneBodies, MayEndTheirRunWhereTheyTurn) {
  // x'' = -x -+ f: from 1 it turns at -(1 - 2 f) after pi, and so on. Near to that, too, the steps before and
  // after are what they usually are.
  constexpr double f = 0.05;
  for (const int turn : {1, 2, 3}) {
    for (const double off : {-1e-8, -1e-10, -1e-11, -1e-12, 0.0, 1e-12, 1e-11, 1e-10, 1e-8}) {
      Scene<2> scene;
      scene.add(UniformGravity<2>{{0.0, -g}});
      const auto block = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
      const auto table = scene.add(OnCurve{block, Plane<2>{}});
      scene.add(coulomb(table, Slip{block, Plane<2>{}}, f / g));
      scene.add(potential(points(block), [](auto r) { return 0.5 * r.x() * r.x(); }));
      const auto run = simulate(scene, options(turn * std::numbers::pi * (1.0 + off)));
      const double due = (turn % 2 == 0 ? 1.0 : -1.0) * (1.0 - 2.0 * f * turn);
      EXPECT_NEAR(run.position(block, 10).x(), due, bound) << turn << ' ' << off;
    }
  }
}

TEST_P(LoneBodies, SlideOnASphereInItsScales) {
  // Sent off from the side, with no length but that of the sphere.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const double angle = 0.5;
  const Vec<2> out(std::sin(angle), std::cos(angle)), along(std::cos(angle), -std::sin(angle));
  const auto puck = scene.add_particle({.mass = 1.0, .position = out, .velocity = 0.4 * along});
  const Sphere<2> sphere{};
  const auto touch = scene.add(unilateral(OnCurve{puck, sphere}));
  scene.add(coulomb(touch, Slip{puck, sphere}, 0.0));
  const auto run = simulate(scene, options(0.6));
  ASSERT_EQ(run.events().size(), 1U);
  // v^2 = g cos where v^2 = v0^2 + 2 g (cos 0.5 - cos).
  EXPECT_NEAR(run.event_sample(0).position(puck).y(), (0.16 + 2.0 * g * std::cos(angle)) / (3.0 * g), bound);
}

}  // namespace
}  // namespace dalembert::lone_bodies_test
