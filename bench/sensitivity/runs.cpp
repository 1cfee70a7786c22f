#include "dalembert/bench/sensitivity/runs.h"

#include <dalembert/bench/table.h>
#include <dalembert/models/catalogue.h>
#include <dalembert/models/error.h>
#include <dalembert/models/small_motions.h>

#include <algorithm>
#include <memory>

namespace dalembert::bench {

namespace {

using extremes::Case;
using extremes::Run;

/// A model as a case, swept over the tolerance; its reference is computed once.
template <int D>
Case as_case(const models::Model<D>& model) {
  const auto reference = std::make_shared<const std::vector<models::Observation<D>>>(
      model.observations(sample_times({.t_end = model.t_end})));
  return {.name = model.name,
          .parameter = "tolerance",
          .sweep = {1e-6, 1e-9},
          .brief = {1e-6, 1e-9},
          .run =
              [model, reference](double tolerance, Stepper stepper) {
                const models::Measurement m = models::measure<D>(
                    model, {.t_end = model.t_end, .tolerance = tolerance, .stepper = stepper}, *reference);
                return Run{.error = std::max(m.error_position, m.error_force), .statistics = m.statistics};
              },
          .limit = [](const Run& run) { return 1000.0 * run.parameter; }};
}

/// The worst row of a system's equilibria and small motions, of its limit.
Run judge(const models::SmallMotions& system) {
  double worst = 0.0;
  Run run;
  try {
    for (const models::Compared& row : system.rows()) worst = std::max(worst, row.error() / row.limit);
    run.error = worst;
  } catch (const Error& error) {
    run = extremes::ended_by(error);
  }
  run.limit = 1.0;
  return run;
}

}  // namespace

std::vector<SensitivityRun> sensitivity_runs() {
  std::vector<Case> cases;
  for (const models::AnyModel& any : models::catalogue())
    std::visit([&cases](const auto& model) { cases.push_back(as_case(model)); }, any);
  std::ranges::move(extremes::all_cases(), std::back_inserter(cases));

  std::vector<SensitivityRun> runs;
  for (const Case& c : cases) {
    for (const Stepper stepper : c.steppers) {
      for (const double parameter : c.brief) {
        runs.push_back({c.name + ' ' + shortest_power(parameter) + ' ' + name(stepper),
                        [c, parameter, stepper] { return extremes::judge(c, parameter, stepper); }});
      }
    }
  }
  for (const models::SmallMotions& system : models::systems_with_small_motions())
    runs.push_back({"small motions of " + system.name, [system] { return judge(system); }});
  return runs;
}

}  // namespace dalembert::bench
