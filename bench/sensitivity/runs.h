#pragma once

#include <dalembert/tests/extremes/cases/case.h>

#include <functional>
#include <string>
#include <vector>

namespace dalembert::bench {

/// One scene with one stepper.
struct SensitivityRun {
  std::string name;
  std::function<extremes::Run()> run;
};

/// All models at two tolerances, their errors measured by 1000 times the tolerance, and the short part of all
/// extremes, by their limits; with each stepper. Equilibria and small motions, by their limits.
[[nodiscard]] std::vector<SensitivityRun> sensitivity_runs();

}  // namespace dalembert::bench
