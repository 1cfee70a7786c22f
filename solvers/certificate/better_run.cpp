#include "dalembert/solvers/certificate/better_run.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace dalembert {

namespace {

constexpr long steps_for_nothing = 100;  // take no longer than the start of a run

Options within_steps(Options options, long most) {
  options.max_steps = std::min(options.max_steps, most);
  return options;
}

/// The amplitude of what vibrates in a number given at the nodes of a Chebyshev interpolant: what no
/// polynomial of low degree follows. (The mean square of a vibration is half the sum of the squares of its
/// coefficients.)
double vibration(const std::vector<double>& at_nodes) {
  constexpr std::size_t slow = 16;  // half a period of what is followed has 1e-16 of itself above
  const auto n = at_nodes.size();
  double square = 0.0;
  for (std::size_t k = slow + 1; k < n; ++k) {
    double c = 0.0;
    for (std::size_t j = 0; j < n; ++j)
      c += at_nodes[j] * std::cos(std::numbers::pi * static_cast<double>(k) * (static_cast<double>(j) + 0.5) /
                                  static_cast<double>(n));
    c *= 2.0 / static_cast<double>(n);
    square += c * c;
  }
  return std::sqrt(square);
}

/// Of all numbers of a run whose samples are such nodes. Forces that its states do not determine, as those of
/// the stiffest springs, may be of any size where positions vibrate by more than round-off.
PassedOver vibrations(const Record& run) {
  PassedOver found;
  const Statistics& scene = run.statistics;
  std::vector<double> at_nodes(run.times.size());
  const auto of = [&](auto read) {
    for (std::size_t j = 0; j < at_nodes.size(); ++j) at_nodes[j] = read(run.sample(j));
    return vibration(at_nodes);
  };
  std::vector<double> unit(run.coordinates, scene.length);
  for (const Layout::Rotor& rotor : run.layout->rotors)
    unit[static_cast<std::size_t>(rotor.coordinate)] = 1.0;
  bool vibrates = false;
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const double q = of([i](const FlatSample&at) { return at.q[i]; }),
                 v = of([i](const FlatSample&at) { return at.v[i]; });
    vibrates = vibrates || q > 16.0 * epsilon * (unit[i] + std::abs(run.sample(0).q[i]));
    found.states = std::max({found.states, q / unit[i], v * scene.time / unit[i]});
  }
  for (std::size_t r = 0; r < run.rows; ++r) {
    const double force = of([r](const FlatSample& at) { return at.lambda[r]; });
    if (std::isnan(force) && vibrates) found.force = std::numeric_limits<double>::infinity();
    found.force = larger(found.force, force);  // unless NaN
  }
  return found;
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

PassedOver passed_over(const Run& run, const Options& options, const Record& implicit,
                       const FinishedRun& cut_short) {
  constexpr double half_a_period = 25.0;  // in steps, of what an implicit run follows at usual tolerances
  constexpr int nodes = 64;
  const double t = options.t_start;
  double window =
      half_a_period * (options.t_end - t) / static_cast<double>(std::max(implicit.statistics.steps, 1L));
  window = std::min(window, cut_short.reached - t);
  const auto& events = cut_short.record->events;
  if (!events.empty()) window = std::min(window, events.front().time - t);
  if (!(window > 0.0)) return {};
  Options begin = options;
  begin.stepper = Stepper::erk;
  begin.t_end = t + window;
  // At the limit of its stability an explicit run has vibrations of its own.
  const auto steps = static_cast<double>(std::max(cut_short.record->statistics.steps, 1L));
  begin.max_step = 0.5 * (cut_short.reached - t) / steps;
  begin.times.clear();
  for (int j = 0; j < nodes; ++j)
    begin.times.push_back(t + 0.5 * window * (1.0 - std::cos(std::numbers::pi * (j + 0.5) / nodes)));
  const FinishedRun found = finish(run, begin);
  return found.record->times.size() == nodes ? vibrations(*found.record) : PassedOver{};
}

TwoRuns run_twice(const Run& run, const Options& asked) {
  Options options = asked;
  if (options.audit == Audited::off) options.audit = Audited::error;
  validate(options);
  Options next = tighter(options, Stepper::erk);
  std::shared_ptr<const Record> own;
  FinishedRun second, cut_short;
  if (options.stepper == Stepper::erk) {
    auto other = std::async(std::launch::async, [&] { return finish(run, next); });
    own = run(options);
    second = other.get();
  } else {
    own = run(options);
    second = finish(run, within_steps(next, own->statistics.steps + steps_for_nothing));
    if (!second.stopped.empty()) {
      next.stepper = Stepper::ida;
      cut_short = std::exchange(second, finish(run, next));
    }
  }
  while (second.stopped.empty() && !claims_enough(*second.record, *own) &&
         next.tolerance > smallest_tolerance) {
    next = tighter(next, next.stepper);
    second = finish(run, next);
  }
  if (second.stopped.empty() && claims_enough(*second.record, *own) &&
      takes_the_same_steps(*own, *second.record)) {
    const double mean = (options.t_end - options.t_start) / static_cast<double>(own->statistics.steps);
    next.max_step = 0.5 * (next.max_step > 0.0 ? std::min(next.max_step, mean) : mean);
    second = finish(run, next);
  }
  PassedOver both;
  if (!cut_short.stopped.empty()) both = passed_over(run, next, *own, cut_short);
  return {std::move(own), std::move(second.record), std::move(second.stopped), both};
}

}  // namespace dalembert
