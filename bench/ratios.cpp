#include <dalembert/bench/commands.h>
#include <dalembert/bench/methods.h>
#include <dalembert/bench/progress.h>
#include <dalembert/bench/work_precision_curve.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

namespace dalembert::bench {

namespace {

using AnyBenchmark = std::variant<Benchmark<2>, Benchmark<3>>;

Benchmark<2> chain(int beads, double t_end) {
  const models::Chain system{.beads = beads};
  Benchmark<2> benchmark{system.model(), methods(system)};
  benchmark.model.name = "chain-" + std::to_string(beads);
  benchmark.model.t_end = t_end;
  // To round-off this would take minutes; so it is a hundredth of the least error asked for.
  benchmark.model.observations = [system](std::span<const double> times) {
    return system.reference(times, models::Real(1e-12));
  };
  return benchmark;
}

/// A peer would take many minutes.
Benchmark<2> without_peers(Benchmark<2> benchmark) {
  std::erase_if(benchmark.methods, [](const auto& method) { return method.first != Method::hand; });
  return benchmark;
}

template <class System>
AnyBenchmark of(const System& system) {
  return Benchmark{system.model(), methods(system)};
}

std::vector<std::pair<std::string, std::function<AnyBenchmark()>>> scenes() {
  return {{"plane-pendulum", [] { return of(models::PlanePendulum{}); }},
          {"cone", [] { return of(models::ConeSlide{}); }},
          {"double-pendulum", [] { return of(models::DoublePendulum{}); }},
          {"chain-10", [] { return AnyBenchmark(chain(10, 1.0)); }},
          {"chain-100", [] { return AnyBenchmark(chain(100, 1.0)); }},
          {"chain-1000", [] { return AnyBenchmark(without_peers(chain(1000, 0.3))); }}};
}

template <int D>
double run_time(const std::vector<WorkPrecisionCurve<D>>& curves, Method method, double error) {
  for (const WorkPrecisionCurve<D>& curve : curves) {
    if (curve.method() == method) return curve.crossing(error).run_time;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

template <int D>
std::vector<WorkPrecisionCurve<D>> reaching(const Benchmark<D>& benchmark,
                                            std::span<const models::Observation<D>> reference,
                                            const RatiosOptions& options, Progress& progress) {
  std::vector<WorkPrecisionCurve<D>> curves;
  for (const Method method : options.steppers) {
    if (benchmark.has(method)) curves.emplace_back(benchmark, method, reference, options.limit);
  }
  for (WorkPrecisionCurve<D>& curve : curves) {
    progress.next(benchmark.model.name + ", " + name(curve.method()));
    for (const double error : options.errors) curve.reach(error);
  }
  progress.next(benchmark.model.name + ", all in turn");
  for (int i = 0; i < options.repeats; ++i) {
    for (WorkPrecisionCurve<D>& curve : curves) curve.repeat();
  }
  return curves;
}

/// Whether an error was reached, missed at every tolerance, or no tolerance ran at all.
std::string outcome(const auto& crossing, double error) {
  if (crossing.error <= error) return "ok";
  return std::isfinite(crossing.error) ? "missed" : "refused";
}

template <int D>
void race(const Benchmark<D>& benchmark, const RatiosOptions& options, Progress& progress, Table& table) {
  const auto reference =
      benchmark.model.observations(sample_times({.t_end = benchmark.model.t_end, .samples = 2}));
  const auto curves = reaching<D>(benchmark, reference, options, progress);
  for (const double error : options.errors) {
    for (const WorkPrecisionCurve<D>& curve : curves) {
      const auto at = curve.crossing(error);
      table.rows.push_back({benchmark.model.name, shortest_power(error), name(curve.method()),
                            scientific(at.tolerance, 2), scientific(at.error, 2), scientific(at.run_time),
                            scientific(at.run_time / run_time(curves, Method::hand, error), 3),
                            scientific(at.run_time / run_time(curves, Method::simbody_rod, error), 3),
                            outcome(at, error)});
    }
  }
}

void require_known(const std::vector<std::string>& names) {
  const auto known = scenes();
  for (const std::string& name : names) {
    const bool exists =
        std::any_of(known.begin(), known.end(), [&](const auto& s) { return s.first == name; });
    if (!exists && name != "all") throw Error("no scene \"" + name + "\"; there are: all, " + known_scenes());
  }
}

}  // namespace

std::string known_scenes() {
  std::string names;
  for (const auto& scene : scenes()) names += (names.empty() ? "" : ", ") + scene.first;
  return names;
}

void ratios(const RatiosOptions& options) {
  require_known(options.scenes);
  require_writable(options.report);
  const auto chosen = [&](const std::string& name) {
    return std::any_of(options.scenes.begin(), options.scenes.end(),
                       [&](const std::string& s) { return s == "all" || s == name; });
  };
  Table table{.columns = {"scene", "error", "stepper", "tolerance", "error_reached", "run_time_s",
                          "ratio_to_hand", "ratio_to_rod", "outcome"},
              .rows = {}};
  {
    Progress progress(scenes().size() * (options.steppers.size() + 1));
    for (const auto& [name, make] : scenes()) {
      if (!chosen(name)) continue;
      std::visit([&](const auto& benchmark) { race(benchmark, options, progress, table); }, make());
    }
  }
  report("Time to reach an error of position at the end of a run, medians of " +
             std::to_string(options.repeats) + " rounds" + remark(options.steppers),
         table, options.report);
}

}  // namespace dalembert::bench
