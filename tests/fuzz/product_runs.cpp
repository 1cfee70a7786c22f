#include "comparison.h"

#include <algorithm>
#include <cmath>
#include <sstream>

/// One motion by all the ways in which a scene may be stated and run.
namespace dalembert::fuzz {

namespace {

/// Whether forces change at instants that no two runs have in common.
bool switches(const Plan& plan) {
  return plan.has(Feature::kink) || plan.has(Feature::one_sided) || plan.has(Feature::rough) ||
         plan.has(Feature::change);
}

/// Against a scene stated otherwise, or by the other stepper; nothing where that is refused.
template <int D>
std::string against(const Draft<D>& draft, const Ending<D>& one, const Plan& plan, const Statement& statement,
                    const Measure& measure, std::string& detail) {
  Draft<D> twin = draft.again(plan, statement);
  fill(twin);
  const Ending<D> two = run_of(twin);
  if (!two.why.empty() || !two.run) return {};
  const Run<D> other{twin, two};
  return fault_of_twin<D>({draft, one}, other, measure, detail);
}

/// From its middle on.
template <int D>
std::string restarted(const Draft<D>& draft, const Ending<D>& one, std::string& detail) {
  const std::size_t middle = one.run->size() / 2;
  Options o = draft.plan.options;
  o.t_start = 0.0;
  o.times.assign(one.run->times().begin() + static_cast<std::ptrdiff_t>(middle), one.run->times().end());
  const Ending<D> two{.run = simulate(draft.scene, one.run->sample(middle), o)};
  const Run<D> first{draft, one};
  return fault_of_comparison<D>(first, {draft, two}, first, {.of = "from its middle", .first = middle},
                                detail);
}

/// How far positions come from those of runs begun with velocities that differ by what one may err by, in all
/// and as lengths: contacts that are grazed enlarge errors to their root.
template <int D>
double growth(const Draft<D>& draft, const Ending<D>& one, const std::vector<double>& scale) {
  const Statistics s = one.run->statistics();
  double sum = 0.0;
  for (int way = 0; way < 2 * D; ++way) {
    Draft<D> otherwise =
        draft.again(draft.plan, faster(draft, way, error_of_run * s.accuracy / s.time, s.length));
    fill(otherwise);
    const Ending<D> other = run_of(otherwise);
    if (!other.run || other.run->size() != one.run->size()) continue;
    double most = 0.0;
    for (std::size_t k = 0; k < one.run->size(); ++k) {
      const FlatSample a = one.run->sample(k).flat(), b = other.run->sample(k).flat();
      for (std::size_t i = 0; i < scale.size(); ++i)
        most = std::max(most, std::abs(a.q[i] - b.q[i]) / scale[i]);
    }
    sum += most;
  }
  return sum;
}

/// By steps of its own choice and jumps, as a program with a display would.
template <int D>
std::string step_by_step(Draft<D>& draft, const Ending<D>& one) {
  const Options& o = draft.plan.options;
  Simulation<D> simulation(draft.scene, o, draft.events);
  for (int i = 0; i < 5 && simulation.time() < o.t_end; ++i) simulation.step();
  for (double share = 0.3; simulation.time() < o.t_end; share += 0.3) {
    const double to =
        std::min(o.t_end, std::max(simulation.time(), o.t_start + share * (o.t_end - o.t_start)));
    simulation.advance_to(to);
  }
  const FlatSample last = one.run->sample(one.run->size() - 1).flat(), now = simulation.sample().flat();
  const Statistics s = one.run->statistics();
  const std::vector<double> scale = units(draft.scene.system(), s.length);
  for (std::size_t i = 0; i < now.q.size(); ++i) {
    const double apart = std::abs(now.q[i] - last.q[i]);
    double bound = error_of_run * s.accuracy * scale[i];
    if (apart > bound) bound += growth(draft, one, scale) * scale[i];
    if (!(apart > bound)) continue;
    std::ostringstream what;
    what << "step by step it ends " << apart << " from there, bound " << bound;
    return what.str();
  }
  return {};
}

/// What lies between samples is finite, and goes through them.
template <int D>
std::string between(const Draft<D>& draft, const Ending<D>& one) {
  std::vector<double> times;
  for (std::size_t i = 1; i < one.run->size(); ++i) {
    const double from = one.run->times()[i - 1], to = one.run->times()[i];
    for (const double share : {0.0, 0.31, 0.77}) times.push_back(from + share * (to - from));
  }
  const Trajectory<D> fine = one.run->at(times);
  const std::vector<double> scale = units(draft.scene.system(), one.run->statistics().length);
  for (std::size_t k = 0; k < times.size(); ++k) {
    const FlatSample there = fine.sample(k).flat();
    for (std::size_t i = 0; i < scale.size(); ++i) {
      if (!std::isfinite(there.q[i]) || !std::isfinite(there.v[i]))
        return "a motion between samples is not finite";
      const double off = k % 3 == 0 ? there.q[i] - one.run->sample(k / 3).flat().q[i] : 0.0;
      if (std::abs(off) > one.run->statistics().accuracy * scale[i])
        return "what lies between samples does not go through them";
    }
  }
  return {};
}

template <int D>
std::string twins(const Draft<D>& draft, const Ending<D>& one, std::string& detail) {
  const Plan& plan = draft.plan;
  const bool smooth = !switches(plan);
  Plan other = plan;
  other.options.stepper = other_than(plan.options.stepper);
  std::string fault = against(draft, one, other, {}, {.of = "the other stepper", .forces = smooth}, detail);
  if (fault.empty() && plan.has(Feature::redundant))
    fault =
        against(draft, one, plan, {.lean = true}, {.of = "without redundant rows", .forces = smooth}, detail);
  if (fault.empty() && plan.has(Feature::compliant))
    fault = against(draft, one, plan, {.springs = true}, {.of = "with springs as forces"}, detail);
  if (fault.empty() && plan.has(Feature::rough)) {
    fault = against(
        draft, one, plan, {.regularised = true},
        {.of = "with regularised friction", .velocities = false, .coarse = regularised_within * plan.length},
        detail);
  }
  return fault;
}

}  // namespace

template <int D>
std::string fault_of_product(Draft<D>& draft, std::string& detail) {
  const Ending<D> one = run_of(draft);
  if (one.failure) std::rethrow_exception(one.failure);
  const Plan& plan = draft.plan;
  std::string fault;
  if (plan.has(Feature::dense)) fault = between(draft, one);
  if (fault.empty() && plan.has(Feature::stepwise)) fault = step_by_step(draft, one);
  if (fault.empty() && plan.has(Feature::restart) && !plan.has(Feature::change))
    fault = restarted(draft, one, detail);
  return fault.empty() ? twins(draft, one, detail) : fault;
}

template std::string fault_of_product(Draft<2>&, std::string&);
template std::string fault_of_product(Draft<3>&, std::string&);

}  // namespace dalembert::fuzz
