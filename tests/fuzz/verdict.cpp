#include "comparison.h"

#include <algorithm>
#include <cstring>

namespace dalembert::fuzz {

namespace {

/// By steps and jumps, as a program with a display would; what can be read stays finite.
template <int D>
std::string walk(Draft<D>& draft) {
  Simulation<D> simulation(draft.scene, draft.plan.options);
  const Options& o = draft.plan.options;
  for (int i = 0; i < 5 && simulation.time() < o.t_end; ++i) simulation.step();
  for (int i = 0; i < 3; ++i) {
    const double rest = o.t_end - simulation.time();
    simulation.advance_to(std::min(simulation.time() + rest * draft.random.uniform(), o.t_end));
    const FlatSample now = simulation.sample().flat();
    for (const double x : now.q)
      if (!std::isfinite(x)) return "a position of a step-wise run is not finite";
    if (!std::isfinite(simulation.energy())) return "an energy of a step-wise run is not finite";
  }
  try {
    simulation.advance_to(draft.plan.options.t_start - draft.plan.time);
    return "advance_to went back in time";
  } catch (const InvalidArgument&) {
  }
  return {};
}

/// May report that an equation is at fault.
template <int D>
void describe(const Draft<D>& draft) {
  try {
    (void)draft.scene.describe(draft.plan.options.t_start);
  } catch (const EquationFault&) {
  }
}

template <int D>
bool same_bits(const Trajectory<D>& a, const Trajectory<D>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const FlatSample x = a.sample(i).flat(), y = b.sample(i).flat();
    const auto same = [](std::span<const double> p, std::span<const double> q) {
      return p.empty() || std::memcmp(p.data(), q.data(), p.size_bytes()) == 0;
    };
    if (!same(x.q, y.q) || !same(x.v, y.v) || !same(x.lambda, y.lambda)) return false;
  }
  return true;
}

template <int D>
std::string run(Draft<D>& draft, std::string& detail) {
  const Family family = draft.plan.family;
  if (family == Family::redundant || family == Family::kinked) return fault_of_twins(draft, detail);
  if (family == Family::products) return fault_of_product(draft, detail);
  const double way = draft.random.uniform();
  if (way < 0.1) describe(draft);
  if (way > 0.9) return walk(draft);
  const Trajectory<D> first = simulate(draft.scene, draft.plan.options);
  const std::string fault = fault_of_run(draft, first, std::nullopt, detail);
  if (!fault.empty()) return fault;
  if (way < 0.05) {
    std::ostringstream csv;
    first.write_csv(csv);
    if (csv.str().empty()) return "write_csv wrote nothing";
    if (!same_bits(first, simulate(draft.scene, draft.plan.options))) return "a second run gives other bits";
  }
  return {};
}

/// What is wrong with an error: empty if the scene may give it.
template <int D>
std::string fault_of_error(const Draft<D>& draft, const std::exception& error, std::string& detail) {
  const auto [name, message] = outcome_of(error);
  if (const auto* failure = dynamic_cast<const IntegrationFailure*>(&error)) {
    if (!std::isfinite(failure->time())) return "the time of failure is not finite";
    if (draft.plan.family == Family::products) return {};  // there the library judges its own
    return fault_of_run(draft, failure->template trajectory<D>(), failure->time(), detail);
  }
  if (dynamic_cast<const Error*>(&error) == nullptr) return "a foreign exception, " + name + ": " + message;
  if (name == "InconsistentStart") return {};
  // Only what lies between samples may be refused like this.
  if (name == "EquationFault" && draft.plan.has(Feature::dense)) return {};
  // A sensible scene must be accepted: it was made to hold at its start.
  const bool invalid = name == "InvalidScene" || name == "InvalidArgument";
  if (invalid && draft.plan.kind != Plan::Kind::sensible) return {};
  return (invalid ? "a sensible scene is refused: " : "an error that no run may give, " + name + ": ") +
         message;
}

template <int D>
Verdict judge_draft(Draft<D>& draft) {
  Verdict v;
  try {
    fill(draft);
    v.fault = draft.refused();
    if (v.fault.empty()) v.fault = run(draft, v.detail);
  } catch (const std::exception& error) {
    v.outcome = outcome_of(error);
    v.fault = fault_of_error(draft, error, v.detail);
    if (v.fault.empty() && v.outcome.message.empty()) v.fault = "an error without a message";
  } catch (...) {
    v.outcome.name = "foreign";
    v.fault = "a foreign exception that is no std::exception";
  }
  const Options& o = draft.plan.options;
  std::ostringstream options;
  options.precision(17);
  v.kind = name(draft.plan.kind);
  options << v.kind << " scene in " << D << " dimensions; t_start " << o.t_start << ", t_end " << o.t_end
          << ", samples " << o.samples << ", interval " << o.sample_interval << ", " << o.times.size()
          << " times, tolerance " << o.tolerance << ", max_steps " << o.max_steps << ", assemble "
          << o.assemble << '\n';
  v.log = options.str() + draft.log();
  for (const Feature feature : draft.plan.features) v.features += std::string(name(feature)) + ' ';
  return v;
}

}  // namespace

Verdict judge(const Task& task) {
  Random random(task.seed);
  const Plan plan = random_plan(random, task.family, task.stepper);
  if (random.chance(0.5)) {
    Draft<2> draft(random, plan);
    return judge_draft(draft);
  }
  Draft<3> draft(random, plan);
  return judge_draft(draft);
}

}  // namespace dalembert::fuzz
