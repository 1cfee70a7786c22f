#include <dalembert/bench/commands.h>
#include <dalembert/bench/leave_out_pairs.h>
#include <dalembert/bench/median.h>
#include <dalembert/bench/progress.h>

#include <algorithm>
#include <limits>

namespace dalembert::bench {

namespace {

/// What every model of the catalogue is required to err by at most, in units of its length times the
/// tolerance; of two runs, each may.
constexpr double allowed_of_one_run = 1000.0;

/// Largest distance between the same points at the samples that both have.
double difference(const Motion& full, const Motion& lean) {
  const std::size_t stride = (full.samples.size() - 1) / (lean.samples.size() - 1);
  double largest = 0.0;
  for (std::size_t i = 0; i < lean.samples.size(); ++i)
    for (std::size_t p = 0; p < lean.samples[i].size(); ++p)
      largest = std::max(largest, (full.samples[i * stride][p] - lean.samples[i][p]).norm());
  return largest;
}

struct Comparison {
  double run_time_full = std::numeric_limits<double>::quiet_NaN();
  double run_time = std::numeric_limits<double>::quiet_NaN();
  long steps_full = 0, steps = 0;
  double difference = std::numeric_limits<double>::quiet_NaN();
};

/// In turn, so that what disturbs the machine for a while hits both.
Comparison compare(const Pair& pair, Stepper stepper, const LeaveOutOptions& options) {
  Options run{.t_end = pair.t_end, .tolerance = options.tolerance, .stepper = stepper};
  std::vector<double> times_full, times;
  Comparison c{.difference = 0.0};
  for (int i = 0; i < options.repeats; ++i) {
    run.samples = pair.samples_full;
    run.dense = pair.dense_full;
    const Motion full = pair.full.run(run);
    run.samples = pair.samples;
    run.dense = false;
    const Motion lean = pair.lean.run(run);
    times_full.push_back(full.run_time);
    times.push_back(lean.run_time);
    c.steps_full = full.steps;
    c.steps = lean.steps;
    c.difference = std::max(c.difference, difference(full, lean));
  }
  c.run_time_full = median(times_full);
  c.run_time = median(times);
  return c;
}

}  // namespace

int leave_out(const LeaveOutOptions& options) {
  validate({.t_end = 1.0, .tolerance = options.tolerance});
  require_writable(options.report);
  const std::vector<Pair> pairs = leave_out_pairs(options.size);
  Table table{
      .columns = {"scene", "left_out", "unknowns_full", "unknowns", "run_time_full_s", "run_time_s",
                  "stepper", "steps_full", "steps", "difference_position", "allowed_position", "outcome"},
      .rows = {}};
  int wrong = 0;
  {
    Progress progress(pairs.size() * options.steppers.size());
    for (const Pair& pair : pairs) {
      for (const Stepper stepper : options.steppers) {
        const std::string what = pair.scene + " without " + pair.left_out + ", " + name(stepper);
        progress.next(what);
        const double allowed = 2.0 * allowed_of_one_run * options.tolerance * pair.length;
        Comparison c;
        Outcome outcome = attempt(what, [&] { c = compare(pair, stepper, options); });
        if (outcome.ok() && !(c.difference <= allowed)) {
          outcome = {"another-motion", "the two statements give another motion"};
          tell(what, outcome);
          ++wrong;
        }
        table.rows.push_back({pair.scene, pair.left_out, std::to_string(pair.full.unknowns),
                              std::to_string(pair.lean.unknowns), scientific(c.run_time_full),
                              scientific(c.run_time), name(stepper), std::to_string(c.steps_full),
                              std::to_string(c.steps), scientific(c.difference), scientific(allowed),
                              outcome.name});
      }
    }
  }
  report("What leaving out saves: one motion stated twice, run in turn, median of " +
             std::to_string(options.repeats),
         table, options.report);
  return wrong;
}

}  // namespace dalembert::bench
