#include <dalembert/dalembert.h>
#include <dalembert/tests/both_steppers.h>

#include <gtest/gtest.h>

#include <cmath>

/// Light bodies beside heavy ones, or beside what is loaded by far more: when they let go depends on their
/// own forces.
namespace dalembert::light_beside_heavy_test {
namespace {

constexpr double g = 9.81;

class LightBesideHeavy : public testing::TestWithParam<StepperAt> {
 protected:
  [[nodiscard]] static Options options(double t_end) {
    return {.t_end = t_end, .samples = 3, .tolerance = GetParam().tolerance, .stepper = GetParam().stepper};
  }
  /// Forces are known to a part of the tolerance of themselves, and times at which they are 0 with them.
  [[nodiscard]] static double error() { return 100.0 * GetParam().tolerance; }
};
INSTANTIATE_TEST_SUITE_P(Runs, LightBesideHeavy, both_steppers_at({1e-4, 1e-6, 1e-8, 1e-10}), tolerance_name);

/// By 2 m g t, from t = 1/2 on: y'' = 2 g t - g.
TEST_P(LightBesideHeavy, IsLiftedByItsOwnLoad) {
  for (const double M : {1.0, 1e4, 1e8}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -g}});
    constexpr double m = 0.01;
    const auto light = scene.add_particle({.mass = m}, "light");
    scene.add(unilateral(OnCurve{light, Plane<2>{}}), "floor");
    scene.add(force_law(points(light), [](auto t, auto, auto) { return vec(0.0 * t, 2.0 * m * g * t); }));
    const auto heavy = scene.add_particle({.mass = M, .position = {1.0, 0.0}}, "heavy");
    scene.add(OnCurve{heavy, Plane<2>{}}, "its floor");
    const auto run = simulate(scene, options(1.0));
    ASSERT_EQ(run.events().size(), 1U) << M;
    EXPECT_NEAR(run.events()[0].time, 0.5, error()) << M;
    EXPECT_NEAR(run.position(light, 2).y(), g / 24.0, error()) << M;
  }
}

/// The disc's points are accelerated by w^2 r, and hold each other: nothing of that presses the floor.
TEST_P(LightBesideHeavy, IsLiftedHoweverFastItSpins) {
  for (const double w : {0.0, 300.0, 3000.0}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -g}});
    constexpr double m = 1.0;
    const auto disc = add_body(scene, {.mass = m, .inertia = 0.005, .angular_velocity = w}, "disc");
    const auto centre = disc.point({0.0, 0.0});
    scene.add(unilateral(OnCurve{centre, Plane<2>{}}), "floor");
    scene.add(force_law(points(centre), [](auto t, auto, auto) { return vec(0.0 * t, 2.0 * m * g * t); }));
    const auto run = simulate(scene, options(0.6));
    ASSERT_EQ(run.events().size(), 1U) << w;
    EXPECT_NEAR(run.events()[0].time, 0.5, error()) << w;
  }
}

/// A cup on the deck of a ship that is braked more and more: m b t reaches mu m g.
/// From t = 0.55 by twice what friction holds, for 0.2: a jump that is nothing beside the load of the other.
TEST_P(LightBesideHeavy, SlidesByAPushThatSwitchesOn) {
  constexpr double mu = 0.3, on = 0.55, lasts = 0.2;
  for (const double m : {1e-2, 1e-4, 1e-6}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto light = scene.add_particle({.mass = m}, "light");
    const auto floor = scene.add(OnCurve{light, Plane<2>{}}, "floor");
    scene.add(coulomb(floor, Slip{light, Plane<2>{}}, mu), "rough");
    scene.add(force_law(points(light), [m](auto t, auto, auto) {
      return vec(t > on && t < on + lasts ? 2.0 * mu * m * g + 0.0 * t : 0.0 * t, 0.0 * t);
    }));
    const auto heavy = scene.add_particle({.mass = 1.0, .position = {3.0, 0.0}, .velocity = {1.0, 0.0}});
    scene.add(OnCurve{heavy, Plane<2>{}});
    const auto run = simulate(scene, options(1.0));
    ASSERT_EQ(run.events().size(), 2U) << m;
    EXPECT_EQ(run.events()[0].kind, EventKind::slides);
    EXPECT_NEAR(run.events()[0].time, on, error()) << m;
    EXPECT_EQ(run.events()[1].kind, EventKind::sticks);
    EXPECT_NEAR(run.events()[1].time, on + 2.0 * lasts, error()) << m;
  }
}

TEST_P(LightBesideHeavy, SlidesByItsOwnFriction) {
  constexpr double m = 0.2, mu = 0.3, b = 10.0;
  for (const double M : {1.0, 1e5, 1e9}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto ship = scene.add_particle({.mass = M, .velocity = {5.0, 0.0}}, "ship");
    const auto cup = scene.add_particle({.mass = m, .position = {0.0, 1.0}, .velocity = {5.0, 0.0}}, "cup");
    scene.add(OnCurve{ship, Plane<2>{}}, "water");
    const auto deck =
        scene.add(holonomic(points(cup, ship),
                            [](auto of_cup, auto of_ship) { return of_cup.y() - of_ship.y() - 1.0; }),
                  "deck");
    scene.add(coulomb(deck,
                      nonholonomic(points(cup, ship), [](auto, auto, auto of_cup,
                                                         auto of_ship) { return of_cup.x() - of_ship.x(); }),
                      mu),
              "friction");
    scene.add(
        force_law(points(ship), [F = (M + m) * b](auto t, auto, auto) { return vec(-F * t, 0.0 * t); }));
    const auto run = simulate(scene, options(0.5));
    ASSERT_FALSE(run.events().empty()) << M;
    EXPECT_EQ(run.events()[0].kind, EventKind::slides);
    EXPECT_NEAR(run.events()[0].time, mu * g / b, error()) << M;
  }
}

}  // namespace
}  // namespace dalembert::light_beside_heavy_test
