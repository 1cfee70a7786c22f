#include "comparison.h"

#include <algorithm>
#include <cstring>
#include <typeinfo>

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

/// A sensible scene must be accepted: it was made to hold at its start.
std::string unless_sensible(const Plan& plan, const char* what) {
  return plan.kind == Plan::Kind::sensible ? std::string("a sensible scene is refused: ") + what : "";
}

template <int D>
Verdict judge_draft(Draft<D>& draft) {
  Verdict v;
  try {
    fill(draft);
    v.fault = draft.refused();
    if (v.fault.empty()) v.fault = run(draft, v.detail);
    v.outcome = "ran";
  } catch (const IntegrationFailure& error) {
    v.outcome = "IntegrationFailure";
    v.message = error.what();
    if (draft.plan.family != Family::products)  // there the library judges its own
      v.fault = fault_of_run(draft, error.template trajectory<D>(), error.time(), v.detail);
    if (!std::isfinite(error.time())) v.fault = "the time of failure is not finite";
  } catch (const InconsistentStart& error) {
    v.outcome = "InconsistentStart";
    v.message = error.what();
  } catch (const InvalidScene& error) {
    v.outcome = "InvalidScene";
    v.message = error.what();
    v.fault = unless_sensible(draft.plan, error.what());
  } catch (const InvalidArgument& error) {
    v.outcome = "InvalidArgument";
    v.message = error.what();
    v.fault = unless_sensible(draft.plan, error.what());
  } catch (const EquationFault& error) {
    v.outcome = "EquationFault";
    v.message = error.what();
    if (!draft.plan.has(Feature::dense))  // only what lies between samples may be refused like this
      v.fault = std::string("an EquationFault outside of a result: ") + error.what();
  } catch (const Error& error) {
    v.outcome = "Error";
    v.message = error.what();
    v.fault = std::string("an Error that is none of the four: ") + error.what();
  } catch (const std::exception& error) {
    v.outcome = "foreign";
    v.fault = std::string("a foreign exception, ") + typeid(error).name() + ": " + error.what();
  } catch (...) {
    v.outcome = "foreign";
    v.fault = "a foreign exception that is no std::exception";
  }
  if (v.outcome != "ran" && v.fault.empty() && v.message.empty()) v.fault = "an error without a message";
  const Options& o = draft.plan.options;
  std::ostringstream options;
  options.precision(17);
  options << name(draft.plan.kind) << " scene in " << D << " dimensions; t_start " << o.t_start << ", t_end "
          << o.t_end << ", samples " << o.samples << ", interval " << o.sample_interval << ", "
          << o.times.size() << " times, tolerance " << o.tolerance << ", max_steps " << o.max_steps
          << ", assemble " << o.assemble << '\n';
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
