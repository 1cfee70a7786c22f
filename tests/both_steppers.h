#pragma once

#include <dalembert/solvers/base/options.h>

#include <gtest/gtest.h>

#include <string>

/// For tests that hold of either stepper: `INSTANTIATE_TEST_SUITE_P(Steppers, Mine, both_steppers,
/// stepper_name)`.
namespace dalembert {

inline const auto both_steppers = testing::Values(Stepper::ida, Stepper::erk);
inline std::string stepper_name(const testing::TestParamInfo<Stepper>& info) {
  return std::string(name(info.param));
}

}  // namespace dalembert
