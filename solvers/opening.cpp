#include "dalembert/solvers/opening.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/contact/contacts_at_start.h>
#include <dalembert/solvers/erk/erk.h>
#include <dalembert/solvers/manifold/first_scales.h>
#include <dalembert/solvers/run/comparisons.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace dalembert {

namespace {

/// An impact would have to give impulses to what reads the force of a contact.
void require_no_force_reads(const System& system) {
  const auto pattern = system.forces().friction_pattern();
  for (std::size_t k = 0; k < pattern.size(); ++k) {
    for (const std::size_t c : system.conditions().contacts()) {
      const Layout::Constraint& contact = system.layout()->constraints[c];
      if (pattern[k].column != contact.own_rows().front()) continue;
      throw InvalidScene(system.forces().owner_of_friction(k) + " reads the force of " + contact.label() +
                         ", which is one-sided: state it as a bilateral one, and end the run by an event "
                         "where its force vanishes");
    }
  }
}

/// A path of this last step on which nothing but round-off has moved.
double length_of_round_off(const Start& start, double step, double tolerance) {
  const std::vector<double> still(start.q.size());
  return start.scales.extended_by(start.q, still, step, tolerance).length;
}

/// Nothing acts on what is free to move, or all that is no angle is held, for good or by friction: what its
/// forces would do in no time is no path. (Wheels have their levers.)
bool has_no_path(const System& system, const Start& start) {
  if (start.scales.lever > 0.0) return false;
  if (start.scales.forced == 0.0) return true;
  std::ptrdiff_t held = 0;
  for (const std::size_t r : start.rows.rows) {
    bool of_lengths = true;
    for (const std::size_t k : system.row(r))
      of_lengths = of_lengths && !start.scales.is_angle[system.w_columns()[k]];
    held += of_lengths ? 1 : 0;
  }
  return held >= std::ranges::count(start.scales.is_angle, 0);
}

/// A time in a step, which began at `from`, up to which what presses what slides has not changed its sign,
/// where friction turns: at least half as far as that.
double end_of_sliding(const Problem& problem, const Start& start, TimeStepper& step, double from, double to) {
  const System& system = problem.system();
  if (!system.forces().any_slides()) return to;
  Manifold manifold(problem, start.rows, start.scales.lengths());
  std::vector<double> q(start.q), v(start.v), a(q.size()), lambda(system.rows());
  const auto turned = [&](double t) {
    step.interpolate(t, q, v);
    if (!manifold.accelerate({t, q, v}, a)) return true;
    manifold.multipliers(lambda);
    return std::ranges::any_of(system.forces().friction_pattern(), [&](const MatrixEntry& entry) {
      return lambda[entry.column] * start.lambda[entry.column] < 0.0;
    });
  };
  double t = to;
  while (t > from && turned(t)) t = std::midpoint(from, t);
  return t;
}

/// A scene without a length of its own gets that of the path of a first step.
Start first_start(const Problem& problem, std::span<const double> q, std::span<const double> v,
                  const Options& options, const Branches::Sides& sides, double nearest_contact,
                  double lever = 0.0) {
  Start start = consistent_start(problem, q, v, options, nearest_contact);
  if (!std::exchange(start.scales.length_from_path, false)) return start;
  if (start.scales.lever == 0.0) start.scales.lever = lever;
  const double round_off = measure_path(problem, start, options, sides);
  if (!start.scales.waits_for_path || start.scales.length > round_off) return start;
  Options still = options;
  still.length = std::max(1.0, round_off);
  start = consistent_start(problem, q, v, still, nearest_contact);
  start.scales.waits_for_path = true;
  return start;
}

/// Also of slips, which are in force only where friction sticks. 0 where something is not defined.
double lever_of_all(const System& stated, const Instant& at) {
  auto e = stated.evaluation();
  try {
    stated.evaluate(at, e);
  } catch (const EquationFault&) {
    return 0.0;
  }
  const auto angles = stated.angles();
  return least_lever(stated, e, {angles.begin(), angles.end()});
}

/// What is compared; nothing where something is not defined.
Branches::Sides compared(const System& stated, const Instant& at) {
  auto e = stated.evaluation();
  Branches::Sides recorded;
  const Branches listening(&recorded, nullptr);
  try {
    stated.evaluate(at, e);
  } catch (const EquationFault&) {
    recorded.clear();
  }
  return recorded;
}

bool any_undecided(const std::vector<Branches::Comparison>& batch) {
  return std::ranges::find(batch, 0, &Branches::Comparison::side) != batch.end();
}

/// A run that starts at a switch with the time starts behind it: there its state is to be consistent, and
/// its contacts and friction are resolved. (Where something moves to depends on what holds it: see
/// Comparisons::at_start.) Empty if there is none.
Branches::Sides sides_behind(const System& stated, const Instant& at, double duration) {
  if (!stated.rheonomic() && !stated.forces().timed()) return {};
  const Branches::Sides here = compared(stated, at);
  std::vector<std::size_t> tied;
  for (std::size_t b = 0; b < here.size(); ++b)
    if (stated.timed_batch(b) && any_undecided(here[b])) tied.push_back(b);
  if (tied.empty()) return {};
  const double instant = 16.0 * epsilon * std::max(std::abs(at.t), duration);
  std::vector<double> q(at.q.begin(), at.q.end());
  for (std::size_t i = 0; i < q.size(); ++i) q[i] += instant * at.v[i];
  const Branches::Sides behind = compared(stated, {at.t + instant, q, at.v});
  if (behind.size() != here.size()) return {};
  Branches::Sides sides(here.size());
  for (const std::size_t b : tied) sides[b] = behind[b];
  return sides;
}

}  // namespace

double measure_path(const Problem& problem, Start& start, const Options& options,
                    const Branches::Sides& sides) {
  Options looking = options;
  looking.tolerance = Options{}.tolerance;  // the scene's length is its own, whatever is asked of the run
  Start moving = start;
  moving.scales.length_from_path = true;
  moving.scales.waits_for_path = false;
  try {
    const double t = options.t_start;
    Comparisons comparisons(problem, moving, t, looking.tolerance, sides);
    comparisons.go_behind_start();
    const Branches holding(nullptr, comparisons.held());
    ErkStepper first(problem, moving, looking);
    first.step(options.t_end);
    PathExtent path = first.scales().extent;
    const auto switched = comparisons.leave(first);
    const double to = end_of_sliding(problem, start, first, t, switched ? switched->at.t : first.time());
    if (to < first.time()) {  // what is behind is not of the motion
      std::vector<double> q(start.q.size()), v(q.size());
      first.interpolate(to, q, v);
      path = moving.scales.extended_by(q, v, to - t, looking.tolerance);
    }
    const double round_off = length_of_round_off(start, path.step, looking.tolerance);
    start.scales.waits_for_path = path.length <= round_off && has_no_path(problem.system(), start);
    if (start.scales.waits_for_path) return round_off;
    moving.scales.adopt_for_first_step(path, t, options.tolerance);
    start = std::move(moving);
  } catch (const StepFailure&) {  // the run will stop, and say why
  }
  return 0.0;
}

Opening open_run(const std::shared_ptr<const System>& stated, std::span<const double> q,
                 std::span<const double> v, const Options& options) {
  const Branches::Sides sides =
      sides_behind(*stated, {options.t_start, q, v}, options.t_end - options.t_start);
  const Branches holding(nullptr, &sides);
  const auto numbers = stated->conditions().conditional_constraints();
  if (numbers.empty()) {
    const Problem problem(stated);
    Start start = first_start(problem, q, v, options, sides, std::numeric_limits<double>::infinity());
    const Scales scales = start.scales;
    return {nullptr, {}, problem, std::move(start), scales, sides};
  }
  require_no_force_reads(*stated);
  const double nearest = nearest_contact(*stated, {options.t_start, q, v}),
               lever = lever_of_all(*stated, {options.t_start, q, v});
  const Problem always(stated->without(numbers));
  const Start free = first_start(always, q, v, options, sides, nearest, lever);
  const Instant at{options.t_start, free.q, free.v};
  const auto open_with = [&](const Scales& scales) {
    auto conditional = std::make_unique<ConditionalConstraints>(stated, scales, options.tolerance, at,
                                                                options.t_end - options.t_start);
    Change change = conditional->resolve_start(at);
    const Problem problem(change.system);
    Start start = first_start(problem, change.q, change.v, options, sides, nearest, lever);
    return Opening{std::move(conditional), std::move(change), problem, std::move(start), scales, sides};
  };
  Opening opening = open_with(free.scales);
  // What contacts and friction hold has another length than what is free, and so another speed that is slow.
  if (opening.start.scales.length != free.scales.length) opening = open_with(Scales(opening.start.scales));
  opening.conditional->adopt(opening.start.scales);
  return opening;
}

}  // namespace dalembert
