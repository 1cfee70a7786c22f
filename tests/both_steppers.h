#pragma once

#include <dalembert/solvers/base/options.h>

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

/// For tests that hold of either stepper: `INSTANTIATE_TEST_SUITE_P(Steppers, Mine, both_steppers,
/// stepper_name)`, or `both_steppers_at({1e-5, 1e-9}), tolerance_name`.
namespace dalembert {

inline const auto both_steppers = testing::Values(Stepper::ida, Stepper::erk);
inline std::string stepper_name(const testing::TestParamInfo<Stepper>& info) {
  return std::string(name(info.param));
}

/// How a test runs.
struct StepperAt {
  Stepper stepper;
  double tolerance;
  operator Stepper() const { return stepper; }  // NOLINT(google-explicit-constructor)
};

/// Among them 1e-9, 1e-10 or 1e-11: the one at which sanitizers run.
inline auto both_steppers_at(std::initializer_list<double> tolerances) {
  std::vector<StepperAt> all;
  for (const Stepper stepper : {Stepper::ida, Stepper::erk})
    for (const double tolerance : tolerances) all.push_back({stepper, tolerance});
  return testing::ValuesIn(all);
}
inline std::string tolerance_name(const testing::TestParamInfo<StepperAt>& info) {
  return name(info.param.stepper) + ("_" + std::to_string(-std::lround(std::log10(info.param.tolerance))));
}

}  // namespace dalembert
