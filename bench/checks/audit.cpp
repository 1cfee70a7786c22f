#include <dalembert/bench/checks/commands.h>
#include <dalembert/bench/median.h>
#include <dalembert/bench/progress.h>
#include <dalembert/models/catalogue.h>
#include <dalembert/tests/extremes/cases/case.h>

#include <iostream>
#include <limits>

namespace dalembert::bench {

namespace {

/// What one run was found to be, a row for each law.
class Rows {
 public:
  Table table{.columns = {"scene", "stepper", "tolerance", "law", "worst", "limit", "cost"}, .rows = {}};
  int beyond = 0;

  void add(const std::string& scene, Stepper stepper, const std::string& tolerance, const Audit& found,
           double cost) {
    for (const Finding& one : found.worst) {
      table.rows.push_back({scene, name(stepper), tolerance, name(one.law), scientific(one.size),
                            scientific(one.limit), scientific(cost)});
      if (one.size <= one.limit) continue;
      ++beyond;
      std::cerr << scene << ", " << name(stepper) << " at " << tolerance << ": " << name(one.law) << ", "
                << one.element << " at t = " << one.time << ": " << scientific(one.size) << " where "
                << scientific(one.limit) << " is allowed\n";
    }
  }
};

/// Run time with the audit over without: the median of pairs.
template <int D>
[[nodiscard]] double cost(const Scene<D>& scene, Options options, int pairs) {
  std::vector<double> ratios;
  for (int i = 0; i < pairs; ++i) {
    options.audit = Audited::report;
    const double with = simulate(scene, options).statistics().run_time;
    options.audit = Audited::off;
    ratios.push_back(with / simulate(scene, options).statistics().run_time);
  }
  return ratios.empty() ? std::numeric_limits<double>::quiet_NaN() : median(std::move(ratios));
}

template <int D>
void add_model(const models::Model<D>& model, const AuditOptions& options, Rows& rows) {
  const Scene<D> scene = model.scene().scene;
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    for (const double tolerance : options.tolerances) {
      const Options run{
          .t_end = model.t_end, .tolerance = tolerance, .stepper = stepper, .audit = Audited::report};
      attempt(model.name, [&] {
        const Audit found = simulate(scene, run).statistics().audit;
        rows.add(model.name, stepper, shortest_power(tolerance), found, cost(scene, run, options.repeats));
      });
    }
  }
}

/// A case runs its scenes itself: the last one's audit is in its statistics, and any violation an error.
void add_extreme(const extremes::Case& extreme, double parameter, Stepper stepper, Rows& rows) {
  const extremes::Run run = extremes::judge(extreme, parameter, stepper);
  const std::string scene = extreme.name + ' ' + shortest(parameter);
  rows.add(scene, stepper, "", run.statistics.audit, std::numeric_limits<double>::quiet_NaN());
  if (run.right() || run.outcome.message.find("breaks a law") == std::string::npos) return;
  ++rows.beyond;
  std::cerr << scene << ", " << name(stepper) << ": " << run.outcome.message << '\n';
}

}  // namespace

int audit(const AuditOptions& options) {
  require_writable(options.report);
  Rows rows;
  for (const models::AnyModel& any : models::catalogue())
    std::visit([&](const auto& model) { add_model(model, options, rows); }, any);
  for (const extremes::Case& extreme : extremes::all_cases()) {
    for (const Stepper stepper : extreme.steppers)
      for (const double parameter : options.quick ? extreme.brief : extreme.sweep)
        add_extreme(extreme, parameter, stepper, rows);
  }
  report(
      "Audit: every law's worst violation against its limit; " + std::to_string(rows.beyond) + " beyond it",
      rows.table, options.report);
  return rows.beyond;
}

}  // namespace dalembert::bench
