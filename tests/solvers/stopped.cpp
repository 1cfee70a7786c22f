#include "counted_new.h"
#include "failure_of.h"
#include "readings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <sstream>
#include <stdexcept>

namespace dalembert::stopped_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A run may fail anywhere: half way through a step, the search for an impact, or the impact. From there it
/// would lose the impact or pass it twice, so it is not gone on with, even where the fault is mended. What it
/// gave until then can be read.
TEST(StoppedRun, IsNotGoneOnWith) {
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
    std::vector<Event<2>> marks;  // several in one step
    for (const double height : {0.502, 0.501, 0.5})
      marks.push_back({.name = "mark",
                       .function = [=](const Sample<2>& now) { return now.position(ball).y() - height; }});
    // One run per evaluation: a loose tolerance keeps them few.
    const Options options{.t_end = 1.0, .samples = 6, .tolerance = 1e-4, .stepper = stepper, .dense = true};
    const auto whole = simulate(scene, options, marks);
    ASSERT_GT(whole.events().size(), 6U);
    for (long allowed = 0;; ++allowed) {
      left = enough;
      Simulation<2> run(scene, options, marks);
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
      for (std::size_t i = 0; i < kept.events().size(); ++i) {
        EXPECT_EQ(kept.events()[i].time, whole.events()[i].time);
        if (kept.events()[i].kind == EventKind::rested) continue;  // at the limit of its impacts, still ahead
        EXPECT_LE(kept.events()[i].time, first->time());
        EXPECT_NO_THROW((void)kept.at({kept.events()[i].time}));
      }
    }
  }
}

/// That `run` fails, and again in the same way.
std::string stopped_for_good(Simulation<2>& run) {
  const auto first = failure_of([&] { (void)run.run(); });
  const auto second = failure_of([&] { (void)run.run(); });
  if (!first || !second) return "not stopped";
  EXPECT_EQ(std::string(second->what()), first->what());
  return first->what();
}

TEST(StoppedRun, NamesAnEventThatThrewAnything) {
  Pendulum pendulum;
  const auto at_half = [](const Sample<2>& now) { return now.time() - 0.5; };
  const Event<2> reading{.name = "reading", .function = [](const Sample<2>& now) {
                           if (now.time() > 0.5) throw 42;
                           return 1.0;
                         }};
  const Event<2> change{.name = "change", .function = at_half, .change = [](Scene<2>&) { throw 42; }};
  for (const Event<2>& event : {reading, change}) {
    for (const Stepper stepper : both) {
      Simulation<2> run(pendulum.scene, {.t_end = 1.0, .stepper = stepper}, {event});
      EXPECT_THAT(stopped_for_good(run), AllOf(HasSubstr("\"" + event.name + "\""),
                                               HasSubstr("threw something that is no std::exception")));
    }
  }
}

TEST(StoppedRun, NamesAnEventThatThrewAnythingAtTheStart) {
  Pendulum pendulum;
  const Event<2> reading{.name = "reading", .function = [](const Sample<2>&) -> double { throw 42; }};
  EXPECT_THAT([&] { (void)simulate(pendulum.scene, {.t_end = 1.0}, {reading}); },
              testing::ThrowsMessage<Error>(
                  AllOf(HasSubstr("\"reading\""), HasSubstr("threw something that is no std::exception"))));
}

/// A second table makes undetermined what friction reads: at the start that is an InconsistentStart.
TEST(StoppedRun, IsThatWhoseChangeMadeUndeterminedWhatAForceReads) {
  Scene<2> scene("two tables");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto block = scene.add_particle({.mass = 1.0, .velocity = {3.0, 0.0}}, "block");
  const auto table = scene.add(OnCurve{block, Plane<2>{}}, "table");
  const auto again = scene.add(OnCurve{block, Plane<2>{}}, "again");
  scene.release(again);
  scene.add(friction_law(table, points(block),
                         [](auto N, auto, auto v) { return (-0.1 * abs(N) * v.normalized()).eval(); }));
  const Event<2> imposed{.name = "imposed",
                         .function = [](const Sample<2>& now) { return now.time() - 0.55; },
                         .change = [again](Scene<2>& changed) { changed.impose(again); }};
  for (const Stepper stepper : both) {
    Simulation<2> run(scene, {.t_end = 1.0, .samples = 11, .stepper = stepper}, {imposed});
    EXPECT_THAT(stopped_for_good(run), AllOf(HasSubstr("\"table\""), HasSubstr("redundant")));
    EXPECT_EQ(failure_of([&] { run.step(); })->trajectory<2>().size(), 6U);
  }
}

/// Wherever memory is lacking once, what that left behind is not gone on with.
TEST(StoppedRun, IsNotGoneOnWithAfterALackOfMemory) {
  Scene<2> scene("court");
  const auto ball = scene.add_particle({.mass = 1.0, .position = {0.0, 0.1}}, "ball");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  scene.add(unilateral(holonomic(points(ball), [](auto r) { return r.y(); }), {.restitution = 0.5}));
  for (const Stepper stepper : both) {
    const auto whole = simulate(scene, {.t_end = 0.2, .samples = 3, .stepper = stepper});
    ASSERT_EQ(whole.events().size(), 1U);
    for (long allowed = 0;; ++allowed) {
      Simulation<2> run(scene, {.t_end = 0.2, .samples = 3, .stepper = stepper});
      const LackOfMemory lack(allowed);
      bool failed = false;
      try {
        run.advance_to(0.2);
      } catch (const std::exception&) {
        failed = true;
      }
      if (!lack.came()) break;
      EXPECT_EQ(failure_of([&] { (void)run.run(); }).has_value(), failed) << allowed;
    }
  }
}

/// Where the first sample lies behind the failure, the run so far has none: its table has a head only.
TEST(StoppedRun, WithoutASampleIsATableWithoutRows) {
  Pendulum pendulum;
  pendulum.scene.add(force_law(points(pendulum.bob), [](auto t, auto /*r*/, auto v) {
    if (t > 0.3) throw std::runtime_error("no more");
    return (-0.1 * v).eval();
  }));
  for (const Stepper stepper : both) {
    const auto failure = failure_of([&] {
      (void)simulate(pendulum.scene, {.t_end = 1.0, .times = {0.5, 1.0}, .stepper = stepper});
    });
    ASSERT_TRUE(failure);
    const auto kept = failure->trajectory<2>();
    EXPECT_EQ(kept.size(), 0U);
    std::ostringstream table;
    kept.write_csv(table);
    std::istringstream lines(table.str());
    std::string last;
    for (std::string line; std::getline(lines, line);) last = line;
    EXPECT_EQ(last.substr(0, 2), "t,");
  }
}

/// What steps reached before the fault at t = 0.3 can be read: its energy is that of the start but for the
/// tolerance.
TEST(StoppedRun, StandsWhereItsStepsCameTo) {
  Pendulum pendulum;
  pendulum.scene.add(force_law(points(pendulum.bob), [](auto t, auto /*r*/, auto v) {
    if (t > 0.3) throw std::runtime_error("no more");
    return (0.0 * v).eval();
  }));
  for (const Stepper stepper : both) {
    Simulation<2> run(pendulum.scene, {.t_end = 1.0, .tolerance = 1e-8, .stepper = stepper});
    const double energy = run.energy();
    ASSERT_TRUE(failure_of([&] { run.advance_to(1.0); }));
    EXPECT_GT(run.time(), 0.2);
    EXPECT_LE(run.time(), 0.3);
    EXPECT_NEAR(run.energy(), energy, 1e-4);
  }
}

}  // namespace
}  // namespace dalembert::stopped_test
