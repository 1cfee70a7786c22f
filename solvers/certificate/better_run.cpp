#include "dalembert/solvers/certificate/better_run.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/numbers.h>

#include <Eigen/Core>

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

/// Chebyshev's polynomials at nodes of an interpolant.
constexpr int nodes = 64;
double node(int j) { return std::cos(std::numbers::pi * (j + 0.5) / nodes); }
Eigen::MatrixXd of_high_degree() {
  constexpr int slow = 16;  // half a period of what is followed has 1e-16 of itself above
  Eigen::MatrixXd T(nodes - slow - 1, nodes);
  for (int k = slow + 1; k < nodes; ++k)
    for (int j = 0; j < nodes; ++j)
      T(k - slow - 1, j) = 2.0 / nodes * std::cos(std::numbers::pi * k * (j + 0.5) / nodes);
  return T;
}

/// Twice the amplitude of what vibrates in a number given at the nodes: what no polynomial of low degree
/// follows. (The mean square of a vibration is half the sum of the squares of its coefficients.) A run that
/// vibrates as far, at another phase, is off by twice of it.
double vibration(const Eigen::VectorXd& at_nodes) {
  static const Eigen::MatrixXd T = of_high_degree();
  return 2.0 * (T * at_nodes).norm();
}

/// Of all numbers of a run whose samples are such nodes. Forces that its states do not determine, as those of
/// the stiffest springs, may be of any size where positions vibrate by more than round-off.
PassedOver vibrations(const Record& run) {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  Eigen::VectorXd at_nodes(nodes);
  const auto all = [&](auto numbers) {
    std::vector<double> amplitudes((run.sample(0).*numbers).size());
    for (std::size_t i = 0; i < amplitudes.size(); ++i) {
      for (int j = 0; j < nodes; ++j) at_nodes[j] = (run.sample(static_cast<std::size_t>(j)).*numbers)[i];
      amplitudes[i] = vibration(at_nodes);
    }
    return amplitudes;
  };
  PassedOver found{.q = all(&FlatSample::q)};
  const Layout& layout = *run.layout;
  std::vector<char> vibrates(found.q.size());
  // Roundings of steps add up as the root of their number; doubled, as amplitudes are here, and twice that.
  const double rounding = 4.0 * epsilon * std::sqrt(static_cast<double>(std::max(run.statistics.steps, 1L)));
  const FlatSample first = run.sample(0);
  for (std::size_t i = 0; i < vibrates.size(); ++i) {
    const double unit = layout.particle_at(static_cast<int>(i)) == nullptr ? 1.0 : run.statistics.length;
    vibrates[i] = found.q[i] > rounding * (unit + std::abs(first.q[i]));
  }
  if (std::ranges::find(vibrates, char{1}) == vibrates.end()) return {};
  found.v = all(&FlatSample::v);
  found.a = all(&FlatSample::a);
  found.lambda = all(&FlatSample::lambda);
  found.forces = all(&FlatSample::forces);
  const auto settle = [&](double& amplitude, bool own) {
    if (std::isnan(amplitude)) amplitude = own ? unknown : 0.0;
  };
  for (std::size_t i = 0; i < vibrates.size(); ++i) settle(found.a[i], vibrates[i] != 0);
  for (const Layout::Constraint& c : layout.constraints) {
    bool own = false;
    for (const std::size_t k : c.slots()) {
      const bool its = vibrates[static_cast<std::size_t>(layout.slot_coordinate[k])] != 0;
      settle(found.forces[k], its);
      own = own || its;
    }
    for (const std::size_t r : c.own_rows()) settle(found.lambda[r], own);
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
  // In steps: no more than a part of a period of what the one follows, many of what limits the other. Windows
  // half and twice as long, and twice as many nodes, leave no claim too small in the same scenes.
  constexpr double implicit_steps = 25.0, explicit_steps = 200.0;
  const double t = options.t_start,
               steps = static_cast<double>(std::max(cut_short.record->statistics.steps, 1L)),
               step = (cut_short.reached - t) / steps,
               implicit_step =
                   (implicit.times.back() - t) / static_cast<double>(std::max(implicit.statistics.steps, 1L));
  double window = std::min(std::max(implicit_steps * implicit_step, explicit_steps * step), steps * step);
  const auto& events = cut_short.record->events;
  if (!events.empty()) window = std::min(window, events.front().time - t);
  if (!(window > 0.0)) return {};
  Options begin = options;
  begin.stepper = Stepper::erk;
  begin.t_end = t + window;
  // At the limit of its stability an explicit run has vibrations of its own.
  begin.max_step = 0.5 * step;
  begin.sample_interval = 0.0;
  begin.times.clear();
  // What has died out in the second half does not go on.
  for (int j = 0; j < nodes; ++j) begin.times.push_back(t + window * (0.75 - 0.25 * node(j)));
  const FinishedRun found = finish(run, begin);
  return found.record && found.record->times.size() == nodes ? vibrations(*found.record) : PassedOver{};
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
