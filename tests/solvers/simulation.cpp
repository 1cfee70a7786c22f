#include "scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ctime>

namespace dalembert::simulation_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Every number of an instant.
std::vector<double> numbers(const FlatSample& s) {
  std::vector<double> all{s.time, s.energy};
  for (const auto& part : {s.q, s.v, s.a, s.lambda, s.forces})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

TEST(Simulation, TwoIdenticalRunsGiveTheSameBits) {
  const Options options{.t_end = 2.0, .samples = 21, .tolerance = 1e-8};
  const auto once = simulate(EachKind().scene, options);
  const auto again = simulate(EachKind().scene, options);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(numbers(once.sample(i).flat()), numbers(again.sample(i).flat()));
  }
  EXPECT_EQ(once.statistics().steps, again.statistics().steps);
  EXPECT_EQ(once.statistics().evaluations, again.statistics().evaluations);
  EXPECT_EQ(once.statistics().factorisations, again.statistics().factorisations);
}

TEST(Simulation, AnObserverSeesTheSamplesOfTheTrajectory) {
  const EachKind each;
  const Options options{.t_end = 1.0, .samples = 11};
  const auto run = simulate(each.scene, options);
  std::size_t i = 0;
  const Statistics statistics = simulate(each.scene, options, [&](const Sample<2>& sample) {
    ASSERT_LT(i, run.size());
    EXPECT_EQ(numbers(sample.flat()), numbers(run.sample(i).flat()));
    EXPECT_EQ(sample.position(each.bead), run.position(each.bead, i));
    ++i;
  });
  EXPECT_EQ(i, run.size());
  EXPECT_EQ(statistics.steps, run.statistics().steps);
}

TEST(Simulation, SamplesDoNotInfluenceTheSteps) {
  const EachKind each;
  const auto few = simulate(each.scene, {.t_end = 1.0, .samples = 3});
  const auto many = simulate(each.scene, {.t_end = 1.0, .samples = 1001});
  EXPECT_EQ(few.statistics().steps, many.statistics().steps);
  // The projection of a sample keeps the pivots of the sample before: positions, all smaller than 4, agree to
  // the 1e-15 of the length 4 that the projection stops at, and its round-off.
  for (std::size_t i = 0; i < few.size(); ++i) {
    for (const auto p : {each.upper, each.lower, each.bead, each.rider, each.skate}) {
      EXPECT_LE((few.position(p, i) - many.position(p, 500 * i)).norm(), 2.0 * (1e-15 * 4.0 + 4.0 * 2.3e-16));
    }
  }
}

// The pendulum for 3 s. An error made in a step grows at most linearly in time here (the motion is
// regular, its period depends on its energy), by a factor of about 1 + 3 omega; each step of the coarse
// run contributes tolerance times (length + |q|) at most.
TEST(Simulation, TimesBetweenStepsAreAsAccurateAsSteps) {
  const Pendulum pendulum;
  const std::vector<double> times{0.123, 0.7, 1.2345, 2.5, 2.999};
  const auto coarse = simulate(pendulum.scene, {.t_end = 3.0, .times = times, .tolerance = 1e-7});
  const auto fine = simulate(pendulum.scene, {.t_end = 3.0, .times = times, .tolerance = 1e-11});
  ASSERT_EQ(coarse.size(), times.size());
  const double bound =
      1e-7 * 2.0 * static_cast<double>(coarse.statistics().steps) * (1.0 + 3.0 * std::sqrt(9.81));
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_EQ(coarse.times()[i], times[i]);
    EXPECT_LE((coarse.position(pendulum.bob, i) - fine.position(pendulum.bob, i)).norm(), bound);
  }
}

TEST(Simulation, AnIntervalGivesTheSamplesOfItsTimes) {
  const Pendulum pendulum;
  const auto by_interval = simulate(pendulum.scene, {.t_end = 1.0, .sample_interval = 0.25});
  const auto by_number = simulate(pendulum.scene, {.t_end = 1.0, .samples = 5});
  ASSERT_EQ(by_interval.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(numbers(by_interval.sample(i).flat()), numbers(by_number.sample(i).flat()));
  }
}

// Round-off of a norm and of a product, each of a few operations, times the number of iterations that
// settle it: the output projection ends at 1e-15 of the length or where it no longer improves.
TEST(Simulation, SamplesObeyTheConstraintsToRoundOff) {
  const Pendulum pendulum;
  const auto run = simulate(pendulum.scene, {.t_end = 3.0, .tolerance = 1e-4});
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Vec<2> r = run.position(pendulum.bob, i);
    EXPECT_NEAR(r.norm(), 1.0, 1e-15);
    EXPECT_NEAR(r.dot(run.velocity(pendulum.bob, i)), 0.0, 16.0 * 2.3e-16 * std::sqrt(2.0 * 9.81));
  }
  EXPECT_LE(run.statistics().residual_position, 1e-15);
}

TEST(Simulation, BeginsAtTheStart) {
  const Pendulum pendulum;
  const Simulation<2> simulation(pendulum.scene, {.t_end = 8.0, .t_start = 5.0});
  EXPECT_EQ(simulation.time(), 5.0);
  EXPECT_EQ(simulation.position(pendulum.bob), Vec<2>(1.0, 0.0));
  EXPECT_EQ(simulation.velocity(pendulum.bob), Vec<2>::Zero());
  EXPECT_EQ(simulation.energy(), 0.0);
  EXPECT_EQ(simulation.statistics().steps, 0);
}

TEST(Simulation, AdvancesToTheSamplesOfARun) {
  const EachKind each;
  const Options options{.t_end = 1.0, .samples = 5, .tolerance = 1e-7};
  const auto run = simulate(each.scene, options);
  Simulation<2> simulation(each.scene, options);
  for (std::size_t i = 0; i < run.size(); ++i) {
    simulation.advance_to(run.times()[i]);
    EXPECT_EQ(numbers(simulation.sample().flat()), numbers(run.sample(i).flat()));
  }
}

TEST(Simulation, StepsForwardUntilItsEnd) {
  const Pendulum pendulum;
  Simulation<2> simulation(pendulum.scene, {.t_end = 0.5});
  double before = 0.0;
  long steps = 0;
  while (simulation.time() < 0.5) {
    simulation.step();
    EXPECT_GT(simulation.time(), before);
    before = simulation.time();
    EXPECT_EQ(simulation.statistics().steps, ++steps);
  }
  EXPECT_EQ(simulation.time(), 0.5);
  EXPECT_THAT([&] { simulation.step(); },
              ThrowsMessage<InvalidArgument>(HasSubstr("t_end = 0.5 is reached")));
  EXPECT_EQ(simulation.time(), 0.5);
}

TEST(Simulation, StepsAndAdvancesInTurn) {
  const Pendulum pendulum;
  Simulation<2> simulation(pendulum.scene, {.t_end = 2.0});
  simulation.advance_to(0.3);
  simulation.advance_to(0.3);
  EXPECT_EQ(simulation.time(), 0.3);
  simulation.step();
  EXPECT_GE(simulation.time(), 0.3);
  simulation.advance_to(2.0);
  EXPECT_EQ(simulation.time(), 2.0);
}

TEST(Simulation, DoesNotAdvanceBackwardsOrBeyondItsEnd) {
  const Pendulum pendulum;
  Simulation<2> simulation(pendulum.scene, {.t_end = 1.0});
  simulation.advance_to(0.5);
  for (const double t : {0.4, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT([&] { simulation.advance_to(t); },
                ThrowsMessage<InvalidArgument>(
                    AllOf(HasSubstr("advance_to("), HasSubstr("current time 0.5"), HasSubstr("t_end = 1"))));
  }
  EXPECT_EQ(simulation.time(), 0.5);
}

TEST(Simulation, OutlivesItsScene) {
  auto pendulum = std::make_unique<Pendulum>();
  const auto bob = pendulum->bob;
  Simulation<2> simulation(pendulum->scene, {.t_end = 1.0});
  pendulum.reset();
  simulation.advance_to(1.0);
  EXPECT_NEAR(simulation.position(bob).norm(), 1.0, 1e-15);
}

TEST(Simulation, CanBeMovedInMidRun) {
  const Pendulum pendulum;
  Simulation<2> first(pendulum.scene, {.t_end = 1.0});
  first.advance_to(0.5);
  Simulation<2> second = std::move(first);
  second.advance_to(1.0);
  Simulation<2> straight(pendulum.scene, {.t_end = 1.0});
  straight.advance_to(0.5);
  straight.advance_to(1.0);
  EXPECT_EQ(numbers(second.sample().flat()), numbers(straight.sample().flat()));
}

TEST(Simulation, ASecondRunHoldsOnlyWhatIsLeft) {
  const Pendulum pendulum;
  Simulation<2> simulation(pendulum.scene, {.t_end = 1.0, .samples = 5});
  EXPECT_EQ(simulation.run().size(), 5U);
  EXPECT_EQ(simulation.run().size(), 1U);  // the last instant, where it stands
}

TEST(Simulation, RefusesAForeignHandle) {
  const Pendulum pendulum, other;
  const Simulation<2> simulation(pendulum.scene, {.t_end = 1.0});
  EXPECT_THROW((void)simulation.position(other.bob), InvalidArgument);
  EXPECT_THROW((void)simulation.multiplier(other.rod), InvalidArgument);
}

/// The box around the pivot and the bob is 1 m long, or what the options say; in its time gravity moves the
/// bob by that length.
TEST(Simulation, StatisticsSayLengthAndTime) {
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    const Statistics own = simulate(Pendulum().scene, {.t_end = 1.0, .stepper = stepper}).statistics();
    EXPECT_EQ(own.length, 1.0);
    EXPECT_DOUBLE_EQ(own.time, 1.0 / std::sqrt(9.81));
    const Statistics given =
        simulate(Pendulum().scene, {.t_end = 1.0, .stepper = stepper, .length = 0.25}).statistics();
    EXPECT_EQ(given.length, 0.25);
    EXPECT_DOUBLE_EQ(given.time, 0.5 / std::sqrt(9.81));
  }
}

/// A stone that falls from rest has come g t^2/2 far, and moves by that in t/2.
TEST(Simulation, ALoneParticleHasTheLengthOfItsPath) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  scene.add_particle({.mass = 1.0});
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    const Statistics s = simulate(scene, {.t_end = 2.0, .stepper = stepper}).statistics();
    EXPECT_NEAR(s.length, 0.5 * 9.81 * 4.0, 1e-4);
    EXPECT_NEAR(s.time, 1.0, 1e-4);
  }
}

/// Both say the same, and neither has moved anything.
TEST(Simulation, StepAndAdvanceEndAlike) {
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    const Pendulum pendulum;
    Simulation<2> simulation(pendulum.scene, {.t_end = 1.0, .stepper = stepper});
    simulation.advance_to(1.0);
    simulation.advance_to(1.0);
    const double energy = simulation.energy();
    EXPECT_THROW(simulation.step(), InvalidArgument);
    EXPECT_THROW(simulation.advance_to(1.5), InvalidArgument);
    EXPECT_EQ(simulation.time(), 1.0);
    EXPECT_EQ(simulation.energy(), energy);
  }
}

/// The stepper may have reached t_end while the simulation stands before it.
TEST(Simulation, StepsToTheEndFromAnywhereBefore) {
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    const Pendulum pendulum;
    Simulation<2> simulation(pendulum.scene, {.t_end = 0.5, .stepper = stepper});
    simulation.advance_to(std::nextafter(0.5, 0.0));
    simulation.step();
    EXPECT_EQ(simulation.time(), 0.5);
    EXPECT_THROW(simulation.step(), InvalidArgument);
  }
}

/// It is no fault of the run.
/// Processor time of the process [s].
double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

TEST(Simulation, RunTimeIsThatOfTheLibraryInEveryWayToRun) {
  const EachKind each;
  const Options options{.t_end = 1.0, .samples = 11};
  EXPECT_GT(simulate(each.scene, options).statistics().run_time, 0.0);
  Simulation<2> sim(each.scene, options);
  EXPECT_EQ(sim.statistics().run_time, 0.0);
  sim.step();
  const double first = sim.statistics().run_time;
  EXPECT_GT(first, 0.0);
  sim.advance_to(0.5);
  EXPECT_GT(sim.statistics().run_time, first);
  // An observer that takes far longer than the run, 0.2 s in all, does not count.
  const Statistics observed = simulate(each.scene, options, [](const Sample<2>&) {
    const double since = processor_time();
    while (processor_time() - since < 0.02) {
    }
  });
  EXPECT_GT(observed.run_time, 0.0);
  EXPECT_LT(observed.run_time, 0.2);
}

TEST(Simulation, WhatAnObserverThrowsIsItsOwn) {
  const Pendulum pendulum;
  const auto late = driven([](auto t) { return vec(1.0 / (t - 0.5), 0.0); });
  EXPECT_THROW((void)simulate(pendulum.scene, {.t_end = 1.0, .samples = 11},
                              [&](const Sample<2>& now) { (void)now.position(late); }),
               EquationFault);
}

TEST(Simulation, ThatWasMovedSaysSo) {
  const Pendulum pendulum;
  Simulation<2> first(pendulum.scene, {.t_end = 1.0});
  first.step();
  const double time = first.time();
  Simulation<2> second(std::move(first));
  EXPECT_EQ(second.time(), time);
  const auto moved = ThrowsMessage<InvalidArgument>(HasSubstr("moved"));
  EXPECT_THAT([&] { (void)first.time(); }, moved);  // NOLINT(bugprone-use-after-move)
  EXPECT_THAT([&] { first.step(); }, moved);
  EXPECT_THAT([&] { first.advance_to(1.0); }, moved);
  EXPECT_THAT([&] { (void)first.run(); }, moved);
  EXPECT_THAT([&] { (void)first.events(); }, moved);
  EXPECT_THAT([&] { (void)first.statistics(); }, moved);
}

/// Results share their numbers: what was moved can be read as before.
TEST(Simulation, ResultsThatWereMovedCanBeRead) {
  const Pendulum pendulum;
  auto run = simulate(pendulum.scene, {.t_end = 1.0, .samples = 11});
  const auto taken = std::move(run);
  EXPECT_EQ(run.size(), 11U);  // NOLINT(bugprone-use-after-move)
  EXPECT_EQ(run.position(pendulum.bob, 10), taken.position(pendulum.bob, 10));
}

TEST(Simulation, NamesTheOptionThatKeepsStepsShort) {
  const Pendulum pendulum;
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    EXPECT_THAT(
        [&] {
          (void)simulate(pendulum.scene,
                         {.t_end = 1.0, .stepper = stepper, .max_steps = 50, .max_step = 1e-3});
        },
        ThrowsMessage<IntegrationFailure>(HasSubstr("raise it, or max_step")));
  }
}

}  // namespace
}  // namespace dalembert::simulation_test
