#include "readings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <stdexcept>

namespace dalembert {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A pendulum whose rod is an equation of the user's that does as it likes.
struct Faulty {
  Scene<2> scene{"faulty"};
  Particle<2> bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "bob");

  template <class Equation>
  explicit Faulty(Equation rod) {
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    scene.add(holonomic(points(bob), rod), "rod");
  }
};

Faulty throwing_after(double end) {
  return Faulty([end](auto t, auto r) {
    if (t > end) throw std::runtime_error("the rod has melted");
    return r.norm() - 1.0;
  });
}

Faulty no_number_after(double end) {
  return Faulty([end](auto t, auto r) {
    return (r.norm() - 1.0) * (t > end ? std::numeric_limits<double>::quiet_NaN() : 1.0);
  });
}

template <class F>
std::optional<IntegrationFailure> failure_of(const F& f) {
  try {
    f();
  } catch (const IntegrationFailure& failure) {
    return failure;
  }
  return std::nullopt;
}

/// 21 samples: every 0.1 in a run of 2.
Options sampled(double t_end) { return {.t_end = t_end, .samples = 21}; }

/// That a run to t = 2 stops shortly before t = 1, by name, with its samples so far as in a run that
/// ended there. The integrator tries shorter steps until they no longer count: it gets to within one
/// of its usual steps of the fault, of which there are more than 20 in a second at this tolerance.
void expect_stopped(const Faulty& faulty, const std::string& reason) {
  const auto failure = failure_of([&] { (void)simulate(faulty.scene, sampled(2.0)); });
  ASSERT_TRUE(failure);
  EXPECT_THAT(failure->what(), AllOf(HasSubstr("Scene \"faulty\" stopped at t = "),
                                     HasSubstr("Holonomic \"rod\""), HasSubstr(reason)));
  EXPECT_LE(failure->time(), 1.0);
  EXPECT_GE(failure->time(), 0.95);
  const auto run = failure->trajectory<2>();
  ASSERT_GE(run.size(), 10U);
  EXPECT_LE(run.times().back(), failure->time());
  EXPECT_GE(run.times().back(), failure->time() - 0.1);
  EXPECT_GT(run.statistics().steps, 20);
  const Faulty healthy([](auto /*t*/, auto r) { return r.norm() - 1.0; });
  const auto reference = simulate(healthy.scene, sampled(2.0));
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(run.position(faulty.bob, i), reference.position(healthy.bob, i));
    EXPECT_EQ(run.constraint_force(faulty.bob, i), reference.constraint_force(healthy.bob, i));
  }
}

TEST(Failure, AnEquationThatThrowsStopsTheRunAndKeepsIt) {
  expect_stopped(throwing_after(1.0), "threw \"the rod has melted\"");
}

TEST(Failure, AnEquationThatIsNoNumberStopsTheRunAndKeepsIt) {
  expect_stopped(no_number_after(1.0), "is not a finite number");
}

TEST(Failure, AForceThatThrowsIsNamed) {
  Pendulum pendulum;
  pendulum.scene.add(force_law(points(pendulum.bob),
                               [](auto t, auto, auto v) {
                                 if (t > 0.5) throw std::runtime_error("a gale");
                                 return (-0.1 * v).eval();
                               }),
                     "wind");
  const auto failure = failure_of([&] { (void)simulate(pendulum.scene, sampled(1.0)); });
  ASSERT_TRUE(failure);
  EXPECT_THAT(failure->what(), AllOf(HasSubstr("\"wind\""), HasSubstr("threw \"a gale\"")));
  EXPECT_GE(failure->time(), 0.4);
  EXPECT_LE(failure->time(), 0.5);
}

TEST(Failure, ASimulationCanStillBeReadAtItsLastGoodInstant) {
  const Faulty faulty = throwing_after(1.0);
  Simulation<2> simulation(faulty.scene, sampled(2.0));
  simulation.advance_to(0.5);
  const Vec<2> position = simulation.position(faulty.bob);
  const Vec<2> force = simulation.constraint_force(faulty.bob);
  EXPECT_THROW(simulation.advance_to(1.5), IntegrationFailure);
  EXPECT_EQ(simulation.time(), 0.5);
  EXPECT_EQ(simulation.position(faulty.bob), position);
  EXPECT_EQ(simulation.constraint_force(faulty.bob), force);
}

TEST(Failure, ASecondAttemptFailsInTheSameWay) {
  const Faulty faulty = throwing_after(1.0);
  Simulation<2> simulation(faulty.scene, sampled(2.0));
  const auto first = failure_of([&] { (void)simulation.run(); });
  const auto second = failure_of([&] { simulation.advance_to(2.0); });
  const auto third = failure_of([&] { simulation.step(); });
  ASSERT_TRUE(first && second && third);
  EXPECT_THAT(second->what(), HasSubstr("Scene \"faulty\" stopped"));
  EXPECT_THAT(third->what(), HasSubstr("Scene \"faulty\" stopped"));
  EXPECT_GE(first->trajectory<2>().size(), 10U);
}

/// A run may fail anywhere: half way through a step, the search for an impact, or the impact. From there it
/// would lose the impact or pass it twice, so it is not gone on with, even where the fault is mended.
TEST(Failure, NothingGoesOnFromIt) {
  const long enough = std::numeric_limits<long>::max();
  for (const Stepper stepper : both) {
    long left = enough;
    Scene<2> scene("court");
    const auto ball = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}}, "ball");
    scene.add(force_law(points(ball), [&left](auto /*t*/, auto /*r*/, auto v) {
      if (left-- <= 0) throw std::runtime_error("no more");
      return (vec(0.0, -9.81) - 0.0 * v).eval();
    }));
    scene.add(unilateral(holonomic(points(ball), [](auto r) { return r.y(); }), {.restitution = 0.3}));
    const Options options{.t_end = 1.0, .samples = 6, .stepper = stepper};
    const auto whole = simulate(scene, options);
    ASSERT_GT(whole.events().size(), 3U);
    for (long allowed = 0;; ++allowed) {
      left = enough;
      Simulation<2> run(scene, options);
      left = allowed;
      const auto first = failure_of([&] { (void)run.run(); });
      left = enough;
      if (!first) break;
      const double time = run.time();
      const Vec<2> position = run.position(ball);
      for (const auto& attempt : {failure_of([&] { (void)run.run(); }), failure_of([&] { run.step(); }),
                                  failure_of([&] { run.advance_to(1.0); })}) {
        ASSERT_TRUE(attempt) << allowed;
        EXPECT_EQ(std::string(attempt->what()), first->what());
      }
      EXPECT_EQ(run.time(), time);
      EXPECT_EQ(run.position(ball), position);
      const auto kept = first->trajectory<2>();
      for (std::size_t i = 0; i < kept.size(); ++i)
        EXPECT_EQ(kept.position(ball, i), whole.position(ball, i));
      for (std::size_t i = 0; i < kept.events().size(); ++i)
        EXPECT_EQ(kept.events()[i].time, whole.events()[i].time);
    }
  }
}

TEST(Failure, StatisticsAreCountedOnce) {
  const Faulty faulty = throwing_after(1.0);
  Simulation<2> simulation(faulty.scene, sampled(2.0));
  const auto failure = failure_of([&] { (void)simulation.run(); });
  ASSERT_TRUE(failure);
  const auto kept = failure->trajectory<2>().statistics();
  EXPECT_EQ(kept.steps, simulation.statistics().steps);
  EXPECT_EQ(kept.evaluations, simulation.statistics().evaluations);
  EXPECT_GT(kept.run_time, 0.0);
}

TEST(Failure, TheTrajectoryKnowsItsDimension) {
  const Faulty faulty = throwing_after(1.0);
  const auto failure = failure_of([&] { (void)simulate(faulty.scene, sampled(2.0)); });
  ASSERT_TRUE(failure);
  EXPECT_THROW((void)failure->trajectory<3>(), InvalidArgument);
}

TEST(Failure, StepsAreLimited) {
  const Pendulum pendulum;
  const auto failure = failure_of([&] { (void)simulate(pendulum.scene, {.t_end = 10.0, .max_steps = 50}); });
  ASSERT_TRUE(failure);
  EXPECT_THAT(failure->what(), AllOf(HasSubstr("max_steps = 50"), HasSubstr("raise it")));
  EXPECT_EQ(failure->trajectory<2>().statistics().steps, 50);
}

TEST(Failure, OfAnObserverReachesItsUser) {
  const Pendulum pendulum;
  EXPECT_THAT(
      [&] {
        simulate(pendulum.scene, {.t_end = 1.0},
                 [](const Sample<2>&) { throw std::runtime_error("disk full"); });
      },
      ThrowsMessage<std::runtime_error>(HasSubstr("disk full")));
}

}  // namespace
}  // namespace dalembert
