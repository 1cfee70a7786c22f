#pragma once

#include <dalembert/dalembert.h>
#include <dalembert/tests/both_steppers.h>

#include <gtest/gtest.h>

/// Shared by the tests of events, contacts and friction.
namespace dalembert {

constexpr double g = 9.81, tolerance = 1e-10;
/// A run of a few seconds errs by some tens of its tolerance, and so do the times at which it gets anywhere.
constexpr double bound = 100.0 * tolerance;

class WithEvents : public testing::TestWithParam<Stepper> {
 protected:
  [[nodiscard]] static Options options(double t_end) {
    return {.t_end = t_end, .samples = 11, .tolerance = tolerance, .stepper = GetParam()};
  }
};

}  // namespace dalembert
