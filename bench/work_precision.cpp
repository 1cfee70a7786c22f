#include <dalembert/bench/benchmark.h>
#include <dalembert/bench/commands.h>
#include <dalembert/bench/methods.h>
#include <dalembert/bench/models.h>
#include <dalembert/bench/progress.h>

namespace dalembert::bench {

namespace {

using models::AnyModel;
using models::Model;

std::vector<std::string> row(const std::string& model, Method stepper, double tolerance,
                             const Result& result) {
  const Statistics& s = result.statistics;
  return {model,
          name(stepper),
          shortest_power(tolerance),
          std::to_string(s.steps),
          std::to_string(s.evaluations),
          std::to_string(s.factorisations),
          scientific(result.error_position),
          scientific(result.error_force),
          scientific(s.residual_position),
          scientific(s.residual_velocity),
          scientific(result.energy_drift),
          scientific(s.run_time),
          result.outcome.name};
}

/// The curves of one model, added to the table; the reference is computed once.
class Curves {
 public:
  Curves(const WorkPrecisionOptions& options, Table& table, Progress& progress)
      : options_(options), table_(table), progress_(progress) {}

  template <int D>
  void operator()(const Model<D>& model) {
    const Benchmark<D> benchmark{model, methods(model)};
    const Options run{.t_end = model.t_end, .samples = options_.samples};
    const auto reference = model.observations(sample_times(run));
    for (const Method stepper : options_.steppers) {
      if (benchmark.has(stepper)) add<D>(benchmark, stepper, run, reference);
    }
  }

 private:
  template <int D>
  void add(const Benchmark<D>& benchmark, Method stepper, Options run,
           std::span<const models::Observation<D>> reference) {
    const std::string& model = benchmark.model.name;
    std::vector<Result> results;
    int round = 0;
    const auto points =
        detail::work_precision_curve(options_.tolerances, options_.repeats, [&](double tolerance) {
          if (tolerance == options_.tolerances.front())
            progress_.next(model + ", " + name(stepper) + ", run " + std::to_string(++round));
          run.tolerance = tolerance;
          const Result& r = results.emplace_back(benchmark.measure(stepper, run, reference));
          return WorkPrecisionPoint{name(stepper), tolerance,        r.error_position, r.error_force, {},
                                    r.statistics,  r.outcome.message};
        });
    for (std::size_t k = 0; k < points.size(); ++k) add_row(model, stepper, points[k], results[k]);
  }
  void add_row(const std::string& model, Method stepper, const WorkPrecisionPoint& point, Result result) {
    if (result.outcome.ok()) {
      result.statistics.run_time = point.statistics.run_time;
    } else {
      tell(model + ", " + name(stepper) + " at tolerance " + shortest_power(point.tolerance), result.outcome);
    }
    table_.rows.push_back(row(model, stepper, point.tolerance, result));
  }

  const WorkPrecisionOptions& options_;
  Table& table_;
  Progress& progress_;
};

/// How many curves there will be.
std::size_t number_of_curves(const std::vector<AnyModel>& models, const WorkPrecisionOptions& options) {
  std::size_t count = 0;
  for (const Method stepper : options.steppers) {
    for (const AnyModel& any : models)
      count += std::visit(
          [&](const auto& m) {
            return Benchmark{m, methods(m)}.has(stepper) ? 1U : 0U;
          },
          any);
  }
  return count * static_cast<std::size_t>(options.repeats);
}

}  // namespace

void work_precision(const WorkPrecisionOptions& options) {
  const std::vector<AnyModel> selected = select_models(options.models);
  for (const double tolerance : options.tolerances) validate({.t_end = 1.0, .tolerance = tolerance});
  (void)sample_times({.t_end = 1.0, .samples = options.samples});
  require_writable(options.report);

  Table table{.columns = {"model", "stepper", "tolerance", "steps", "evaluations", "factorisations",
                          "error_position", "error_force", "residual_position", "residual_velocity",
                          "energy_drift", "run_time_s", "outcome"},
              .rows = {}};
  {
    Progress progress(number_of_curves(selected, options));
    Curves curves(options, table, progress);
    for (const AnyModel& model : selected) std::visit(curves, model);
  }
  report("Error against run time: largest errors of " + std::to_string(options.samples) +
             " samples, run time the median of " + std::to_string(options.repeats) + remark(options.steppers),
         table, options.report);
}

}  // namespace dalembert::bench
