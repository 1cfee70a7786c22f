#pragma once

#include "accurate_runs.h"
#include <dalembert/dalembert.h>
#include <dalembert/tests/both_steppers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

/// Shared by the tests of events, contacts and friction, which hold of either stepper at any tolerance:
/// `INSTANTIATE_TEST_SUITE_P(Runs, Mine, at_tolerances, tolerance_name)`.
namespace dalembert {

struct OfRun {
  Stepper stepper;
  double tolerance;
  operator Stepper() const { return stepper; }  // NOLINT(google-explicit-constructor)
};

/// For what is no question of the tolerance.
inline const auto at_usual_tolerance =
    testing::Values(OfRun{Stepper::ida, usual_tolerance}, OfRun{Stepper::erk, usual_tolerance});
inline const auto at_tolerances = testing::Values(
    OfRun{Stepper::ida, 1e-5}, OfRun{Stepper::ida, usual_tolerance}, OfRun{Stepper::ida, 1e-12},
    OfRun{Stepper::ida, 1e-13}, OfRun{Stepper::erk, 1e-5}, OfRun{Stepper::erk, usual_tolerance},
    OfRun{Stepper::erk, 1e-12}, OfRun{Stepper::erk, 1e-13});

inline std::string tolerance_name(const testing::TestParamInfo<OfRun>& info) {
  return name(info.param.stepper) + ("_" + std::to_string(-std::lround(std::log10(info.param.tolerance))));
}

/// What a run of many steps may err by, as it says itself, relative to its length: of `ida` at tight
/// tolerances more than `bound`, as its steps, which err by a twentieth of the tolerance each, are thousands.
template <class Run>
[[nodiscard]] double error_of(const Run& run) {
  constexpr double most = 12.0;  // times what it says, see core/README.md
  return std::max(bound, most * run.statistics().accuracy);
}

class WithEvents : public testing::TestWithParam<OfRun> {
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
