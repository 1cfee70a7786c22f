#include <dalembert/dalembert.h>
#include <dalembert/tests/solvers/with_events.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace dalembert::scales_test {
namespace {

/// Scenes that start from rest and have no length of their own: what is asked of a run must not change what
/// the solver takes for one.
class Scales : public WithEvents {};
INSTANTIATE_TEST_SUITE_P(Runs, Scales, at_usual_tolerance, tolerance_name);

constexpr double falling[] = {1e-8, 1e-9, 1e-10, 1e-11, 3e-12, 1e-12, 3e-13};

/// A step of order 5, the lower of the two steppers' orders, is shorter by the sixth root of the tolerance.
/// Twice that is for orders that change.
void expect_smooth(const Statistics& before, const Statistics& after, double ratio) {
  EXPECT_LE(static_cast<double>(after.steps),
            2.0 * std::pow(ratio, 1.0 / 6.0) * static_cast<double>(before.steps));
  EXPECT_LE(after.convergence_failures, after.steps / 20);
}

Scene<2> snakeboard() {
  Scene<2> scene("snakeboard");
  constexpr double m = 6.0, r = 0.2, rotor_inertia = 0.072, wheel = 0.0011;
  const auto board = scene.add_particle({.mass = m}, "board");
  const auto heading = scene.add_rotor({.inertia = m * r * r - rotor_inertia - 2.0 * wheel}, "heading");
  const auto rotor = scene.add_rotor({.inertia = rotor_inertia, .angular_velocity = 0.7}, "rotor");
  const auto front = scene.add_rotor({.inertia = wheel, .angular_velocity = 0.3}, "front");
  const auto back = scene.add_rotor({.inertia = wheel, .angular_velocity = -0.3}, "back");
  const auto drive = [&](const Rotor& which, double amplitude) {
    scene.add(holonomic(points(which, heading),
                        [amplitude](auto t, auto a, auto h) { return a[0] - h[0] - amplitude * sin(t); }));
  };
  drive(rotor, 0.7);
  drive(front, 0.3);
  drive(back, -0.3);
  for (const int side : {1, -1}) {
    scene.add(nonholonomic(points(board, heading, side > 0 ? front : back),
                           [side](auto, auto h, auto w, auto v, auto om, auto) {
                             return cos(w[0]) * (v.y() + side * r * om[0] * cos(h[0])) -
                                    sin(w[0]) * (v.x() - side * r * om[0] * sin(h[0]));
                           }));
  }
  return scene;
}

TEST_P(Scales, SnakeboardDrivesOffSmoothlyAtEveryTolerance) {
  Statistics before;
  double tolerance_before = 0.0;
  for (const double tolerance : falling) {
    const Statistics s = simulate(snakeboard(), {.t_end = 6.0 * std::numbers::pi,
                                                 .samples = 7,
                                                 .tolerance = tolerance,
                                                 .stepper = GetParam(),
                                                 .max_steps = 20'000})
                             .statistics();
    if (tolerance_before > 0.0) expect_smooth(before, s, tolerance_before / tolerance);
    before = s;
    tolerance_before = tolerance;
  }
}

TEST_P(Scales, ParticleOnADrivenPlaneMovesSmoothlyAtEveryTolerance) {
  // y = x/2 + a (1 - cos t), smooth: all moves along the normal, by a (1 - cos t) of it in y + x' s share.
  constexpr double a = 0.1, t_end = 20.0;
  Statistics before;
  double tolerance_before = 0.0;
  for (const double tolerance : falling) {
    Scene<2> scene;
    const auto bead = scene.add_particle({.mass = 1.0});
    scene.add(
        holonomic(points(bead), [](auto t, auto x) { return x.y() - 0.5 * x.x() - a * (1.0 - cos(t)); }));
    const auto run = simulate(
        scene,
        {.t_end = t_end, .samples = 2, .tolerance = tolerance, .stepper = GetParam(), .max_steps = 20'000});
    if (tolerance_before > 0.0) expect_smooth(before, run.statistics(), tolerance_before / tolerance);
    before = run.statistics();
    tolerance_before = tolerance;
    // A step errs by the tolerance of the path, 2 a.
    const double due = a * (1.0 - std::cos(t_end)) / 1.25;
    EXPECT_NEAR(run.position(bead, 1).y(), due, 2.0 * a * tolerance * static_cast<double>(before.steps));
    EXPECT_NEAR(run.position(bead, 1).x(), -0.5 * due,
                2.0 * a * tolerance * static_cast<double>(before.steps));
  }
}

TEST_P(Scales, KnifeEdgeWithoutALeverMovesSmoothlyAtEveryTolerance) {
  // Its heading is sin t, and the force along it 1 - cos t, of which round-off leaves little at first.
  Statistics before;
  double tolerance_before = 0.0;
  for (const double tolerance : falling) {
    Scene<2> scene;
    const auto edge = scene.add_particle({.mass = 1.0});
    const auto heading = scene.add_rotor({.inertia = 0.1, .angular_velocity = 1.0});
    scene.add(holonomic(points(heading), [](auto t, auto a) { return a[0] - sin(t); }));
    scene.add(nonholonomic(points(edge, heading), [](auto, auto phi, auto u, auto) {
      return cos(phi[0]) * u.y() - sin(phi[0]) * u.x();
    }));
    scene.add(
        force_law(points(edge), [](auto t, auto, auto) { return vec(1.0 - cos(t), 0.3 * t * sin(t)); }));
    const Statistics s =
        simulate(
            scene,
            {.t_end = 20.0, .samples = 2, .tolerance = tolerance, .stepper = GetParam(), .max_steps = 20'000})
            .statistics();
    if (tolerance_before > 0.0) expect_smooth(before, s, tolerance_before / tolerance);
    before = s;
    tolerance_before = tolerance;
  }
}

}  // namespace
}  // namespace dalembert::scales_test
