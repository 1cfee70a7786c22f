#include <dalembert/bench/commands.h>
#include <dalembert/bench/methods.h>
#include <dalembert/bench/progress.h>
#include <dalembert/models/error.h>

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <limits>

namespace dalembert::bench {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // Linux counts in KiB
}

/// What one size gave.
struct Scaled {
  Statistics statistics;
  double error = nan;
  double memory = nan;
};

/// Error of the last positions. The reference needs to be good beside the run, not to round-off:
/// its steps are 1000 times as accurate as those of the run.
double last_error(const models::Chain& chain, const ScalingOptions& options,
                  const models::Observation<2>& last) {
  if (chain.beads > largest_compared) return nan;
  const models::Real tolerance = std::max(1e-3L * options.tolerance, models::reference_tolerance);
  const auto reference = chain.reference(std::array{options.t_end}, tolerance);
  return position_error(last, reference.front()) / chain.length;
}

models::Observation<2> run_library(const models::Chain& chain, const Options& options, Scaled& scaled) {
  const models::Observed<2> observed = models::observed(chain.scene());
  const Trajectory<2> trajectory = simulate(observed.scene, options);
  scaled.statistics = trajectory.statistics();
  scaled.memory = peak_memory_mib();
  return observed.observe(trajectory.sample(trajectory.size() - 1));
}

models::Observation<2> run_other(const models::Chain& chain, Method method, const Options& options,
                                 Scaled& scaled) {
  MethodRun<2> gave = bench::run(methods(chain), method, options);
  scaled.statistics = gave.statistics;
  scaled.memory = peak_memory_mib();
  return std::move(gave.seen.back());
}

Scaled run(const models::Chain& chain, Method method, const ScalingOptions& options) {
  Scaled scaled;
  Options run{.t_end = options.t_end, .samples = 2, .tolerance = options.tolerance};
  const std::optional<Stepper> own = stepper(method);
  if (own) run.stepper = *own;
  const models::Observation<2> last =
      own ? run_library(chain, run, scaled) : run_other(chain, method, run, scaled);
  scaled.error = last_error(chain, options, last);
  return scaled;
}

std::vector<std::string> row(const ScalingOptions& options, Method stepper, int size, const Scaled& scaled,
                             const Outcome& outcome) {
  const Statistics& s = scaled.statistics;
  return {options.model,
          name(stepper),
          std::to_string(size),
          shortest_power(options.tolerance),
          shortest(options.t_end),
          std::to_string(s.steps),
          std::to_string(s.evaluations),
          scientific(scaled.error),
          scientific(s.run_time),
          scientific(scaled.memory),
          outcome.name};
}

}  // namespace

void scaling(const ScalingOptions& options) {
  validate({.t_end = options.t_end, .tolerance = options.tolerance});
  if (options.model != "chain")
    throw Error("no model \"" + options.model + "\" of any size; there is: chain");
  require_writable(options.report);
  std::vector<int> sizes = options.sizes;
  std::sort(sizes.begin(), sizes.end());

  Table table{.columns = {"model", "stepper", "size", "tolerance", "t_end", "steps", "evaluations",
                          "error_position", "run_time_s", "peak_memory_mib", "outcome"},
              .rows = {}};
  {
    Progress progress(sizes.size() * options.steppers.size());
    for (const Method stepper : options.steppers) {
      for (const int size : sizes) {
        const std::string what = options.model + ", " + name(stepper) + ", size " + std::to_string(size);
        progress.next(what);
        Scaled scaled;
        const Outcome outcome =
            attempt(what, [&] { scaled = run(models::Chain{.beads = size}, stepper, options); });
        table.rows.push_back(row(options, stepper, size, scaled, outcome));
      }
    }
  }
  report(std::string("Run time and memory against size: one run each, error of the last positions") +
             remark(options.steppers),
         table, options.report);
}

}  // namespace dalembert::bench
