#include <dalembert/bench/checks/commands.h>
#include <dalembert/bench/progress.h>
#include <dalembert/tests/extremes/cases/case.h>

#include <algorithm>
#include <iostream>

namespace dalembert::bench {

namespace {

using extremes::Case;
using extremes::Run;

const std::vector<std::string> columns = {"case",  "parameter",  "stepper", "outcome", "error",
                                          "steps", "run_time_s", "limit",   "varied"};

std::vector<Case> select(const std::vector<std::string>& names) {
  std::vector<Case> all = extremes::all_cases();
  if (std::ranges::find(names, "all") != names.end()) return all;
  for (const std::string& name : names) {
    if (std::ranges::find(all, name, &Case::name) != all.end()) continue;
    std::string known;
    for (const Case& c : all) known += ' ' + c.name;
    throw Error("no case \"" + name + "\"; there are: all" + known);
  }
  std::erase_if(all, [&](const Case& c) { return std::ranges::find(names, c.name) == names.end(); });
  return all;
}

std::vector<std::string> row(const Case& extreme, const Run& run) {
  return {extreme.name,
          shortest_power(run.parameter),
          name(run.stepper),
          run.outcome.name,
          scientific(run.error),
          std::to_string(run.statistics.steps),
          scientific(run.statistics.run_time),
          scientific(run.limit),
          extreme.parameter};
}

/// What went wrong, for a reader at the terminal.
void complain(const Case& extreme, const Run& run) {
  std::cerr << extreme.name << ", " << extreme.parameter << " = " << shortest(run.parameter) << ", "
            << name(run.stepper) << ": error " << scientific(run.error) << ", limit "
            << scientific(run.limit);
  if (!run.outcome.message.empty()) std::cerr << ": " << run.outcome.message;
  std::cerr << '\n';
}

}  // namespace

int extremes(const ExtremesOptions& options) {
  const std::vector<Case> cases = select(options.cases);
  require_writable(options.report);
  Table table{.columns = columns, .rows = {}};
  int failures = 0;
  {
    Progress progress(cases.size());
    for (const Case& extreme : cases) {
      progress.next(extreme.name);
      for (const Stepper stepper : extreme.steppers) {
        for (const double parameter : options.quick ? extreme.brief : extreme.sweep) {
          const Run run = extremes::judge(extreme, parameter, stepper);
          table.rows.push_back(row(extreme, run));
          if (run.right()) continue;
          complain(extreme, run);
          ++failures;
        }
      }
    }
  }
  report("Extremes: error within the limit, or the refusal that is due; " + std::to_string(failures) +
             " rows are neither",
         table, options.report);
  return failures;
}

}  // namespace dalembert::bench
