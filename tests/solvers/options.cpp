#include "scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dalembert::options_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// That a run refuses these options, naming one and its rule.
void expect_refused(const Options& options, const std::string& option, const std::string& rule) {
  EXPECT_THAT([&] { (void)simulate(Pendulum().scene, options); },
              ThrowsMessage<InvalidArgument>(AllOf(HasSubstr("Option " + option + " = "), HasSubstr(rule))));
}

TEST(Options, TheEndMustComeAfterTheStart) {
  for (const double t_end : {0.0, -1.0, nan, infinity}) {
    expect_refused({.t_end = t_end}, "t_end", "later than t_start = 0");
  }
  expect_refused({.t_end = 1.0, .t_start = 2.0}, "t_end", "later than t_start = 2");
  expect_refused({.t_end = 1.0, .t_start = nan}, "t_start", "must be finite");
  expect_refused({}, "t_end", "later than");
}

TEST(Options, ThereMustBeTwoSamplesAtLeast) {
  for (const int samples : {1, 0, -3})
    expect_refused({.t_end = 1.0, .samples = samples}, "samples", "at least 2");
}

TEST(Options, SamplesHaveABound) {
  expect_refused({.t_end = 1.0, .samples = 2'000'000'000}, "samples", "more than 1e8 samples");
}

TEST(Options, TheLengthMustBeFiniteAndNotNegative) {
  for (const double length : {-1.0, nan, infinity})
    expect_refused({.t_end = 1.0, .length = length}, "length", "must be finite and > 0, or 0");
}

TEST(Options, TheIntervalMustBePositive) {
  for (const double interval : {-1.0, nan, infinity}) {
    expect_refused({.t_end = 1.0, .sample_interval = interval}, "sample_interval", "must be finite and > 0");
  }
  expect_refused({.t_end = 1.0, .sample_interval = 1.5}, "sample_interval", "longer than the run");
  EXPECT_THAT(sample_times({.t_end = 1.0, .sample_interval = 1.0}), ElementsAre(0.0, 1.0));
  expect_refused({.t_end = 1.0, .sample_interval = 1e-10}, "sample_interval", "1e8 samples");
}

TEST(Options, TheToleranceMustBeOneThatDoublePrecisionCanDeliver) {
  for (const double tolerance : {0.0, -1e-6, 1e-14, 0.2, nan, infinity}) {
    expect_refused({.t_end = 1.0, .tolerance = tolerance}, "tolerance",
                   "between 1e-13, what double precision can");
  }
}

TEST(Options, StepsMustBeAllowed) {
  expect_refused({.t_end = 1.0, .max_steps = 0}, "max_steps", "must be > 0");
  expect_refused({.t_end = 1.0, .max_step = -0.1}, "max_step", "0 for none");
  expect_refused({.t_end = 1.0, .max_step = std::nan("")}, "max_step", "0 for none");
}

TEST(Options, TimesMustIncreaseWithinTheRun) {
  expect_refused({.t_end = 1.0, .times = {0.0, 0.5, 0.5}}, "times", "must increase");
  expect_refused({.t_end = 1.0, .times = {0.5, 1.5}}, "times", "between t_start and t_end");
  expect_refused({.t_end = 1.0, .times = {-0.5, 0.5}}, "times", "between t_start and t_end");
  expect_refused({.t_end = 1.0, .times = {nan}}, "times", "between t_start and t_end");
  expect_refused({.t_end = 1.0, .sample_interval = 0.1, .times = {0.5}}, "sample_interval", "not both");
}

TEST(Options, SamplesAreEquallySpacedWithOneAtEitherEnd) {
  EXPECT_THAT(sample_times({.t_end = 3.0, .t_start = 1.0, .samples = 5}),
              ElementsAre(1.0, 1.5, 2.0, 2.5, 3.0));
}

// 0.3 / 0.1 is less than 3 in doubles; the sample at the end must not be lost for that.
TEST(Options, AnIntervalThatDividesTheRunReachesItsEnd) {
  const auto times = sample_times({.t_end = 0.3, .sample_interval = 0.1});
  ASSERT_EQ(times.size(), 4U);
  EXPECT_EQ(times.back(), 0.3);
  EXPECT_THAT(sample_times({.t_end = 1.0, .sample_interval = 0.4}), ElementsAre(0.0, 0.4, 0.8));
}

TEST(Options, GivenTimesAreTaken) {
  EXPECT_THAT(sample_times({.t_end = 1.0, .times = {0.1, 0.7}}), ElementsAre(0.1, 0.7));
}

}  // namespace
}  // namespace dalembert::options_test
