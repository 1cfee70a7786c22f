#include <dalembert/dalembert.h>
#include <dalembert/tests/both_steppers.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace dalembert::accuracy_test {
namespace {

/// What a run says of its accuracy, against a run at the tightest tolerance.
class Accuracy : public testing::TestWithParam<Stepper> {};
INSTANTIATE_TEST_SUITE_P(Steppers, Accuracy, both_steppers, stepper_name);

constexpr double g = 9.81;

struct Watched {
  Scene<2> scene;
  std::vector<Particle<2>> particles{};
  double t_end = 0.0;

  [[nodiscard]] std::vector<Vec<2>> positions(const Trajectory<2>& run) const {
    std::vector<Vec<2>> all;
    for (std::size_t i = 0; i < run.size(); ++i)
      for (const auto& particle : particles) all.push_back(run.position(particle, i));
    return all;
  }
  [[nodiscard]] Trajectory<2> run(double tolerance, Stepper stepper) const {
    return simulate(
        scene,
        {.t_end = t_end, .samples = 21, .tolerance = tolerance, .stepper = stepper, .max_steps = 100'000});
  }
};

/// Rods of 1 m from the pivot on, at `angle` from hanging.
Watched rods(const std::vector<double>& masses, double angle, double t_end,
             const Vec<2>& pivot = {0.0, 0.0}) {
  Watched w{.scene = Scene<2>("rods"), .t_end = t_end};
  w.scene.add(UniformGravity<2>{{0.0, -g}});
  const Vec<2> along(std::sin(angle), -std::cos(angle));
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const Vec<2> r = pivot + static_cast<double>(i + 1) * along;
    w.particles.push_back(w.scene.add_particle({.mass = masses[i], .position = r}));
    if (i == 0)
      w.scene.add(Distance{Fixed<2>{pivot}, w.particles[0], (r - pivot).norm()});
    else
      w.scene.add(Distance{w.particles[i - 1], w.particles[i], 1.0});
  }
  return w;
}

/// Falls through the position where its rods lie in line.
Watched four_bar() {
  Watched w{.scene = Scene<2>("four-bar"), .t_end = 2.0};
  w.scene.add(UniformGravity<2>{{0.0, -g}});
  for (const double x : {0.0, 2.0}) {
    w.particles.push_back(w.scene.add_particle({.mass = 1.0, .position = {x, 1.0}, .velocity = {3.0, 0.0}}));
    w.scene.add(Distance{Fixed<2>{{x, 0.0}}, w.particles.back(), 1.0});
  }
  w.scene.add(Distance{w.particles[0], w.particles[1], 2.0});
  return w;
}

/// Seven stars in a plane with close encounters (Hairer, Norsett, Wanner, Solving ODEs I, II.10).
Watched pleiades() {
  constexpr double x[] = {3, 3, -1, -3, 2, -2, 2}, y[] = {3, -3, 2, 0, 0, -4, 4};
  constexpr double vx[] = {0, 0, 0, 0, 0, 1.75, -1.5}, vy[] = {0, 0, 0, -1.25, 1, 0, 0};
  Watched w{.scene = Scene<2>("pleiades"), .t_end = 3.0};
  for (std::size_t i = 0; i < 7; ++i) {
    w.particles.push_back(w.scene.add_particle(
        {.mass = static_cast<double>(i + 1), .position = {x[i], y[i]}, .velocity = {vx[i], vy[i]}}));
    for (std::size_t j = 0; j < i; ++j) {
      const double masses = static_cast<double>((i + 1) * (j + 1));
      w.scene.add(potential(points(w.particles[i], w.particles[j]), [masses](auto a, auto b) {
        const auto d = (a - b).eval();
        return -masses / sqrt(d.x() * d.x() + d.y() * d.y());
      }));
    }
  }
  return w;
}

/// The error is at most ten times what is claimed; that is no less than the tolerance, and falls with it.
void expect_honest(const Watched& w, Stepper stepper, const std::vector<Vec<2>>& exact,
                   const std::vector<double>& tolerances) {
  double before = std::numeric_limits<double>::infinity();
  for (const double tolerance : tolerances) {
    const auto run = w.run(tolerance, stepper);
    const auto positions = w.positions(run);
    double error = 0.0;
    for (std::size_t i = 0; i < exact.size(); ++i) error = std::max(error, (positions[i] - exact[i]).norm());
    const Statistics& s = run.statistics();
    EXPECT_LE(error / s.length, 10.0 * s.accuracy) << tolerance;
    EXPECT_GE(s.accuracy, tolerance);
    EXPECT_LT(s.accuracy, before) << tolerance;
    before = s.accuracy;
  }
}

void expect_honest(const Watched& w, Stepper stepper) {
  expect_honest(w, stepper, w.positions(w.run(1e-13, Stepper::erk)), {1e-4, 1e-6, 1e-8, 1e-10, 1e-12});
}

TEST_P(Accuracy, CountsThePhaseErrorOfAPendulum) { expect_honest(rods({1.0}, 1.5, 10.0), GetParam()); }

TEST_P(Accuracy, HoldsForADoublePendulumThatAmplifiesErrors) {
  expect_honest(rods({1.0, 1.0}, 2.0, 5.0), GetParam());
}

TEST_P(Accuracy, HoldsForALightBobBelowAHeavyOne) { expect_honest(rods({1e6, 1.0}, 1.0, 1.0), GetParam()); }

TEST_P(Accuracy, HoldsForAFourBarThroughItsSingularPosition) { expect_honest(four_bar(), GetParam()); }

TEST_P(Accuracy, HoldsForSevenStarsThatMeet) { expect_honest(pleiades(), GetParam()); }

TEST_P(Accuracy, IsThatOfRoundingFarFromTheOrigin) {
  // 1e8 m away a metre is known to 1e-8: runs end there, in few steps, or say what was asked too much.
  const Vec<2> far(1e8, 0.0);
  const Watched near = rods({1.0}, 1.5, 10.0), away = rods({1.0}, 1.5, 10.0, far);
  std::vector<Vec<2>> exact = near.positions(near.run(1e-13, Stepper::erk));
  for (Vec<2>& r : exact) r += far;
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13}) {
    try {
      const auto run = away.run(tolerance, GetParam());
      EXPECT_LE(run.statistics().steps, 10'000) << tolerance;
      const auto positions = away.positions(run);
      double error = 0.0;
      for (std::size_t i = 0; i < exact.size(); ++i)
        error = std::max(error, (positions[i] - exact[i]).norm());
      EXPECT_LE(error / run.statistics().length, 10.0 * run.statistics().accuracy) << tolerance;
    } catch (const IntegrationFailure& failure) {
      EXPECT_EQ(GetParam(), Stepper::ida);
      EXPECT_LT(tolerance, 1e-7);
      EXPECT_NE(std::string(failure.what()).find("more than double precision"), std::string::npos)
          << failure.what();
    }
  }
}

/// Times near 1e8 s are known to 1e-8 s: equal steps are all rounded to the same side, and the motion is
/// shifted in time. The speed is at most sqrt(2 g (1 - cos 1.5)) = 4.3, 1.5 times the scene's length over its
/// time, and a run from t = 0 is exact beside that.
// A ball that goes round on a rod without a force keeps its speed. By `ida` at a tolerance of 0.1
// it loses that, of which an audit by limits as wide knows nothing.
TEST(AccuracyOfLooseTolerances, IsAdvisedAgainstWhereItLeavesNothingOfAResult) {
  Scene<2> scene;
  const auto ball = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}, .velocity = {0.0, 1.0}});
  scene.add(Distance{Fixed<2>{}, ball, 1.0});
  const auto wrong =
      simulate(scene, {.t_end = 500.0, .samples = 2, .tolerance = 0.1, .stepper = Stepper::ida});
  EXPECT_GT(std::abs(wrong.velocity(ball, 1).norm() - 1.0), 0.1);
  EXPECT_THAT(wrong.statistics().advice, testing::HasSubstr("ask for a tighter tolerance"));
}

TEST_P(Accuracy, CountsTheRoundingOfLateTimes) {
  const Watched pendulum = rods({1.0}, 1.5, 5.0);
  const std::vector<Vec<2>> exact = pendulum.positions(pendulum.run(1e-13, Stepper::erk));
  for (const double start : {1e5, 1e6, 1e7, 1e8}) {
    for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
      const auto run = simulate(pendulum.scene, {.t_end = start + pendulum.t_end,
                                                 .t_start = start,
                                                 .samples = 21,
                                                 .tolerance = tolerance,
                                                 .stepper = GetParam()});
      const auto positions = pendulum.positions(run);
      double error = 0.0;
      for (std::size_t i = 0; i < exact.size(); ++i)
        error = std::max(error, (positions[i] - exact[i]).norm());
      EXPECT_LE(error / run.statistics().length, 10.0 * run.statistics().accuracy)
          << start << ' ' << tolerance;
    }
  }
}

/// Beside 1e16 s no step of a pendulum is resolved.
TEST_P(Accuracy, IsRefusedWhereNoStepIsResolved) {
  for (const double start : {1e14, 5e15, 1e16, 1e18}) {
    try {
      (void)simulate(rods({1.0}, 1.5, 5.0).scene,
                     {.t_end = start * (1.0 + 1e-14), .t_start = start, .stepper = GetParam()});
      ADD_FAILURE() << start;
    } catch (const Error& failure) {
      EXPECT_NE(std::string(failure.what()).find("resolves times here only to"), std::string::npos)
          << failure.what();
    }
  }
}

/// A bicycle of four bodies, 20 m from where it started in the end, that is pushed from the side: its heavy
/// frame, light fork and small wheels let round-off of positions grow in accelerations.
Scene<3> bicycle() {
  constexpr double speed = 5.0, radius = 0.3, base = 1.0, trail = 0.08, tilt = 0.3;
  Scene<3> scene("bicycle");
  scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
  const auto wheel = [&](double x, double mass, const char* name) {
    const double across = 0.25 * mass * radius * radius;
    const auto body = add_body(scene,
                               {.mass = mass,
                                .inertia = {1.05 * across, 2.0 * across, 1.05 * across},
                                .centre = {x, 0.0, radius},
                                .velocity = {speed, 0.0, 0.0},
                                .angular_velocity = {0.0, speed / radius, 0.0}},
                               name);
    const auto a = body.point({radius, 0.0, 0.0}), b = body.point({0.0, 0.0, radius});
    scene.add(DiskContact{body.centre(), a, b, radius});
    scene.add(DiskRolling{body.centre(), a, b, radius});
    return body;
  };
  const auto rear = wheel(0.0, 2.0, "rear"), front = wheel(base, 3.0, "front");
  const auto frame = add_body(
      scene,
      {.mass = 85.0, .inertia = {9.2, 11.0, 2.8}, .centre = {0.3, 0.0, 0.9}, .velocity = {speed, 0.0, 0.0}},
      "frame");
  const auto fork = add_body(
      scene,
      {.mass = 4.0, .inertia = {0.06, 0.06, 0.01}, .centre = {0.9, 0.0, 0.7}, .velocity = {speed, 0.0, 0.0}},
      "fork");
  const Vec<3> across(0.0, 1.0, 0.0), head(-std::sin(tilt), 0.0, std::cos(tilt));
  add_joint(scene, Revolute{frame, rear, {0.0, 0.0, radius}, across}, "rear hub");
  add_joint(scene, Revolute{fork, front, {base, 0.0, radius}, across}, "front hub");
  add_joint(scene, Revolute{frame, fork, Vec<3>(base + trail, 0.0, 0.0) + head * (0.9 / head.z()), head},
            "head");
  scene.add(
      force_law(points(fork.centre()), [](auto, auto u) { return (0.0 * u + Vec<3>::UnitY()).eval(); }));
  return scene;
}

TEST(AccuracyOfABicycle, EndsAtRoundOffInStepsOfUsualLength) {
  // Steps of order 8 are shorter by the eighth root of the tolerance; twice that is for those that round-off
  // repeats.
  const auto run = [](double tolerance) {
    return simulate(bicycle(), {.t_end = 2.0, .samples = 2, .tolerance = tolerance, .stepper = Stepper::erk})
        .statistics();
  };
  const Statistics before = run(1e-10), s = run(1e-13);
  EXPECT_LE(static_cast<double>(s.steps), 2.0 * std::pow(1e3, 0.125) * static_cast<double>(before.steps));
  EXPECT_GT(s.accuracy, 1e-12);  // and it says so
}

/// A spring of 1 m, stretched to 2 m, throws its mass through its pivot, where its force turns within a small
/// part of a step: past it at b, with hardly more energy than that takes. Positions after the passage by
/// the equations of motion in long double, with the classical formula of order 4 in steps of 4e-5: a
/// thousandth of the least distance, and 1e-12 off.
Vec<2> thrown_past_its_pivot(double b, double t_end) {
  using Motion = std::array<long double, 4>;
  const auto rate = [](const Motion& y) {
    const long double pull = 1.0L / std::hypot(y[0], y[1]) - 1.0L;
    return Motion{y[2], y[3], pull * y[0], pull * y[1]};
  };
  const auto moved = [](const Motion& y, long double h, const Motion& by) {
    return Motion{y[0] + h * by[0], y[1] + h * by[1], y[2] + h * by[2], y[3] + h * by[3]};
  };
  constexpr int steps = 200'000;
  const long double h = static_cast<long double>(t_end) / steps;
  Motion y{2.0L, 0.0L, 0.0L, b};
  for (int i = 0; i < steps; ++i) {
    const Motion k1 = rate(y), k2 = rate(moved(y, h / 2, k1)), k3 = rate(moved(y, h / 2, k2)),
                 k4 = rate(moved(y, h, k3));
    y = moved(moved(moved(moved(y, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
  }
  return {static_cast<double>(y[0]), static_cast<double>(y[1])};
}

/// erk's steps are half as long there as the distance to the singularity of the motion at which a single
/// difference of two orders vanishes: at some tolerance that falls into a run. The error is no larger than
/// what is claimed.
TEST(AccuracyOfErk, HoldsAtAnyToleranceForAMassThrownPastASpringsPivot) {
  constexpr double t_end = 8.0;
  for (const double b : {0.3, 0.1, 0.03, 0.01}) {
    const Vec<2> end = thrown_past_its_pivot(b, t_end);
    for (double tolerance = 1e-5; tolerance > 1e-10; tolerance *= 0.8) {
      Scene<2> scene("thrown");
      const auto p = scene.add_particle({.mass = 1.0, .position = {2.0, 0.0}, .velocity = {0.0, b}});
      scene.add(Spring{Fixed<2>{}, p, 1.0, 1.0});
      const auto run =
          simulate(scene, {.t_end = t_end, .samples = 2, .tolerance = tolerance, .stepper = Stepper::erk});
      EXPECT_LT((run.position(p, 1) - end).norm(), run.statistics().accuracy) << b << ' ' << tolerance;
    }
  }
}

}  // namespace
}  // namespace dalembert::accuracy_test
