#include <dalembert/dalembert.h>
#include <dalembert/tests/both_steppers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// Slips that are slow, as what is known of speeds goes: where a run starts with one, comes to rest, or goes
/// on from the sample of an event; and what a brake's rotor counts as slow.
namespace dalembert::slow_slips_test {
namespace {

constexpr double g = 9.81;

class SlowSlips : public testing::TestWithParam<StepperAt> {
 protected:
  [[nodiscard]] static Options options(double t_end) {
    return {.t_end = t_end, .samples = 3, .tolerance = GetParam().tolerance, .stepper = GetParam().stepper};
  }
  /// Of a motion of a few dozen steps.
  [[nodiscard]] static double error() { return 100.0 * GetParam().tolerance; }
};
INSTANTIATE_TEST_SUITE_P(Runs, SlowSlips, both_steppers_at({1e-4, 1e-7, 1e-10, 3e-11}), tolerance_name);

/// A pad of 1 kg that lies on the rim of a rotor, at an arm R, in a scene of 2 m.
struct Brake {
  static constexpr double mu = 0.3;
  Scene<2> scene;
  Rotor disc;
  double deceleration;

  Brake(double R, double w) {
    constexpr double inertia = 0.2;
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto pad = scene.add_particle({.mass = 1.0, .position = {2.0, 0.0}}, "pad");
    const auto face = scene.add(OnCurve{pad, Plane<2>{}}, "face");
    scene.add(OnCurve{pad, Plane<2>{.point = {2.0, 0.0}, .normal = {1.0, 0.0}}}, "guide");
    const auto other = scene.add_particle({.mass = 1.0, .velocity = {0.0, 1.0}}, "other");
    scene.add(Spring{Fixed<2>{}, other, 3.0});
    disc = scene.add_rotor({.inertia = inertia, .angular_velocity = w}, "disc");
    scene.add(coulomb(face, nonholonomic(points(disc), [R](auto, auto rate) { return R * rate[0]; }), mu),
              "brake");
    deceleration = mu * g * R / inertia;
  }
};

/// The rim of a small rotor is slower than anything else in the scene.
TEST_P(SlowSlips, OfASmallRotorComeToRest) {
  for (const double R : {0.001, 0.03, 0.1}) {
    const double w = 0.5 * Brake(R, 0.0).deceleration;  // stops at 0.5 s
    Brake brake(R, w);
    const auto run = simulate(brake.scene, options(1.0));
    ASSERT_EQ(run.events().size(), 1U) << R;
    EXPECT_EQ(run.events()[0].kind, EventKind::sticks);
    EXPECT_NEAR(run.events()[0].time, 0.5, error()) << R;
    EXPECT_NEAR(run.angle(brake.disc, 2), 0.25 * w, error()) << R;
  }
}

/// It turns back at once, by a torque of three times the friction.
TEST_P(SlowSlips, OfARotorAreReversedFromAnyStart) {
  constexpr double R = 0.1, push = 3.0, t_end = 0.5;
  for (const double w : {-1e-3, -1e-5, -1e-7, -1e-9, -1e-12}) {
    Brake brake(R, w);
    brake.scene.add(Torque{brake.disc, push * Brake::mu * g * R});
    const double a = brake.deceleration, stopped = -w / ((push + 1.0) * a),
                 right = 0.5 * w * stopped + 0.5 * (push - 1.0) * a * std::pow(t_end - stopped, 2);
    EXPECT_NEAR(simulate(brake.scene, options(t_end)).angle(brake.disc, 2), right, error()) << w;
  }
}

/// A block that slides slowly beside what is fast slides; and stops where it must, v^2/(2 mu g) away.
TEST_P(SlowSlips, OfABlockAtTheStartAreNotTakenAway) {
  constexpr double mu = 0.3, v = 1e-3;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto block = scene.add_particle({.mass = 1.0, .velocity = {v, 0.0}}, "block");
  const auto floor = scene.add(OnCurve{block, Plane<2>{}}, "floor");
  scene.add(coulomb(floor, Slip{block, Plane<2>{}}, mu), "friction");
  const auto fast =
      scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}, .velocity = {30.0, 0.0}}, "fast");
  scene.add(Distance{Fixed<2>{}, fast, 1.0});
  const auto run = simulate(scene, options(0.01));
  EXPECT_NEAR(run.position(block, 2).x(), v * v / (2.0 * mu * g), error());
  ASSERT_EQ(run.events().size(), 1U);
  EXPECT_NEAR(run.events()[0].time, v / (mu * g), error());
}

/// In space what sticks is told a little before it rests: from there the rest of the slip is the start's.
TEST_P(SlowSlips, BeforeAPuckSticksAreAStart) {
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
  const auto puck = scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.3, 0.0}}, "puck");
  const auto table = scene.add(OnSurface{puck, Plane<3>{}}, "table");
  scene.add(coulomb(table, Slip{puck, Plane<3>{}}, 0.3), "friction");
  scene.add(
      force_law(points(puck), [](auto t, auto, auto) { return vec(0.0 * t, 2.0 * cos(5.0 * t), 0.0 * t); }));
  scene.add_particle({.mass = 1.0, .position = {1.0, 1.0, 1.0}}, "other");
  const auto run = simulate(scene, options(1.5));
  const auto events = run.events();
  const auto stuck = std::ranges::find(events, EventKind::sticks, &EventRecord::kind);
  ASSERT_NE(stuck, events.end());
  const auto k = static_cast<std::size_t>(stuck - events.begin());
  // A force of 2 N never moves it again: 0.3 m g is 2.9 N. What is left of its way is (slip)^2, below any
  // tolerance of a speed.
  for (const Sample<3>& from : {run.event_sample(k), run.sample_after(k)})
    EXPECT_NEAR((simulate(scene, from, options(1.5)).position(puck, 2) - run.position(puck, 2)).norm(), 0.0,
                error());
}

/// A lone grain in a bowl: what it does when it is free has another length than what it does there.
TEST_P(SlowSlips, BeforeAGrainSticksInABowlAreAStart) {
  constexpr double angle = 0.34, mu = 0.48;  // its tangent is 0.35: it stays
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
  const auto grain = scene.add_particle(
      {.mass = 1.0, .position = {std::sin(angle), 0.0, -std::cos(angle)}, .velocity = {0.0, 0.7, 0.0}},
      "grain");
  const auto bowl =
      scene.add(unilateral(OnSurface{grain, Sphere<3>{}}, {.allowed = Allowed::negative}), "bowl");
  scene.add(coulomb(bowl, Slip{grain, Sphere<3>{}}, mu), "friction");
  const auto run = simulate(scene, options(2.0));
  ASSERT_FALSE(run.events().empty());
  const std::size_t k = run.events().size() - 1;
  ASSERT_EQ(run.events()[k].kind, EventKind::sticks);
  for (const Sample<3>& from : {run.event_sample(k), run.sample_after(k)})
    EXPECT_NEAR((simulate(scene, from, options(2.0)).position(grain, 2) - run.position(grain, 2)).norm(), 0.0,
                error());
}

}  // namespace
}  // namespace dalembert::slow_slips_test
