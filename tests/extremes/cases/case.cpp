#include "dalembert/tests/extremes/cases/case.h"

namespace dalembert::extremes {

namespace {

/// The statistics of a failure in a scene of either dimension.
Statistics statistics_of(const IntegrationFailure& failure) {
  try {
    return failure.trajectory<2>().statistics();
  } catch (const InvalidArgument&) {
    return failure.trajectory<3>().statistics();
  }
}

Result run(const Case& extreme, double parameter, Stepper stepper) try {
  return extreme.run(parameter, stepper);
} catch (const IntegrationFailure& failure) {
  return {.statistics = statistics_of(failure), .outcome = "IntegrationFailure", .said = failure.what()};
} catch (const UndeterminedForce& refusal) {
  return {.outcome = "UndeterminedForce", .said = refusal.what()};
} catch (const InconsistentStart& refusal) {
  return {.outcome = "InconsistentStart", .said = refusal.what()};
} catch (const InvalidScene& refusal) {
  return {.outcome = "InvalidScene", .said = refusal.what()};
} catch (const InvalidArgument& refusal) {
  return {.outcome = "InvalidArgument", .said = refusal.what()};
}

}  // namespace

std::vector<Group> groups() {
  return {{"stiffness", stiffness()},
          {"ratios", ratios()},
          {"near-singular", near_singular()},
          {"linkages", linkages()},
          {"driving", driving()},
          {"length", length()},
          {"paths", paths()},
          {"units", units()},
          {"starts", starts()},
          {"failures", failures()},
          {"redundancy", redundancy()},
          {"round-off", at_round_off()},
          {"discontinuities", discontinuities()},
          {"sticking", sticking()},
          {"contacts", contacts()}};
}

Verdict judge(const Case& extreme, double parameter, Stepper stepper) {
  Verdict verdict{.result = run(extreme, parameter, stepper), .limit = 0.0, .right = false};
  verdict.limit = extreme.limit({parameter, stepper, verdict.result.statistics});
  verdict.right = verdict.result.error <= verdict.limit;
  if (verdict.result.outcome == "ok" && !verdict.right) verdict.result.outcome = "missed";
  return verdict;
}

}  // namespace dalembert::extremes
