#include "dalembert/tests/extremes/cases/case.h"

#include <algorithm>
#include <iterator>

namespace dalembert::extremes {

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const auto group : {stiffness, ratios, near_singular, linkages, driving, length, paths, units, starts,
                           failures, redundancy, at_round_off, discontinuities, sticking, contacts})
    std::ranges::move(group(), std::back_inserter(cases));
  return cases;
}

Run judge(const Case& extreme, double parameter, Stepper stepper) {
  Run run;
  try {
    run = extreme.run(parameter, stepper);
  } catch (const Error& error) {
    run = ended_by(error);
  }
  run.parameter = parameter;
  run.stepper = stepper;
  run.limit = extreme.limit(run);
  if (run.outcome.ok() && !run.right()) run.outcome.name = "missed";
  return run;
}

}  // namespace dalembert::extremes
