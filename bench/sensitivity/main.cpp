#include <dalembert/bench/command_line.h>
#include <dalembert/bench/progress.h>
#include <dalembert/bench/report.h>
#include <dalembert/bench/sensitivity/constants.h>
#include <dalembert/bench/sensitivity/runs.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>

namespace {

using namespace dalembert;
using namespace dalembert::bench;

/// What a run gave: its error over its limit, and its work.
struct Seen {
  double error, work;
  bool right;
  long steps;
  std::chrono::duration<double> duration;
};

/// Runs that take longer, with the integration of their references, are left out: shorter ones of their kind
/// are there.
constexpr std::chrono::milliseconds longest_run{20};

Seen look(const SensitivityRun& run) {
  const auto begin = std::chrono::steady_clock::now();
  const extremes::Run gave = run.run();
  const Statistics& s = gave.statistics;
  const double error = gave.error == 0.0 ? 0.0 : gave.error / gave.limit;
  return {error, static_cast<double>(s.evaluations + s.factorisations), gave.right(), s.steps,
          std::chrono::steady_clock::now() - begin};
}

std::vector<Seen> look(const std::vector<SensitivityRun>& runs) {
  std::vector<Seen> seen;
  for (const SensitivityRun& run : runs) seen.push_back(look(run));
  return seen;
}

/// The effect of a changed constant. A run within its limit both ways is not worse.
struct Effect {
  int changed = 0, refused = 0;
  double worse_error = 1.0, more_time = 1.0;
  std::string worst = "-";
};

Effect compare(const std::vector<SensitivityRun>& runs, const std::vector<Seen>& before,
               const std::vector<Seen>& after) {
  Effect effect;
  double logarithms = 0.0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Seen &a = before[i], &b = after[i];
    if (a.error != b.error || a.steps != b.steps) ++effect.changed;
    if (a.work > 0.0 && b.work > 0.0) logarithms += std::log(b.work / a.work);
    if (a.right && std::isnan(b.error)) ++effect.refused;
    const double worse = std::max(b.error, 1.0) / std::max(a.error, 1.0);
    if (worse > effect.worse_error || (a.right && std::isnan(b.error))) effect.worst = runs[i].name;
    effect.worse_error = std::max(effect.worse_error, worse);
  }
  effect.more_time = std::exp(logarithms / static_cast<double>(runs.size()));
  return effect;
}

std::vector<NamedConstant> select(const std::vector<std::string>& names) {
  if (std::ranges::find(names, "all") != names.end()) return {named_constants.begin(), named_constants.end()};
  std::vector<NamedConstant> chosen;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(named_constants, name, &NamedConstant::name);
    if (found == named_constants.end()) throw Error("no constant \"" + name + "\"; see Constants");
    chosen.push_back(*found);
  }
  return chosen;
}

void sensitivity(const std::vector<std::string>& names, const ReportOptions& options) {
  const std::vector<NamedConstant> chosen = select(names);
  require_writable(options);
  std::vector<SensitivityRun> runs = sensitivity_runs();
  std::erase_if(runs, [](const SensitivityRun& run) { return look(run).duration > longest_run; });
  const std::vector<Seen> before = look(runs);
  Table table{.columns = {"constant", "factor", "scenes", "worse_error", "more_time", "refused", "worst"},
              .rows = {}};
  Progress progress(2 * chosen.size());
  for (const NamedConstant& constant : chosen) {
    const double value = *constant.value;
    for (const double factor : {0.5, 2.0}) {
      progress.next(constant.name);
      *constant.value = value > 0.5 && value < 2.0 ? 1.0 + factor * (value - 1.0) : factor * value;
      const Effect effect = compare(runs, before, look(runs));
      table.rows.push_back({constant.name, shortest(factor), std::to_string(effect.changed),
                            scientific(effect.worse_error, 3), scientific(effect.more_time, 3),
                            std::to_string(effect.refused), effect.worst});
    }
    *constant.value = value;
  }
  const auto wrong = std::ranges::count_if(before, [](const Seen& s) { return !s.right; });
  report(
      "The solvers' constants halved and doubled (of those between 1/2 and 2, the distance from 1), over " +
          std::to_string(runs.size()) + " runs (" + std::to_string(wrong) +
          " of them beyond their limits as it is): how many change, the worst error in limits, work "
          "(geometric mean)",
      table, options);
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"Halves and doubles each of the solvers' constants"};
  ReportOptions options;
  std::vector<std::string> names{"all"};
  app.add_option("--constant", names, "all, or names as in the table")->delimiter(',')->capture_default_str();
  add_report(app, options);
  CLI11_PARSE(app, argc, argv);
  sensitivity(names, options);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "dalembert-sensitivity: " << error.what() << '\n';
  return 2;
}
