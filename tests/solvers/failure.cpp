#include "failure_of.h"
#include "readings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace dalembert::failure_test {
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

/// Where its steps came to: a run that is asked to go there only, by the same steps, does so.
TEST(Failure, ASimulationCanStillBeReadAtItsLastGoodInstant) {
  const Faulty faulty = throwing_after(1.0);
  Simulation<2> simulation(faulty.scene, sampled(2.0));
  simulation.advance_to(0.5);
  EXPECT_THROW(simulation.advance_to(1.5), IntegrationFailure);
  EXPECT_GT(simulation.time(), 0.5);
  EXPECT_LE(simulation.time(), 1.0);
  Simulation<2> good(faulty.scene, sampled(2.0));
  good.advance_to(simulation.time());
  // Both read a node of the same steps, but for round-off of the projection.
  EXPECT_LE((simulation.position(faulty.bob) - good.position(faulty.bob)).norm(), 1e-12);
  const Vec<2> force = good.constraint_force(faulty.bob);
  EXPECT_LE((simulation.constraint_force(faulty.bob) - force).norm(), 1e-10 * force.norm());
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

TEST(Failure, ExceptionOfAnObserverReachesItsUser) {
  const Pendulum pendulum;
  EXPECT_THAT(
      [&] {
        simulate(pendulum.scene, {.t_end = 1.0},
                 [](const Sample<2>&) { throw std::runtime_error("disk full"); });
      },
      ThrowsMessage<std::runtime_error>(HasSubstr("disk full")));
}

}  // namespace
}  // namespace dalembert::failure_test
