#include "dalembert/tests/sweep/files.h"
#include "dalembert/tests/sweep/swing.h"
#include <dalembert/sweep/runs.h>
#include <dalembert/sweep/sweep.h>

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace dalembert::sweeps {
namespace {

using namespace testing_sweeps;
using ::testing::HasSubstr;

/// The message of what is thrown; empty if nothing is.
template <class F>
std::string error_of(const F& f) {
  try {
    f();
    return {};
  } catch (const Error& error) {
    return error.what();
  }
}

SweepOptions quietly(const std::string& file, int threads = 1) {
  return {.file = file, .run = swing_run, .threads = threads, .progress = false};
}

TEST(Sweep, EveryRowIsThatOfASingleRunToTheLastBit) {
  const Folder folder;
  const SweepSummary summary = sweep(angles(50), make_swing(), observe_swing(), quietly(folder / "a.h5"));
  EXPECT_EQ(summary.done, 50U);
  EXPECT_EQ(summary.failed, 0U);
  const auto angle = read_column(folder / "a.h5", "angle"), tension = read_column(folder / "a.h5", "tension"),
             x = read_column(folder / "a.h5", "x");
  ASSERT_EQ(angle.size(), 50U);
  EXPECT_EQ(angle.front(), 0.1);
  EXPECT_EQ(angle.back(), 3.0);
  for (std::size_t i = 0; i < angle.size(); ++i) {
    const Swing swing(angle[i]);
    const auto alone = seen(swing, simulate(swing.scene, swing_run));
    EXPECT_EQ(tension[i], alone[0]);
    EXPECT_EQ(x[i], alone[1]);
  }
}

TEST(Sweep, ThreadsGiveTheSameFileByteByByte) {
  const Folder folder;
  sweep(angles(500), make_swing(7), observe_swing(), quietly(folder / "one.h5"));
  for (const int threads : {2, 5}) {
    const std::string file = folder / std::to_string(threads);
    try {
      sweep(angles(500), make_swing(7), observe_swing(), quietly(file, threads));
    } catch (const InvalidArgument& error) {
      ASSERT_THAT(error.what(), HasSubstr("oneTBB"));
      GTEST_SKIP() << error.what();
    }
    EXPECT_EQ(bytes_of(file), bytes_of(folder / "one.h5"));
  }
}

/// By the energy theorem the tension at the bottom is m (3 g - 2 g cos angle); the largest of eleven samples
/// is no more than that.
TEST(Sweep, AFailedRunIsARowWithItsErrorAndItsTime) {
  const Folder folder;
  const SweepSummary summary = sweep(angles(30), make_swing(10), observe_swing(), quietly(folder / "a.h5"));
  EXPECT_EQ(summary.done, 30U);
  EXPECT_EQ(summary.failed, 3U);
  const auto failures = read_failures(folder / "a.h5");
  const auto angle = read_column(folder / "a.h5", "angle"), tension = read_column(folder / "a.h5", "tension");
  ASSERT_EQ(failures.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(failures[k].row, static_cast<std::int64_t>(10 * k + 9));
    EXPECT_THAT(failures[k].error, HasSubstr("a gale"));
    EXPECT_GT(failures[k].time, 0.0);
    EXPECT_LE(failures[k].time, 0.5);
  }
  for (std::size_t i = 0; i < 30; ++i) {
    EXPECT_EQ(std::isnan(tension[i]), i % 10 == 9);
    if (i % 10 == 9) continue;
    EXPECT_LE(tension[i], 9.81 * (3.0 - 2.0 * std::cos(angle[i])) * (1.0 + 1e-6));
  }
}

TEST(Sweep, WhatMakeThrowsIsARowWithoutATime) {
  const Folder folder;
  const auto make = [](const Row& row) {
    if (row.index() == 1) throw 42;
    return Swing(row["angle"], row.index() == 2 ? -1.0 : 1.0);
  };
  sweep(angles(4), make, observe_swing(), quietly(folder / "a.h5"));
  const auto failures = read_failures(folder / "a.h5");
  ASSERT_EQ(failures.size(), 2U);
  EXPECT_TRUE(std::isnan(failures[0].time));
  EXPECT_THAT(failures[0].error, HasSubstr("no std::exception"));
  EXPECT_THAT(failures[1].error, HasSubstr("length = -1"));
}

TEST(Sweep, AnObservationThatThrowsOrIsNaNIsAFailedRowAndInfinityIsNone) {
  const Folder folder;
  int calls = 0;
  const auto observe = observing({{"time of the event", "s"}}, [&calls](const Swing&, const auto&) {
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    constexpr double never = std::numeric_limits<double>::infinity();
    const int call = calls++;
    if (call == 0) throw std::runtime_error("no such event");
    return call == 1 ? nothing : never;
  });
  sweep(angles(3), make_swing(), observe, quietly(folder / "a.h5"));
  const auto failures = read_failures(folder / "a.h5");
  ASSERT_EQ(failures.size(), 2U);
  EXPECT_EQ(failures[0].error, "no such event");
  EXPECT_THAT(failures[1].error, HasSubstr("\"time of the event\" is NaN"));
  EXPECT_EQ(read_column(folder / "a.h5", "time of the event")[2], std::numeric_limits<double>::infinity());
}

TEST(Sweep, AnObservationOfAnotherLengthIsAFailedRow) {
  const Folder folder;
  const auto observe = observing({{"a"}, {"b"}}, [](const Swing&, const auto&) { return 1.0; });
  sweep(angles(2), make_swing(), observe, quietly(folder / "a.h5"));
  EXPECT_THAT(read_failures(folder / "a.h5").at(0).error, HasSubstr("1 numbers for 2 quantities (a, b)"));
}

TEST(Sweep, MakeMayGiveOptionsAndEvents) {
  struct Falling {
    Scene<2> scene{"falling"};
    Options options{};
    std::vector<Event<2>> events{};
  };
  const Folder folder;
  const auto make = [](const Row& row) {
    Falling made;
    made.scene.add(UniformGravity<2>{{0.0, -2.0}});
    const auto stone = made.scene.add_particle({.mass = 1.0, .position = {0.0, row["height"]}});
    made.options = {.t_end = 10.0, .tolerance = 1e-10, .stepper = Stepper::erk};
    made.events.push_back(
        {"lands", [=](const auto& now) { return now.position(stone).y(); }, Crossing::falling, true});
    return made;
  };
  const auto observe = observing(
      {{"time", "s"}}, [](const Falling&, const Trajectory<2>& run) { return run.events()[0].time; });
  sweep(grid({{"height", "m", 1.0, 4.0, 4}}), make, observe, quietly(folder / "a.h5"));
  const auto time = read_column(folder / "a.h5", "time");
  // h = g t^2/2 with g = 2; some tens of steps of 1e-10 each.
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(time[i], std::sqrt(1.0 + static_cast<double>(i)), 1e-8);
}

TEST(Sweep, ATrajectoryIsKeptWithTheLengthItHas) {
  const Folder folder;
  const auto like = Swing(1.0).scene;
  const auto make = [](const Row& row) {
    struct Made {
      Scene<2> scene;
      Options options;
    };
    return Made{Swing(row["angle"]).scene,
                {.t_end = 1.0, .samples = 2 + static_cast<int>(row.index()), .tolerance = 1e-8}};
  };
  const SweepSummary summary = sweep(angles(3), make, keep_trajectory(like), quietly(folder / "a.h5"));
  EXPECT_EQ(summary.failed, 0U);
  const auto first = read_column(folder / "a.h5", "first_sample"),
             samples = read_column(folder / "a.h5", "samples");
  EXPECT_EQ(first, (std::vector<double>{0.0, 2.0, 5.0}));
  EXPECT_EQ(samples, (std::vector<double>{2.0, 3.0, 4.0}));
}

TEST(Sweep, ARowNeedNotBeARun) {
  const Folder folder;
  const RowFunction square{{{"square"}},
                           {},
                           [](const Row& row) {
                             return RowResult{{row[0] * row[0]}, {}};
                           },
                           "x^2"};
  sweep_rows(grid({{"x", "", 0.0, 3.0, 4}}), square, quietly(folder / "a.h5"));
  EXPECT_EQ(read_column(folder / "a.h5", "square"), (std::vector<double>{0.0, 1.0, 4.0, 9.0}));
}

TEST(Sweep, DoesNothingTheSecondTime) {
  const Folder folder;
  sweep(angles(20), make_swing(5), observe_swing(), quietly(folder / "a.h5"));
  const std::string before = bytes_of(folder / "a.h5");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.journal"));
  const SweepSummary again = sweep(angles(20), make_swing(5), observe_swing(), quietly(folder / "a.h5"));
  EXPECT_EQ(again.done, 20U);
  EXPECT_EQ(again.found, 20U);
  EXPECT_EQ(again.failed, 4U);
  EXPECT_EQ(bytes_of(folder / "a.h5"), before);
}

/// Of all its rows one is computed again, the last.
TEST(Sweep, OfAnotherProgramIsNotTakenForDone) {
  const Folder folder;
  const auto run = [&](double factor) {
    int calls = 0;
    sweep_rows(grid({{"x", "", 1.0, 2.0, 10}}),
               {{{"y"}, {"z"}},
                {},
                [&](const Row& row) {
                  return ++calls, RowResult{{1.0, factor * row["x"]}, {}};
                },
                ""},
               {.file = folder / "a.h5", .threads = 1, .progress = false});
    return calls;
  };
  EXPECT_EQ(run(1.0), 10);
  EXPECT_EQ(run(1.0), 1);
  EXPECT_THAT(error_of([&] { run(1.0 + 1e-15); }), HasSubstr("has the program changed since"));
  const auto fails = [&] {
    sweep_rows(grid({{"x", "", 1.0, 2.0, 10}}),
               {{{"y"}, {"z"}}, {}, [](const Row&) -> RowResult { throw Error("fails"); }, ""},
               {.file = folder / "a.h5", .threads = 1, .progress = false});
  };
  EXPECT_THAT(error_of(fails), HasSubstr("row 9 comes out otherwise"));
}

TEST(Sweep, EndsItsLogWithWhatIsDone) {
  const Folder folder;
  SweepOptions options = quietly(folder / "a.h5");
  options.log = folder / "a.log";
  sweep(angles(8), make_swing(4), observe_swing(), options);
  EXPECT_THAT(bytes_of(folder / "a.log"), HasSubstr("8 of 8 rows (100 %)"));
  EXPECT_THAT(bytes_of(folder / "a.log"), HasSubstr("2 failed"));
  options.file = folder / "b.h5";
  options.log = "/nowhere/a.log";
  EXPECT_THAT(error_of([&] { sweep(angles(8), make_swing(), observe_swing(), options); }),
              HasSubstr("the log /nowhere/a.log cannot be written"));
}

TEST(SweepErrors, NameAColumnThatIsNotThere) {
  const Folder folder;
  sweep(angles(2), make_swing(), observe_swing(), quietly(folder / "a.h5"));
  EXPECT_THAT(error_of([&] { (void)read_column(folder / "a.h5", "force"); }),
              HasSubstr("no column \"force\""));
  EXPECT_THAT(error_of([&] { (void)read_column(folder / "b.h5", "force"); }), HasSubstr("cannot be read"));
}

TEST(SweepErrors, SayThatThereIsNothingToSweepOrToObserve) {
  const Folder folder;
  EXPECT_THAT(error_of([] { angles(0); }), HasSubstr("empty table"));
  EXPECT_THAT(error_of([] { (void)grid({}); }), HasSubstr("no columns"));
  EXPECT_THAT(error_of([&] { sweep(angles(2), make_swing(), observe_swing(), {.run = swing_run}); }),
              HasSubstr("option file"));
  EXPECT_THAT(error_of([&] {
                sweep(angles(2), make_swing(), observing({}, [](const auto&, const auto&) { return 1.0; }),
                      quietly(folder / "a.h5"));
              }),
              HasSubstr("nothing is observed"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h5"));
}

TEST(SweepErrors, NameTheColumnThatIsThereTwice) {
  const Folder folder;
  EXPECT_THAT(error_of([] {
                (void)grid({{"k", "", 0.0, 1.0, 2}, {"k", "", 0.0, 1.0, 2}});
              }),
              HasSubstr("two columns are called \"k\""));
  EXPECT_THAT(error_of([&] {
                sweep(angles(2), make_swing(),
                      observing({{"angle"}}, [](const auto&, const auto&) { return 1.0; }),
                      quietly(folder / "a.h5"));
              }),
              HasSubstr("two columns are called \"angle\""));
  EXPECT_THAT(error_of([&] {
                sweep(angles(2), make_swing(),
                      observing({{"state"}}, [](const auto&, const auto&) { return 1.0; }),
                      quietly(folder / "a.h5"));
              }),
              HasSubstr("\"state\""));
}

TEST(SweepErrors, AFileOfAnotherSweepIsNamedAndStaysAsItIs) {
  const Folder folder;
  const std::string file = folder / "a.h5";
  sweep(angles(5), make_swing(), observe_swing(), quietly(file));
  const std::string before = bytes_of(file);
  EXPECT_THAT(error_of([&] { sweep(angles(6), make_swing(), observe_swing(), quietly(file)); }),
              testing::AllOf(HasSubstr("another sweep"), HasSubstr("in 5 values"), HasSubstr("in 6 values")));
  SweepOptions looser = quietly(file);
  looser.run.tolerance = 1e-6;
  EXPECT_THAT(error_of([&] { sweep(angles(5), make_swing(), observe_swing(), looser); }),
              HasSubstr("tolerance 1e-06"));
  EXPECT_EQ(bytes_of(file), before);
}

TEST(SweepErrors, AFileThatIsNoSweepStaysAsItIs) {
  const Folder folder;
  const std::string file = folder / "a.h5", other = folder / "b.h5";
  write(file, "my thesis");
  EXPECT_THAT(error_of([&] { sweep(angles(5), make_swing(), observe_swing(), quietly(file)); }),
              HasSubstr("is no dataset of a sweep"));
  EXPECT_EQ(bytes_of(file), "my thesis");
  write(other + ".journal", "dear diary");
  EXPECT_THAT(error_of([&] { sweep(angles(5), make_swing(), observe_swing(), quietly(other)); }),
              HasSubstr("is no journal"));
  EXPECT_EQ(bytes_of(other + ".journal"), "dear diary");
}

TEST(SweepErrors, NameAFolderThatIsNotThere) {
  EXPECT_THAT(error_of([&] { sweep(angles(5), make_swing(), observe_swing(), quietly("/nowhere/a.h5")); }),
              HasSubstr("does its folder exist"));
}

}  // namespace
}  // namespace dalembert::sweeps
