#include <dalembert/dalembert.h>
#include <dalembert/tests/both_steppers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

/// What rests, to round-off, without a force: then there is no length, speed or force to compare round-off
/// with.
namespace dalembert::at_rest_test {
namespace {

class AtRest : public testing::TestWithParam<StepperAt> {
 protected:
  [[nodiscard]] static Options options(double t_end) {
    return {.t_end = t_end, .samples = 5, .tolerance = GetParam().tolerance, .stepper = GetParam().stepper};
  }
  /// Of a motion of a few dozen steps.
  [[nodiscard]] static double error() { return 100.0 * GetParam().tolerance; }
};
INSTANTIATE_TEST_SUITE_P(Runs, AtRest, both_steppers_at({1e-5, 1e-8, 1e-11}), tolerance_name);

TEST_P(AtRest, ALoneParticleIsMovedByAForceThatSwitchesOn) {
  for (const double x : {0.0, 1e-3, 1.0, 100.0}) {
    Scene<2> scene;
    const auto body = scene.add_particle({.mass = 1.0, .position = {x, 0.0}}, "body");
    scene.add(force_law(points(body),
                        [](auto t, auto, auto) { return vec(t > 2.0 ? 1.0 + 0.0 * t : 0.0 * t, 0.0 * t); }));
    EXPECT_NEAR(simulate(scene, options(4.0)).position(body, 4).x(), x + 2.0, error()) << x;
  }
}

/// Friction holds it wherever it lies, until a push of F > mu m g.
TEST_P(AtRest, ALoneBlockOnARoughTableIsPushed) {
  constexpr double g = 10.0, mu = 0.05, F = 3.0, a = F - mu * g, on = 2.0;
  for (const double x : {0.0, 1e-9, -3e-5, 1.0})
    for (const bool one_sided : {false, true}) {
      Scene<2> scene;
      scene.add(UniformGravity<2>{{0.0, -g}});
      const auto block = scene.add_particle({.mass = 1.0, .position = {x, 0.0}}, "block");
      const OnCurve table{block, Plane<2>{}};
      const Slip slip{block, Plane<2>{}};
      if (one_sided) {
        scene.add(coulomb(scene.add(unilateral(table), "table"), slip, mu), "friction");
      } else {
        scene.add(coulomb(scene.add(table, "table"), slip, mu), "friction");
      }
      scene.add(force_law(points(block),
                          [](auto t, auto, auto) { return vec(t > on ? F + 0.0 * t : 0.0 * t, 0.0 * t); }));
      EXPECT_NEAR(simulate(scene, options(on + 2.0)).position(block, 4).x(), x + 2.0 * a, error()) << x;
    }
}

/// Its path leads through lengths of which no square is a number.
TEST_P(AtRest, ALoneParticleIsMovedByAForceThatSetsInGently) {
  Scene<2> scene;
  const auto body = scene.add_particle({.mass = 1.0}, "body");
  scene.add(force_law(
      points(body), [](auto t, auto, auto) { return vec(1.0 / (1.0 + exp(-100.0 * (t - 5.0))), 0.0 * t); }));
  // f = 1/(1 + exp(-(t - 5)/w)) integrated twice is (t - 5)^2/2 + (pi w)^2/6 there, up to exp(-(t - 5)/w).
  constexpr double w = 0.01, rest = 2.0;
  EXPECT_NEAR(simulate(scene, options(5.0 + rest)).position(body, 4).x(),
              0.5 * rest * rest + std::pow(std::numbers::pi * w, 2) / 6.0, error());
}

/// 0.1 + 0.2 is not 0.3: the anchor and the particle are 6e-17 apart.
TEST_P(AtRest, AParticleStaysAtItsAnchorButForRoundOff) {
  Scene<2> scene;
  const auto body = scene.add_particle({.mass = 1.0, .position = {0.1 + 0.2, 0.0}}, "body");
  scene.add(Spring{Fixed<2>{{0.3, 0.0}}, body, 4.0});
  EXPECT_NEAR(simulate(scene, options(3.0)).position(body, 4).x(), 0.3, error());
}

/// Of a brake the pad alone is a particle, and it is held: what it does is round-off, whatever presses it and
/// whatever the unit of length.
TEST_P(AtRest, AHeldPadGivesNoLength) {
  constexpr double a = 1.5, w_0 = 3.0;  // the deceleration mu F R / I
  for (const double unit : {1.0, 1e3, 1e6}) {
    Scene<2> scene;
    const double F = unit, R = 0.2 * unit, mu = 0.4;
    const auto pad = scene.add_particle({.mass = 1.0}, "pad");
    const auto face = scene.add(OnCurve{pad, Plane<2>{}}, "face");
    scene.add(OnCurve{pad, Plane<2>{.normal = {1.0, 0.0}}}, "guide");
    scene.add(UniformGravity<2>{{0.0, -F}});
    const auto disc = scene.add_rotor({.inertia = mu * F * R / a, .angular_velocity = w_0}, "disc");
    scene.add(coulomb(face, nonholonomic(points(disc), [R](auto, auto w) { return R * w[0]; }), mu), "brake");
    scene.add(unilateral(holonomic(points(disc), [R](auto phi) { return R * (1.0 - phi[0]); }),
                         {.restitution = 0.5}),
              "stop");
    const auto run = simulate(scene, options(2.0));
    // At the stop: w_0 t - a t^2/2 = 1, and back with half the speed.
    const double struck = (w_0 - std::sqrt(w_0 * w_0 - 2.0 * a)) / a, w = 0.5 * (w_0 - a * struck);
    ASSERT_EQ(run.events().size(), 2U) << unit;
    EXPECT_EQ(run.events()[0].kind, EventKind::struck);
    EXPECT_NEAR(run.events()[0].time, struck, error());
    EXPECT_EQ(run.events()[1].kind, EventKind::sticks);
    EXPECT_NEAR(run.events()[1].time, struck + w / a, error());
    EXPECT_NEAR(run.angle(disc, 4), 1.0 - 0.5 * w * w / a, error());
  }
}

/// A row of balls, seen from above.
std::vector<Particle<2>> add_row(Scene<2>& scene, double x, int count) {
  constexpr double diameter = 0.1;
  std::vector<Particle<2>> row;
  for (int i = 0; i < count; ++i) {
    row.push_back(scene.add_particle({.mass = 1.0, .position = {x + i * diameter, 0.0}}));
    if (i > 0)
      scene.add(unilateral(Distance{row[row.size() - 2], row.back(), diameter}, {.restitution = 1.0}));
  }
  return row;
}

TEST_P(AtRest, BallsThatTouchStayAsTheyAre) {
  for (const int count : {4, 8}) {
    Scene<2> scene;
    add_row(scene, 0.0, count);
    const auto run = simulate(scene, options(0.3));
    EXPECT_TRUE(run.events().empty()) << count;
  }
}

/// By Moreau's law the gap that was struck opens as fast as it closed, and the others, of rate 0, stay
/// closed: the ball goes back with v (1 - n)/(n + 1), and the n of the row go on together with 2 v/(n + 1).
TEST_P(AtRest, ABallThatHitsARowSetsAllOfItInMotion) {
  constexpr double v = 2.0, gap = 0.4;
  for (const int n : {3, 5, 8}) {
    Scene<2> scene;
    const auto row = add_row(scene, 0.0, n);
    const auto ball = scene.add_particle({.mass = 1.0, .position = {-gap - 0.1, 0.0}, .velocity = {v, 0.0}});
    scene.add(unilateral(Distance{ball, row.front(), 0.1}, {.restitution = 1.0}));
    const auto run = simulate(scene, options(0.3));
    EXPECT_NEAR(run.events().front().time, gap / v, error()) << n;
    EXPECT_NEAR(run.velocity(row.back(), 4).x(), 2.0 * v / (n + 1), error()) << n;
    EXPECT_NEAR(run.velocity(ball, 4).x(), v * (1 - n) / (n + 1), error()) << n;
  }
}

TEST_P(AtRest, ACompliantConstraintWithoutLoadHasTheForce0) {
  Scene<2> scene;
  const auto body = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "body");
  scene.add(OnCurve{body, Plane<2>{}});
  const auto rod = scene.add(compliant(Distance{Fixed<2>{}, body, 1.0}, 1e-8), "rod");
  const auto run = simulate(scene, options(2.0));
  constexpr double rounding = 4e-16 / 1e-8;  // of the length over the compliance
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(run.multiplier(rod, k), 0.0, rounding);
}

/// The forces of rods at their natural lengths are round-off, of stiffness times length, and where they
/// cancel so is what they leave of an acceleration.
TEST(AtRestTest, WhatUnloadedRodsHoldBesideAGuideOrAPinStays) {
  constexpr double C = 1e-4, tolerance = 1e-8;
  for (int i = 0; i < 40; ++i)
    for (const auto& [pinned, stepper] : {std::pair{false, Stepper::erk},
                                          {false, Stepper::ida},
                                          {true, Stepper::erk},
                                          {true, Stepper::ida}}) {
      const double x = 0.01 * i - 0.9, y = 0.3;
      Scene<2> scene;
      const auto body = scene.add_particle({.mass = 1.0, .position = {x, y}}, "body");
      if (pinned) {
        scene.add(Coincident{Fixed<2>{{x, y}}, body}, "pin");
      } else {
        scene.add(holonomic(points(body), [x](auto r) { return r.x() - x; }), "guide");
      }
      for (const Vec<2>& foot : {Vec<2>{1.7, -0.4}, Vec<2>{-1.2, 1.9}})
        scene.add(compliant(Distance{Fixed<2>{foot}, body, std::hypot(x - foot.x(), y - foot.y())}, C));
      const auto run =
          simulate(scene, {.t_end = 0.01, .samples = 2, .tolerance = tolerance, .stepper = stepper});
      EXPECT_NEAR((run.position(body, 1) - run.position(body, 0)).norm(), 0.0, tolerance) << x << pinned;
    }
}

/// The same between two rods that are mirror images.
TEST(AtRestTest, AGuideBetweenUnloadedRodsContradictsNothing) {
  constexpr double C = 1e-4, x = -0.07, a = 0.88, h = 0.25;
  const double length = std::hypot(a, h);
  Scene<2> scene;
  const auto body = scene.add_particle({.mass = 1.0, .position = {x, h}}, "body");
  scene.add(compliant(Distance{Fixed<2>{{x - a, 0.0}}, body, length}, C), "left");
  scene.add(compliant(Distance{Fixed<2>{{x + a, 0.0}}, body, length}, C), "right");
  scene.add(holonomic(points(body), [](auto r) { return r.x() - x; }), "guide");
  const double omega = std::sqrt(2.0 / C) * h / length;
  EXPECT_NEAR(normal_modes(scene, equilibrium(scene)).frequency(0), omega, 1e-9 * omega);
  EXPECT_NO_THROW((void)simulate(scene, {.t_end = 1e-4, .samples = 2, .stepper = Stepper::erk}));
}

/// A spring and a compliant rod at their natural lengths exert round-off, in any direction, which friction
/// need not hold. Forces are that of a hundred roundings of a length at most.
TEST_P(AtRest, UnloadedSpringsMoveNoBlockOnARoughRail) {
  constexpr double k = 1e4, x = 0.2;
  for (int i = 0; i < 20; ++i) {
    const double y = 0.01 * i;
    Scene<2> scene;
    const auto block = scene.add_particle({.mass = 1.0, .position = {x, y}}, "block");
    const Plane<2> level{.point = {0.0, y}};
    const auto rail = scene.add(OnCurve{block, level}, "rail");
    const auto friction = scene.add(coulomb(rail, Slip{block, level}, 0.3, 0.4), "friction");
    scene.add(Spring{Fixed<2>{{0.3, 1.7}}, block, k, std::hypot(x - 0.3, y - 1.7)});
    const auto rod =
        scene.add(compliant(Distance{Fixed<2>{{-0.7, -1.1}}, block, std::hypot(x + 0.7, y + 1.1)}, 1.0 / k));
    const auto run = simulate(scene, options(1.0));
    EXPECT_TRUE(run.events().empty()) << y;
    EXPECT_EQ(run.position(block, 4), run.position(block, 0)) << y;
    constexpr double rounding = 100.0 * 2.3e-16 * k * 3.0;  // of the scene's length
    for (std::size_t n = 0; n < 5; ++n) {
      EXPECT_NEAR(run.multiplier(rail, n), 0.0, rounding) << y;
      EXPECT_NEAR(run.multiplier(friction, n), 0.0, rounding) << y;
      EXPECT_NEAR(run.multiplier(rod, n), 0.0, rounding) << y;
    }
  }
}

/// Round-off of a spring does not hold what a force beyond friction pulls: x'' = (F - mu m g)/m, beside a
/// spring across the rail whose force is as good as constant.
TEST_P(AtRest, ABlockBesideAStiffSpringSlidesUnderALoad) {
  constexpr double k = 1e4, g = 10.0, mu = 0.3, F = 3.001;
  Scene<2> scene;
  const auto block = scene.add_particle({.mass = 1.0, .position = {0.2, 0.1}}, "block");
  const Plane<2> level{.point = {0.0, 0.1}};
  const auto rail = scene.add(OnCurve{block, level}, "rail");
  scene.add(coulomb(rail, Slip{block, level}, mu), "friction");
  scene.add(UniformGravity<2>{{F, -g}});
  scene.add(
      force_law(points(block), [](auto, auto r, auto) { return vec(0.0 * r.x(), -k * (r.y() - 0.1)); }));
  EXPECT_NEAR(simulate(scene, options(2.0)).position(block, 4).x() - 0.2, 0.5 * (F - mu * g) * 4.0, error());
}

}  // namespace
}  // namespace dalembert::at_rest_test
