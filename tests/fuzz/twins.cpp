#include "comparison.h"

/// A scene and the same without what is redundant, or by the other stepper.
namespace dalembert::fuzz {

template <int D>
std::string fault_of_twins(const Draft<D>& draft, std::string& detail) {
  const bool redundant = draft.plan.family == Family::redundant;
  Plan other = draft.plan;
  if (!redundant) other.options.stepper = other_than(other.options.stepper);
  Draft<D> twin = draft.again(other, {.lean = redundant});
  fill(twin);
  const Ending<D> one = run_of(draft), two = run_of(twin);
  const bool both_run = one.run && two.run;
  if ((redundant || !both_run) && one.why.empty() != two.why.empty())
    return "only one of the twins is refused: " + one.why + two.why;
  std::string fault;
  if (one.run) fault = fault_of_run(draft, *one.run, one.failed_at, detail);
  // Forces of kinked scenes jump at an instant that no two runs have in common.
  const Measure measure{.of = "twins", .forces = redundant};
  const Run<D> of_twin{twin, two};
  if (both_run && fault.empty()) fault = fault_of_twin<D>({draft, one}, of_twin, measure, detail);
  if (fault.empty() && one.failure) std::rethrow_exception(one.failure);
  return fault;
}

template std::string fault_of_twins(const Draft<2>&, std::string&);
template std::string fault_of_twins(const Draft<3>&, std::string&);

}  // namespace dalembert::fuzz
