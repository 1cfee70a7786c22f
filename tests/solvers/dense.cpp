#include "../both_steppers.h"
#include "readings.h"
#include <dalembert/models/four_bar.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace dalembert::dense_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<double> equally_spaced(double from, double to, int count) {
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) times.push_back(i == count ? to : from + (to - from) * i / count);
  return times;
}

/// A bead on a smooth rod that turns in a horizontal plane with the angular velocity w, at 1 on it and at
/// rest relative to it at first: r = cosh(w t), and with m r'' = ... across the rod the normal force 2 m w
/// r'.
struct BeadOnTurningRod {
  static constexpr double m = 0.7, w = 1.5;
  Scene<2> scene{"bead"};
  Particle<2> bead = scene.add_particle({.mass = m, .position = {1.0, 0.0}, .velocity = {0.0, w}}, "bead");
  Constraint<1> rod = scene.add(
      holonomic(points(bead), [](auto t, auto r) { return cos(w * t) * r.y() - sin(w * t) * r.x(); }), "rod");

  static Vec<2> position(double t) { return std::cosh(w * t) * Vec<2>(std::cos(w * t), std::sin(w * t)); }
  static double normal_force(double t) { return 2.0 * m * w * w * std::sinh(w * t); }
};

class Dense : public testing::TestWithParam<Stepper> {};
INSTANTIATE_TEST_SUITE_P(Steppers, Dense, both_steppers, stepper_name);

/// An error of the tolerance in each step, times the length, grows by cosh(w t) at most in position, and by
/// w sinh(w t) in velocity; the force takes 2 m w times that. Two samples, so that no step ends for them.
TEST_P(Dense, IsAsExactBetweenSamplesAsTheRun) {
  const BeadOnTurningRod bead;
  const auto run = simulate(
      bead.scene, {.t_end = 2.0, .samples = 2, .tolerance = 1e-9, .stepper = GetParam(), .dense = true});
  const Statistics& cost = run.statistics();
  const auto all = run.at(equally_spaced(0.0, 2.0, 1000));
  ASSERT_EQ(all.size(), 1001U);
  for (const Sample<2>& now : all) {
    const double t = now.time(), error = 1e-9 * static_cast<double>(cost.steps) * cost.length;
    EXPECT_LT((now.position(bead.bead) - bead.position(t)).norm(), error * std::cosh(bead.w * t));
    EXPECT_NEAR(now.multiplier(bead.rod), bead.normal_force(t),
                2.0 * bead.m * bead.w * error * (1.0 / cost.time + bead.w * std::sinh(bead.w * t)));
  }
}

TEST_P(Dense, GivesTheSamplesOfTheRun) {
  const Pendulum pendulum;
  const auto run =
      simulate(pendulum.scene, {.t_end = 3.0, .samples = 31, .stepper = GetParam(), .dense = true});
  const auto again = run.at(run.times());
  for (std::size_t i = 0; i < run.size(); ++i) {
    EXPECT_EQ(again.times()[i], run.times()[i]);
    EXPECT_LT((again.position(pendulum.bob, i) - run.position(pendulum.bob, i)).norm(), round_off);
    EXPECT_NEAR(again.multiplier(pendulum.rod, i), run.multiplier(pendulum.rod, i), round_off);
  }
}

/// Steps of the implicit stepper do not depend on where it is asked, and the forces of compliant constraints
/// are part of its state.
TEST(DenseRun, GivesTheForcesOfSprings) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  const auto rod = scene.add(compliant(Distance{Fixed<2>{}, bob, 1.0}, 1e-8));
  const std::vector<double> times = equally_spaced(0.0, 3.0, 500);
  const auto expected = simulate(scene, {.t_end = 3.0, .times = times});
  const auto all = simulate(scene, {.t_end = 3.0, .samples = 2, .dense = true}).at(times);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_LT((all.position(bob, i) - expected.position(bob, i)).norm(), round_off) << i;
    EXPECT_NEAR(all.multiplier(rod, i), expected.multiplier(rod, i), round_off) << i;
  }
}

/// At a singular position, where the rods are in line, the implicit stepper hands over to the explicit one,
/// which crosses on a polynomial of its own, and restarts behind. Bound: the error of a step, the tolerance
/// in position and over the linkage's time, 0.2 s, in velocity, added up over all steps and the time left.
TEST_P(Dense, LeadsThroughSingularPositions) {
  const models::FourBar linkage{.loops = 2};
  const models::FourBarScene built = linkage.scene();
  const std::vector<double> times = equally_spaced(0.0, 10.0, 5000);
  const auto exact = linkage.reference(times);
  for (const double tolerance : {1e-6, 1e-8}) {
    const auto run =
        simulate(built.scene,
                 {.t_end = 10.0, .samples = 2, .tolerance = tolerance, .stepper = GetParam(), .dense = true});
    ASSERT_GT(run.statistics().singular_positions, 0);
    const double bound = tolerance * static_cast<double>(run.statistics().steps) * run.statistics().length *
                         (1.0 + 0.5 * 10.0 / 0.2);
    const auto all = run.at(times);
    for (std::size_t i = 0; i < all.size(); ++i)
      EXPECT_LT((all.position(built.uprights[0].end(), i) - exact[i].positions[0]).norm(), bound) << times[i];
  }
}

/// A ball falls from 1 for sqrt(2/g); the step that ends there goes on below the ground.
TEST_P(Dense, EndsWhereAnEventEndsTheRun) {
  Scene<2> scene("fall");
  const auto ball = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}}, "ball");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const Event<2> ground{.name = "ground",
                        .function = [=](const Sample<2>& now) { return now.position(ball).y(); },
                        .ends = true};
  Simulation<2> simulation(scene, {.t_end = 2.0, .stepper = GetParam(), .dense = true}, {ground});
  const auto run = simulation.run();
  const double end = run.times().back();
  EXPECT_LT((run.at({end}).position(ball, 0) - run.position(ball, run.size() - 1)).norm(), round_off);
  EXPECT_THAT([&] { (void)run.at({std::nextafter(end, 1.0)}); },
              ThrowsMessage<InvalidArgument>(HasSubstr("between 0 and 0.4515")));
}

TEST(DenseRun, SaysWhatItCannotRead) {
  const Pendulum pendulum;
  const auto samples_only = simulate(pendulum.scene, {.t_end = 1.0});
  EXPECT_THAT([&] { (void)samples_only.at({0.5}); },
              ThrowsMessage<InvalidArgument>(AllOf(HasSubstr("dense = true"), HasSubstr(".times"))));
  const auto run = simulate(pendulum.scene, {.t_end = 1.0, .dense = true});
  for (const double t : {-0.001, 1.001, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT(
        [&] {
          (void)run.at({0.5, t});
        },
        ThrowsMessage<InvalidArgument>(AllOf(HasSubstr("at("), HasSubstr("between 0 and 1"))));
  }
  EXPECT_EQ(run.at({}).size(), 0U);
  // In any order, and again from what it gave.
  const auto two = run.at({0.75, 0.25});
  EXPECT_EQ(two.at({0.25}).position(pendulum.bob, 0), two.position(pendulum.bob, 1));
  EXPECT_THAT([&] { (void)simulate(pendulum.scene, {.t_end = 1.0, .dense = true}, [](const Sample<2>&) {}); },
              ThrowsMessage<InvalidArgument>(HasSubstr("dense = true")));
}

TEST(DenseRun, KnowsTheStartOfARunWithOneSample) {
  const Pendulum pendulum;
  const auto run = simulate(pendulum.scene, {.t_end = 1.0, .times = {0.0}, .dense = true});
  EXPECT_EQ(run.at({0.0}).position(pendulum.bob, 0), run.position(pendulum.bob, 0));
}

TEST(DenseRun, KnowsAllOfARunWhereverItsSamplesEnd) {
  const Pendulum pendulum;
  const auto run = simulate(pendulum.scene, {.t_end = 1.0, .times = {0.0, 0.1}, .dense = true});
  EXPECT_NO_THROW((void)run.at({0.9}));
  EXPECT_THROW((void)run.at({1.1}), InvalidArgument);
}

TEST(DenseRun, KeepsWhatARunGaveUntilItFailed) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.0}});
  scene.add(force_law(points(bob), [](auto t, auto r, auto) {
    if (t > 0.7) throw std::runtime_error("no more");
    return (0.0 * r).eval();
  }));
  try {
    (void)simulate(scene, {.t_end = 1.0, .samples = 2, .dense = true});
    FAIL();
  } catch (const IntegrationFailure& failure) {
    const auto before = failure.trajectory<2>();
    EXPECT_EQ(before.size(), 1U);
    // Uniform motion, whose steps are exact.
    EXPECT_NEAR(before.at({0.5}).position(bob, 0).x(), 0.5, round_off);
  }
}

/// Where friction would stick the explicit stepper stops inside a step (the implicit one looks ahead): what
/// its polynomial has behind that, a block that slides back, is no part of the run.
TEST(DenseRun, EndsWhereItFailed) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto block = scene.add_particle({.mass = 1.0, .velocity = {3.0, 0.0}});
  const auto table = scene.add(OnCurve{block, Plane<2>{}});
  scene.add(friction_law(table, points(block),
                         [](auto N, auto, auto v) { return (-0.02 * abs(N) * v.normalized()).eval(); }));
  scene.add(force_law(points(block), [](auto t, auto, auto v) {
    return vec(-5.0 * exp(-10.0 * (t - 0.3) * (t - 0.3)), 0.0 * v.y());
  }));
  Simulation<2> run(
      scene, {.t_end = 10.0, .times = {0.0, 0.5}, .tolerance = 1e-3, .stepper = Stepper::erk, .dense = true});
  run.advance_to(0.5);
  try {
    run.advance_to(10.0);
    FAIL();
  } catch (const IntegrationFailure& failure) {
    const auto kept = failure.trajectory<2>();
    EXPECT_NO_THROW((void)kept.at({failure.time()}));
    EXPECT_THROW((void)kept.at({std::nextafter(failure.time(), 10.0)}), InvalidArgument);
  }
  EXPECT_THROW((void)run.run(), IntegrationFailure);  // though both samples are there
}

/// A pursuer at rest goes nowhere, to the last bit: backwards, by a rounding of the first step's polynomial,
/// it would have caught its prey.
TEST_P(Dense, BeginsWithItsStart) {
  for (int k = 0; k < 20; ++k) {
    const double angle = 0.1 * k;
    const Vec<2> way(std::cos(angle), std::sin(angle));
    Scene<2> scene;
    const auto pursuer = scene.add_particle({.mass = 1.0 + 0.1 * k, .position = {0.3, 0.7}});
    const auto prey = scene.add_particle({.mass = 1.0, .position = Vec<2>(0.3, 0.7) + way, .velocity = way});
    scene.add(Pursuit{pursuer, prey});
    scene.add(force_law(points(pursuer, prey), [](auto, auto a, auto b, auto, auto) {
      const auto d = ((b - a) * (1.0 / 3.0)).eval();
      return std::tuple{d, (0.0 * d).eval()};
    }));
    const auto run =
        simulate(scene, {.t_end = 0.71, .t_start = 0.7, .samples = 2, .stepper = GetParam(), .dense = true});
    const auto start = run.at({0.7});
    EXPECT_EQ(start.velocity(pursuer, 0), Vec<2>(0.0, 0.0)) << k;
  }
}

}  // namespace
}  // namespace dalembert::dense_test
