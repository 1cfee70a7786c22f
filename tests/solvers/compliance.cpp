#include <dalembert/tests/solvers/with_events.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

/// A compliant constraint is a spring in every impact, release, change and force problem, whatever its
/// stiffness.
namespace dalembert::compliance_test {
namespace {

class Compliance : public testing::TestWithParam<Stepper> {
 protected:
  /// Vibrations of this amplitude are to be seen: the tolerance is relative to it.
  [[nodiscard]] static Options options(double t_end, double tolerance, double amplitude = 0.0) {
    return {
        .t_end = t_end, .samples = 11, .tolerance = tolerance, .stepper = GetParam(), .length = amplitude};
  }
};
INSTANTIATE_TEST_SUITE_P(Steppers, Compliance, both_steppers, stepper_name);

/// Errors of a run of some vibrations, in units of the tolerance.
constexpr double of_a_run = 1000.0;
/// Round-off of positions of size 1 to 3, some steps' worth.
constexpr double rounding = 1e-14;

TEST_P(Compliance, DoesNotHoldAContactClosed) {
  // 1 kg on the ground is pulled up by a spring stretched to 20 N: net 10 N, so y = 10/k (1 - cos w t).
  for (const double k : {1e2, 1e4, 1e6, 1e8, 1e10}) {
    for (const double tolerance : {1e-5, 1e-8}) {
      Scene<2> scene("load");
      scene.add(UniformGravity<2>{{0.0, -10.0}});
      const auto load = scene.add_particle({.mass = 1.0}, "load");
      const auto ground = scene.add(unilateral(OnCurve{load, Plane<2>{}}), "ground");
      const auto rope =
          scene.add(compliant(Distance{load, Fixed<2>{{0.0, 3.0}}, 3.0 - 20.0 / k}, 1.0 / k), "rope");
      const double w = std::sqrt(k), amplitude = 10.0 / k;
      const bool seen = tolerance * amplitude > 10.0 * rounding;  // else only that it is small
      const auto run = simulate(scene, options(2.5 / w, tolerance, seen ? amplitude : 0.0));
      const double error = of_a_run * tolerance + rounding / amplitude;  // of the amplitude
      EXPECT_TRUE(run.events().empty());
      for (std::size_t i = 0; i < run.size(); ++i) {
        const double y = 1.0 - std::cos(w * run.times()[i]);  // in amplitudes
        EXPECT_EQ(run.multiplier(ground, i), 0.0);
        EXPECT_NEAR(run.position(load, i).y(), amplitude * y,
                    seen ? error * amplitude : 3.0 * of_a_run * tolerance)
            << k << ' ' << tolerance;
        if (!seen) continue;
        EXPECT_NEAR(run.multiplier(rope, i), -20.0 + 10.0 * y, 10.0 * error) << k << ' ' << tolerance;
      }
    }
  }
}

TEST_P(Compliance, PassesOnNoImpulse) {
  // 2 kg above 1 kg fall 0.45 m: at 3 m/s the lower one is thrown back, the upper one goes on.
  for (const double k : {1e2, 1e5, 1e8, 1e10}) {
    Scene<2> scene("dumbbell");
    scene.add(UniformGravity<2>{{0.0, -10.0}});
    const auto low = scene.add_particle({.mass = 1.0, .position = {0.0, 0.45}}, "low");
    const auto high = scene.add_particle({.mass = 2.0, .position = {0.0, 1.45}}, "high");
    const auto floor = scene.add(unilateral(OnCurve{low, Plane<2>{}}, {.restitution = 1.0}), "floor");
    const auto rod = scene.add(compliant(Distance{low, high, 1.0}, 1.0 / k), "rod");
    const double w = std::sqrt(1.5 * k);
    const auto run = simulate(scene, options(0.3 + 0.5 / w, 1e-8));
    ASSERT_EQ(run.events().size(), 1U);
    EXPECT_NEAR(run.events()[0].time, 0.3, 1e-6);
    EXPECT_NEAR(run.impulse(floor, 0), 6.0, 1e-5);
    EXPECT_EQ(run.impulse(rod, 0), 0.0);
    EXPECT_NEAR(run.sample_after(0).velocity(low).y(), 3.0, 1e-5);
    EXPECT_NEAR(run.sample_after(0).velocity(high).y(), -3.0, 1e-5);
    // Their distance 1 + d obeys d'' = -w^2 d from d' = -6.
    const std::size_t last = run.size() - 1;
    const double d = (run.position(high, last) - run.position(low, last)).y() - 1.0;
    EXPECT_NEAR(d * w, -6.0 * std::sin(w * (run.times()[last] - run.events()[0].time)), 1e-6 * w + 1e-3) << k;
  }
}

TEST_P(Compliance, ForceBetweenHeldPointsIsExact) {
  // Nothing moves but a pin: the force is 10 sin 2t N at every sample, with round-off k times that of g.
  for (const double k : {1e2, 1e4, 1e6, 1e8, 1e10}) {
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
      Scene<2> scene("held");
      const auto block = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "block");
      const auto hold = scene.add(Coincident{Fixed<2>{{1.0, 0.0}}, block}, "hold");
      const auto pin = driven([u = 10.0 / k](auto t) { return vec(u * sin(2.0 * t), 0.0); });
      const auto rod = scene.add(compliant(Distance{pin, block, 1.0}, 1.0 / k), "rod");
      const auto run =
          simulate(scene, {.t_end = 3.0, .samples = 301, .tolerance = tolerance, .stepper = GetParam()});
      EXPECT_TRUE(run.is_determined(rod, 0)) << k << ' ' << tolerance;
      for (std::size_t i = 0; i < run.size(); ++i) {
        const double right = 10.0 * std::sin(2.0 * run.times()[i]);
        if (!run.is_determined(rod, i)) {  // by the explicit stepper: round-off after some hundred steps
          EXPECT_GT(k * 1e-14, std::sqrt(tolerance) * std::abs(right)) << k << ' ' << tolerance;
          continue;
        }
        EXPECT_NEAR(run.multiplier(rod, i), right, 10.0 * tolerance + k * 1e-15)
            << k << ' ' << tolerance << ' ' << i;
        EXPECT_NEAR(run.multiplier(hold, i)[0], -right, 10.0 * tolerance + k * 1e-15);
      }
    }
  }
}

TEST_P(Compliance, StuckBlockSlidesWhereItsSpringOvercomesFriction) {
  // The spring's force is 10 sin 2t N, friction holds 4 N: until t = asin(0.4)/2.
  for (const double k : {1e2, 1e4, 1e6}) {
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
      Scene<2> scene("pushed");
      scene.add(UniformGravity<2>{{0.0, -10.0}});
      const auto block = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "block");
      const auto floor = scene.add(OnCurve{block, Plane<2>{}}, "floor");
      const auto rough = scene.add(coulomb(floor, Slip{block, Plane<2>{}}, 0.4), "rough");
      const auto pin = driven([u = 10.0 / k](auto t) { return vec(u * sin(2.0 * t), 0.0); });
      const auto rod = scene.add(compliant(Distance{pin, block, 1.0}, 1.0 / k), "rod");
      const auto run = simulate(scene, options(0.25, tolerance));
      ASSERT_FALSE(run.events().empty()) << k << ' ' << tolerance;
      EXPECT_EQ(run.events()[0].kind, EventKind::slides);
      EXPECT_NEAR(run.events()[0].time, std::asin(0.4) / 2.0, tolerance + k * 1e-15) << k << ' ' << tolerance;
      EXPECT_NEAR(run.event_sample(0).multiplier(rod), 4.0, 10.0 * tolerance + k * 1e-14);
      EXPECT_NEAR(run.multiplier(rough, 3), -run.multiplier(rod, 3), 10.0 * tolerance + k * 1e-14);
    }
  }
}

TEST_P(Compliance, PressesARoughGround) {
  // On a ground of stiffness k from half the depth at rest: N = m g (1 - cos w t/2), v' = -mu N/m.
  constexpr double mu = 0.3, v0 = 2.0;
  for (const double k : {1e2, 1e4, 1e6, 1e12}) {
    const bool seen =
        k <= 1e6;  // else the vibration, 5 N/k, is too small and fast to be seen at the tolerance
    if (!seen && GetParam() == Stepper::erk) continue;  // positions do not tell the force
    Scene<2> scene("soft ground");
    scene.add(UniformGravity<2>{{0.0, -10.0}});
    const auto block =
        scene.add_particle({.mass = 1.0, .position = {0.0, -5.0 / k}, .velocity = {v0, 0.0}}, "block");
    const auto ground = scene.add(compliant(OnCurve{block, Plane<2>{}}, 1.0 / k), "ground");
    const auto rough = scene.add(coulomb(ground, Slip{block, Plane<2>{}}, mu), "rough");
    const double tolerance = seen ? 1e-9 : 1e-6, w = std::sqrt(k);
    const auto run = simulate(scene, options(0.3, tolerance));
    for (std::size_t i = 0; i < run.size(); ++i) {
      const double t = run.times()[i], N = 10.0 - 5.0 * std::cos(w * t);
      EXPECT_NEAR(run.velocity(block, i).x(), v0 - mu * (10.0 * t - 5.0 * std::sin(w * t) / w),
                  of_a_run * tolerance + (seen ? 0.0 : mu * 10.0 / w));
      EXPECT_NEAR(run.multiplier(rough, i), -mu * run.multiplier(ground, i), 1e-9 * 15.0);
      if (!seen) continue;
      EXPECT_NEAR(run.multiplier(ground, i), N, of_a_run * tolerance * std::max(1.0, 0.01 * k)) << k;
    }
  }
}

TEST_P(Compliance, IsImposedWhereItIsNotSatisfied) {
  // A ball that moves freely is caught 0.2 m off a spring's length: its force is there at once, no impulse.
  for (const double k : {1e2, 1e4, 1e6}) {
    Scene<2> scene("caught");
    const auto ball =
        scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}, .velocity = {1.0, 0.0}}, "ball");
    const auto rod = scene.add(compliant(Distance{Fixed<2>{}, ball, 1.0}, 1.0 / k), "rod");
    scene.release(rod);
    const Event<2> caught{"caught", [](const auto& now) { return now.time() - 0.2; }, Crossing::rising, false,
                          [rod](Scene<2>& s) { s.impose(rod); }};
    const double w = std::sqrt(k), time = 0.2;
    const auto run = simulate(scene, options(0.4, 1e-9), {caught});
    EXPECT_EQ(run.statistics().degrees_of_freedom, 2);
    ASSERT_EQ(run.events().size(), 1U);
    EXPECT_NEAR(run.events()[0].time, time, 1e-7);
    EXPECT_EQ(run.impulse(rod, 0), 0.0);
    EXPECT_EQ(run.event_sample(0).multiplier(rod), 0.0);
    EXPECT_NEAR(run.sample_after(0).multiplier(rod), -0.2 * k, 1e-7 * k);
    for (std::size_t i = 0; i < run.size(); ++i) {
      const double t = run.times()[i] - time;
      const double x = t < 0.0 ? 1.2 + t : 1.0 + 0.2 * std::cos(w * t) + std::sin(w * t) / w;
      EXPECT_NEAR(run.position(ball, i).x(), x, 1e-6 + 1e-8 * w) << k;
    }
  }
}

TEST_P(Compliance, PassesOnNoImpulseOfAChange) {
  // A rod comes into force while a spring is stretched beside it: the impulse is the rod's alone.
  Scene<2> scene("imposed");
  const auto a = scene.add_particle({.mass = 2.0, .position = {1.0, 0.0}, .velocity = {0.5, 1.0}}, "a");
  const auto b = scene.add_particle({.mass = 1.0, .position = {2.5, 0.0}}, "b");
  const auto rod = scene.add(Distance{Fixed<2>{}, a, 1.0}, "rod");
  const auto spring = scene.add(compliant(Distance{a, b, 1.0}, 1e-6), "spring");
  scene.release(rod);
  const Event<2> now{"at once", [](const auto& s) { return s.time() - 1e-9; }, Crossing::rising, false,
                     [rod](Scene<2>& s) { s.impose(rod); }};
  const auto run = simulate(scene, options(1e-3, 1e-8), {now});
  ASSERT_EQ(run.events().size(), 1U);
  EXPECT_EQ(run.impulse(spring, 0), 0.0);
  EXPECT_NEAR(run.impulse(rod, 0), -2.0 * run.event_sample(0).velocity(a).x(), 1e-6);
  EXPECT_NEAR(run.sample_after(0).velocity(a).x(), 0.0, 1e-6);
  EXPECT_NEAR(run.sample_after(0).velocity(b).x(), run.event_sample(0).velocity(b).x(), 1e-12);
}

}  // namespace
}  // namespace dalembert::compliance_test
