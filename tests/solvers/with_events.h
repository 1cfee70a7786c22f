#pragma once

#include "accurate_runs.h"
#include <dalembert/dalembert.h>
#include <dalembert/tests/both_steppers.h>

#include <gtest/gtest.h>

#include <algorithm>

/// Shared by the tests of events, contacts and friction, which hold of either stepper at any tolerance:
/// `INSTANTIATE_TEST_SUITE_P(Runs, Mine, at_tolerances, tolerance_name)`.
namespace dalembert {

/// For what is no question of the tolerance.
inline const auto at_usual_tolerance = both_steppers_at({usual_tolerance});
inline const auto at_tolerances = both_steppers_at({1e-5, usual_tolerance, 1e-12, 1e-13});

/// What a run of many steps may err by, as it says itself, relative to its length: of `ida` at tight
/// tolerances more than `bound`, as its steps, which err by a twentieth of the tolerance each, are thousands.
template <class Run>
[[nodiscard]] double error_of(const Run& run) {
  constexpr double most = 12.0;  // times what it says, see core/README.md
  return std::max(bound, most * run.statistics().accuracy);
}

class WithEvents : public testing::TestWithParam<StepperAt> {
 protected:
  WithEvents() { set(GetParam().tolerance); }
  ~WithEvents() override { set(usual_tolerance); }
  [[nodiscard]] static Options options(double t_end) {
    return {.t_end = t_end, .samples = 11, .tolerance = tolerance, .stepper = GetParam().stepper};
  }

 private:
  static void set(double next) {
    tolerance = next;
    bound = 100.0 * next;
  }
};

}  // namespace dalembert
