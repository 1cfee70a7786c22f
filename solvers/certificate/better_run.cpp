#include "dalembert/solvers/certificate/better_run.h"

#include <dalembert/core/errors.h>

#include <algorithm>
#include <future>
#include <utility>

namespace dalembert {

namespace {

constexpr long steps_for_nothing = 100;  // take no longer than the start of a run

FinishedRun explicit_or_implicit(const Run& run, const Options& options, long most_steps) {
  Options own = options;
  own.stepper = Stepper::erk;
  own.max_steps = std::min(options.max_steps, most_steps);
  FinishedRun found = finish(run, own);
  if (found.stopped.empty()) return found;
  own.stepper = Stepper::ida;
  own.max_steps = options.max_steps;
  return finish(run, own);
}

bool claims_enough(const Record& better, const Record& run) {
  return better.statistics.accuracy <= TwoRuns::most_of_better * run.statistics.accuracy;
}

/// Of a short run steps are as long as the first of them allow, whatever the tolerance: what two runs do
/// alike shows no error. A hundredth of the tolerance makes the steps of order 8 shorter by 1.8.
bool takes_the_same_steps(const Record& run, const Record& better) {
  return run.stepper == better.stepper && 2 * better.statistics.steps < 3 * run.statistics.steps;
}

}  // namespace

FinishedRun finish(const Run& run, const Options& options) {
  try {
    return {run(options), {}, {}, options.t_end};
  } catch (const IntegrationFailure& failure) {
    return {failure.record(), failure.what(), std::current_exception(), failure.time()};
  }
}

std::pair<FinishedRun, FinishedRun> finish_both(const Run& run, const Options& a, const Options& b) {
  auto second = std::async(std::launch::async, [&] { return finish(run, b); });
  FinishedRun first = finish(run, a);
  return {std::move(first), second.get()};
}

Options tighter(Options options, Stepper by, double part) {
  options.tolerance = std::max(part * options.tolerance, smallest_tolerance);
  options.stepper = by;
  options.dense = options.ledger = false;
  return options;
}

TwoRuns run_twice(const Run& run, const Options& asked) {
  Options options = asked;
  if (options.audit == Audited::off) options.audit = Audited::error;
  validate(options);
  Options next = tighter(options, Stepper::erk);
  std::shared_ptr<const Record> own;
  FinishedRun second;
  if (options.stepper == Stepper::erk) {
    auto other = std::async(std::launch::async, [&] { return finish(run, next); });
    own = run(options);
    second = other.get();
  } else {
    own = run(options);
    const bool stiff = !own->statistics.advice.empty();
    second = stiff ? finish(run, tighter(options, Stepper::ida))
                   : explicit_or_implicit(run, next, own->statistics.steps + steps_for_nothing);
  }
  while (second.stopped.empty() && !claims_enough(*second.record, *own) &&
         next.tolerance > smallest_tolerance) {
    next = tighter(next, second.record->stepper == name(Stepper::erk) ? Stepper::erk : Stepper::ida);
    second = finish(run, next);
  }
  if (second.stopped.empty() && claims_enough(*second.record, *own) &&
      takes_the_same_steps(*own, *second.record)) {
    const double mean = (options.t_end - options.t_start) / static_cast<double>(own->statistics.steps);
    next.max_step = 0.5 * (next.max_step > 0.0 ? std::min(next.max_step, mean) : mean);
    second = finish(run, next);
  }
  return {std::move(own), std::move(second.record), std::move(second.stopped)};
}

}  // namespace dalembert
