#include "readings.h"
#include <dalembert/solvers/stepping.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dalembert {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// r = cos(w t) on a spring; each step errs by no more than the tolerance, and an oscillator does not enlarge
/// that.
TEST(Restart, GoesOnWithinTheToleranceOfTheRun) {
  for (const Stepper stepper : both) {
    Scene<2> scene;
    const auto cart = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "cart");
    scene.add(Spring{Fixed<2>{}, cart, 9.0});
    const Options options{.t_end = 2.0, .samples = 21, .tolerance = 1e-9, .stepper = stepper};
    const auto first = simulate(scene, options);
    Options later = options;
    later.t_end = 4.0;
    const auto rest = simulate(scene, first.sample(10), later);
    EXPECT_EQ(rest.times().front(), 1.0);
    EXPECT_EQ(rest.times().back(), 4.0);
    const double bound = 1e-9 * static_cast<double>(first.statistics().steps + rest.statistics().steps) *
                         first.statistics().length;
    for (const auto& now : rest) EXPECT_NEAR(now.position(cart).x(), std::cos(3.0 * now.time()), bound);
  }
}

/// Where constraints depend on time a restart at another time would violate them.
TEST(Restart, BeginsAtTheTimeOfItsSampleWithItsForces) {
  const EachKind each;
  const auto run = simulate(each.scene, {.t_end = 1.0, .samples = 11, .tolerance = 1e-8});
  for (const std::size_t i : {0U, 3U, 10U}) {
    const Simulation<2> again(each.scene, run.sample(i), {.t_end = 2.0, .tolerance = 1e-8});
    EXPECT_EQ(again.time(), run.times()[i]);
    // Both are projected onto the constraints, to round-off.
    EXPECT_LT((again.position(each.lower) - run.position(each.lower, i)).norm(), round_off);
    EXPECT_NEAR(again.multiplier(each.upper_rod), run.multiplier(each.upper_rod, i), round_off);
  }
}

TEST(Restart, ACopyWithOtherParametersStartsFromASampleOfTheOriginal) {
  const Pendulum pendulum;
  const auto run = simulate(pendulum.scene, {.t_end = 1.0});
  Scene<2> moon = pendulum.scene;
  moon.replace(moon.force("UniformGravity0"), UniformGravity<2>{{0.0, -1.62}});
  const Simulation<2> simulation(moon, run.sample(50), {.t_end = 2.0});
  // Tension: m v^2/L + m g cos.
  const Vec<2> r = run.position(pendulum.bob, 50), v = run.velocity(pendulum.bob, 50);
  EXPECT_NEAR(-simulation.multiplier(pendulum.rod), v.squaredNorm() - 1.62 * r.y(), round_off);
}

TEST(Restart, ShowsItsSamplesToAnObserver) {
  const Pendulum pendulum;
  const auto run = simulate(pendulum.scene, {.t_end = 1.0});
  std::vector<double> times;
  (void)simulate(pendulum.scene, run.sample(50), {.t_end = 2.0, .samples = 3},
                 [&](const Sample<2>& now) { times.push_back(now.time()); });
  EXPECT_THAT(times, testing::ElementsAre(0.5, 1.25, 2.0));
}

TEST(Restart, RefusesASampleOfSomethingElseAndAnotherTime) {
  const Pendulum pendulum, other;
  const auto run = simulate(other.scene, {.t_end = 1.0});
  EXPECT_THAT([&] { Simulation<2>(pendulum.scene, run.sample(1), {.t_end = 2.0}); },
              ThrowsMessage<InvalidArgument>(HasSubstr("cannot start from a sample of scene \"pendulum\"")));
  EXPECT_THAT([&] { Simulation<2>(other.scene, run.sample(1), {.t_end = 2.0, .t_start = 0.5}); },
              ThrowsMessage<InvalidArgument>(AllOf(HasSubstr("t_start = 0.5"), HasSubstr("leave it out"))));
  Scene<2> more = other.scene;
  more.add_particle({.mass = 1.0});
  EXPECT_THROW((void)simulate(more, run.sample(1), {.t_end = 2.0}), InvalidArgument);
}

/// Wherever a new beginning fails, here in the n-th evaluation of a force, the run stands where it stood.
TEST(Restart, ThatFailsLeavesTheRunAsItWas) {
  const auto calls_left = std::make_shared<long>(std::numeric_limits<long>::max());
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  scene.add(Distance{Fixed<2>{}, bob, 1.0});
  scene.add(force_law(points(bob), [calls_left](auto, auto v) {
    if ((*calls_left)-- <= 0) throw std::runtime_error("no more");
    return (vec(0.0, -9.81) - 0.1 * v).eval();
  }));
  for (const Stepper stepper : both) {
    *calls_left = std::numeric_limits<long>::max();
    const auto system = std::make_shared<const System>(scene.system());
    Stepping run(system, scene.initial_positions(), scene.initial_velocities(),
                 {.t_end = 1.0, .stepper = stepper, .dense = true}, std::numeric_limits<double>::infinity());
    while (run.time() < 0.5) run.step(1.0);
    const double t = run.time();
    Moment there(*system, run.start());
    run.read(t, there);
    const std::string read = run.statistics().report();
    const auto other = std::make_shared<const System>(scene.system());
    long allowed = -1;
    for (bool begun = false; !begun;) {
      *calls_left = ++allowed;
      try {
        run.begin_changed(t, other, there.q, there.v);
        begun = true;
      } catch (const EquationFault&) {
        ASSERT_EQ(run.shared_system(), system);
        ASSERT_EQ(run.time(), t);
        ASSERT_EQ(run.statistics().report(), read);
      }
    }
    EXPECT_GT(allowed, 2);
    *calls_left = std::numeric_limits<long>::max();
    EXPECT_EQ(run.shared_system(), other);
    while (run.time() < 1.0) run.step(1.0);
    run.read(1.0, there);
    // Energy less what the law took: m (v^2/2 + g y) falls, from 0 at the start.
    EXPECT_LT(there.v[0] * there.v[0] / 2.0 + there.v[1] * there.v[1] / 2.0 + 9.81 * there.q[1], 0.0);
  }
}

}  // namespace
}  // namespace dalembert
