#include "readings.h"
#include <dalembert/models/four_bar.h>
#include <dalembert/solvers/integration.h>
#include <dalembert/solvers/opening.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dalembert::restart_test {
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

/// A pendulum whose force may be evaluated so many times.
struct Counted {
  std::shared_ptr<long> calls_left = std::make_shared<long>(std::numeric_limits<long>::max());
  Scene<2> scene;

  Counted() {
    const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
    scene.add(Distance{Fixed<2>{}, bob, 1.0});
    scene.add(force_law(points(bob), [left = calls_left](auto, auto v) {
      if ((*left)-- <= 0) throw std::runtime_error("no more");
      return (vec(0.0, -9.81) - 0.1 * v).eval();
    }));
  }
};

template <int D>
Integration integration_of(const std::shared_ptr<const System>& system, const Scene<D>& scene,
                           const Options& options) {
  const Opening opening = open_run(system, scene.initial_positions(), scene.initial_velocities(), options);
  return Integration(opening.problem, opening.start, opening.sides, options);
}

/// All that can be read from a run at its last step, and before it.
std::vector<double> seen(Integration& run, OutputState& now) {
  std::vector<double> all{run.time(), static_cast<double>(run.statistics(run.time()).steps)};
  run.read(run.time(), now);
  for (const auto* part : {&now.q, &now.v, &now.a, &now.lambda})
    all.insert(all.end(), part->begin(), part->end());
  Record before;
  before.layout = run.system().layout();
  run.dense(run.time())->read(std::vector{0.25}, before);
  all.insert(all.end(), before.values.begin(), before.values.end());
  return all;
}

/// Wherever in the evaluations of its force restart_with_constraints fails, what a run has computed is read
/// as before.
TEST(Restart, FailureLeavesWhatWasComputed) {
  const Counted counted;
  const auto system = std::make_shared<const System>(counted.scene.system());
  const auto other = std::make_shared<const System>(counted.scene.system());
  for (const Stepper stepper : both) {
    Integration run =
        integration_of(system, counted.scene, {.t_end = 1.0, .stepper = stepper, .dense = true});
    while (run.time() < 0.5) run.step(1.0);
    OutputState now(*system, run.start());
    const std::vector<double> before = seen(run, now);
    const long enough = *counted.calls_left;
    bool begun = false;
    for (long allowed = 0; !begun; ++allowed) {
      *counted.calls_left = allowed;
      try {
        run.restart_with_constraints(now.t, other, now.q, now.v);
        begun = true;
      } catch (const EquationFault&) {
        *counted.calls_left = enough;
        ASSERT_EQ(run.shared_system(), system);
        ASSERT_EQ(seen(run, now), before) << allowed;
      }
    }
    EXPECT_EQ(run.shared_system(), other);
    *counted.calls_left = enough;
  }
}

/// The same where the implicit stepper hands over to the explicit one, in front of a singular position, and
/// takes over again behind it: their polynomials differ in degree.
TEST(Restart, FailureAtAHandoverLeavesWhatWasComputed) {
  long left = 0;
  const long enough = std::numeric_limits<long>::max();
  models::FourBarScene linkage = models::FourBar{.loops = 1}.scene();
  linkage.scene.add(force_law(points(linkage.uprights[0].end()), [&left](auto, auto, auto v) {
    if (left-- <= 0) throw std::runtime_error("no more");
    return (0.0 * v).eval();
  }));
  const auto system = std::make_shared<const System>(linkage.scene.system());
  const auto integration = [&] {
    left = enough;
    return integration_of(system, linkage.scene, {.t_end = 10.0});
  };
  Integration untroubled = integration(), troubled = integration();
  int handovers = 0;
  while (handovers < 2 && untroubled.time() < 10.0) {
    const int degree = untroubled.degree();
    untroubled.step(10.0);
    const bool handover = untroubled.degree() != degree;
    if (handover) {
      ++handovers;
      const double before = troubled.time();
      left = 0;
      EXPECT_THROW(troubled.step(10.0), EquationFault);
      EXPECT_EQ(troubled.degree(), degree);
      EXPECT_EQ(troubled.time(), before);
      left = enough;
    }
    troubled.step(10.0);
    ASSERT_EQ(troubled.time(), untroubled.time());
    ASSERT_EQ(troubled.degree(), untroubled.degree());
  }
  EXPECT_EQ(handovers, 2);
  OutputState there(*system, untroubled.start()), also = there;
  untroubled.read(untroubled.time(), there);
  troubled.read(troubled.time(), also);
  EXPECT_EQ(also.q, there.q);
  EXPECT_EQ(also.lambda, there.lambda);
}

/// A block that slides on a spring, of a scene without a length: where its sliding turns, and where it
/// sticks.
TEST(Restart, GoesOnWhereFrictionTurns) {
  for (const Stepper stepper : both) {
    for (const double tolerance : {1e-4, 1e-7, 1e-10}) {
      Scene<2> scene;
      scene.add(UniformGravity<2>{{0.0, -9.81}});
      const auto block = scene.add_particle({.mass = 1.0, .position = {-0.8, 0.0}});
      const auto floor = scene.add(OnCurve{block, Plane<2>{}});
      scene.add(coulomb(floor, Slip{block, Plane<2>{}}, 0.6));
      scene.add(force_law(points(block), [](auto r, auto) { return vec(-50.0 * r.x(), 0.0 * r.x()); }));
      const Options options{.t_end = 2.0, .samples = 3, .tolerance = tolerance, .stepper = stepper};
      const auto run = simulate(scene, options);
      ASSERT_GT(run.events().size(), 2U);
      for (std::size_t k = 0; k < run.events().size(); ++k) {
        for (const auto& from : {run.event_sample(k), run.sample_after(k)}) {
          const auto rest = simulate(scene, from, options);
          EXPECT_NEAR(rest.position(block, 2).x(), run.position(block, 2).x(), 100.0 * tolerance) << k;
        }
      }
    }
  }
}

}  // namespace
}  // namespace dalembert::restart_test
