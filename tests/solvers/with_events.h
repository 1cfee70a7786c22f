#pragma once

#include "accurate_runs.h"
#include <dalembert/dalembert.h>
#include <dalembert/tests/both_steppers.h>

#include <gtest/gtest.h>

/// Shared by the tests of events, contacts and friction.
namespace dalembert {

class WithEvents : public testing::TestWithParam<Stepper> {
 protected:
  [[nodiscard]] static Options options(double t_end) {
    return {.t_end = t_end, .samples = 11, .tolerance = tolerance, .stepper = GetParam()};
  }
};

}  // namespace dalembert
