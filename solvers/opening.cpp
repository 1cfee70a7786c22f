#include "dalembert/solvers/opening.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/erk/erk.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace dalembert {

namespace {

/// An impact would have to give impulses to what reads the force of a contact.
void require_no_force_reads(const System& system) {
  const auto pattern = system.multiplier_force_pattern();
  for (std::size_t k = 0; k < pattern.size(); ++k) {
    for (const std::size_t c : system.contacts()) {
      const Layout::Constraint& contact = system.layout()->constraints[c];
      if (pattern[k].column != contact.own_rows().front()) continue;
      throw InvalidScene(system.name_of_multiplier_force(k) + " reads the force of " + contact.label() +
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

/// Nothing acts on what is free to move, or all that is no angle is held: what its forces would do in no time
/// is no path. (Friction holds for a while only, and wheels have their levers.)
bool has_no_path(const System& system, const Start& start) {
  if (start.scales.lever > 0.0) return false;
  if (start.scales.forced == 0.0) return true;
  std::vector<char> rough(system.rows(), 0);
  for (const std::size_t number : system.frictional_constraints())
    for (const std::size_t r : system.layout()->constraints[number].own_rows()) rough[r] = 1;
  std::ptrdiff_t held = 0;
  for (const std::size_t r : start.rows.rows) {
    bool of_lengths = rough[r] == 0;
    for (const std::size_t k : system.row(r))
      of_lengths = of_lengths && !start.scales.is_angle[system.w_columns()[k]];
    held += of_lengths ? 1 : 0;
  }
  return held >= std::ranges::count(start.scales.is_angle, 0);
}

/// A scene without a length of its own gets that of the path of a first step.
Start first_start(const Problem& problem, std::span<const double> q, std::span<const double> v,
                  const Options& options, double nearest_contact) {
  Start start = consistent_start(problem, q, v, options, nearest_contact);
  if (!std::exchange(start.scales.length_from_path, false)) return start;
  const double round_off = measure_path(problem, start, options);
  if (!start.scales.waits_for_path || start.scales.length > round_off) return start;
  Options still = options;
  still.length = std::max(1.0, round_off);
  start = consistent_start(problem, q, v, still, nearest_contact);
  start.scales.waits_for_path = true;
  return start;
}

}  // namespace

double measure_path(const Problem& problem, Start& start, const Options& options) {
  Options looking = options;
  looking.tolerance = Options{}.tolerance;  // the scene's length is its own, whatever is asked of the run
  Start moving = start;
  moving.scales.length_from_path = true;
  moving.scales.waits_for_path = false;
  try {
    ErkStepper first(problem, moving, looking);
    first.step(options.t_end);
    const PathExtent& path = first.scales().extent;
    const double round_off = length_of_round_off(start, path.step, looking.tolerance);
    start.scales.waits_for_path = path.length <= round_off && has_no_path(problem.system(), start);
    if (start.scales.waits_for_path) return round_off;
    moving.scales.adopt(path);
    start = std::move(moving);
  } catch (const StepFailure&) {  // the run will stop, and say why
  }
  return 0.0;
}

Opening open_run(const std::shared_ptr<const System>& stated, std::span<const double> q,
                 std::span<const double> v, const Options& options) {
  const auto numbers = stated->conditional_constraints();
  if (numbers.empty()) {
    const Problem problem(stated);
    Start start = first_start(problem, q, v, options, std::numeric_limits<double>::infinity());
    const Scales scales = start.scales;
    return {nullptr, {}, problem, std::move(start), scales};
  }
  require_no_force_reads(*stated);
  const double nearest = nearest_contact(*stated, {options.t_start, q, v});
  const Start free = first_start(Problem(stated->without(numbers)), q, v, options, nearest);
  const Instant at{options.t_start, free.q, free.v};
  const auto open_with = [&](const Scales& scales) {
    auto conditional = std::make_unique<ConditionalConstraints>(stated, scales, options.tolerance, at,
                                                                options.t_end - options.t_start);
    Change change = conditional->resolve_start(at);
    const Problem problem(change.system);
    Start start = first_start(problem, change.q, change.v, options, nearest);
    return Opening{std::move(conditional), std::move(change), problem, std::move(start), scales};
  };
  Opening opening = open_with(free.scales);
  // What contacts and friction hold has another length than what is free, and so another speed that is slow.
  if (opening.start.scales.length != free.scales.length) opening = open_with(Scales(opening.start.scales));
  opening.conditional->adopt(opening.start.scales);
  return opening;
}

}  // namespace dalembert
