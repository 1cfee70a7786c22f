#include <dalembert/bench/checks/commands.h>
#include <dalembert/bench/median.h>
#include <dalembert/bench/models.h>
#include <dalembert/models/error.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <iostream>
#include <limits>
#include <span>
#include <utility>

namespace dalembert::bench {

namespace {

constexpr double allowed_error = 1.25, allowed_cost = 4.0;

/// Of all threads [s], the median of so many calls.
double time_of(int repeats, const std::function<void()>& call) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  std::vector<double> times;
  for (int i = 0; i < repeats; ++i) {
    const double begin = now();
    call();
    times.push_back(now() - begin);
  }
  return median(std::move(times));
}

/// A single run, with its true error of force.
struct Single {
  Options options;
  double error, time;
};

/// Down from the loosest tolerance, in steps of half a decade.
template <int D>
std::vector<Single> single_runs(const models::Model<D>& model,
                                std::span<const models::Observation<D>> reference, int repeats) {
  const auto scene = model.scene().scene;
  std::vector<Single> all;
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    for (double tolerance = 1e-1; tolerance > 9e-14; tolerance /= std::sqrt(10.0)) {
      const Options options{.t_end = model.t_end, .tolerance = tolerance, .stepper = stepper};
      try {
        const double error = models::measure<D>(model, options, reference).error_force;
        all.push_back({options, error, time_of(repeats, [&] { (void)simulate(scene, options); })});
      } catch (const Error&) {  // refused at this tolerance
      }
    }
  }
  return all;
}

double cheapest(std::span<const Single> runs, double error) {
  double time = std::numeric_limits<double>::quiet_NaN();
  for (const Single& run : runs)
    if (run.error <= error && !(run.time >= time)) time = run.time;
  return time;
}

struct Counts {
  int wrong = 0, unmet = 0, dear = 0;
};

template <int D>
void add_model(const models::Model<D>& model, const RequestsOptions& options, Table& table, Counts& counts) {
  const auto reference = model.observations(sample_times({.t_end = model.t_end}));
  const auto runs = single_runs<D>(model, reference, options.repeats);
  const models::Observed<D> observed = model.scene();
  for (const double error : options.errors) {
    const Request request{.t_end = model.t_end, .force_error = error * model.force};
    const auto found = simulate_to(observed.scene, request);
    std::vector<models::Observation<D>> seen;
    for (const Sample<D>& sample : found.run()) seen.push_back(observed.observe(sample));
    const double truth = models::compare<D>(model, seen, reference).error_force;
    const double time = time_of(options.repeats, [&] { (void)simulate_to(observed.scene, request); });
    const double least = cheapest(runs, error);
    const bool right = !found.outcome.met || truth <= allowed_error * error;
    const bool cheap = !(time > allowed_cost * least);
    counts.wrong += right ? 0 : 1;
    counts.unmet += found.outcome.met ? 0 : 1;
    counts.dear += cheap ? 0 : 1;
    if (!found.outcome.met || !right)
      std::cerr << model.name << ", " << shortest_power(error) << (right ? ": " : ": WRONG: ")
                << found.outcome.words << '\n';
    const auto& run = found.run();
    table.rows.push_back({model.name, shortest_power(error), run.record()->stepper,
                          scientific(run.record()->tolerance, 2), std::to_string(found.outcome.runs),
                          found.outcome.met ? "yes" : "no", scientific(truth),
                          scientific(found.certificate.largest().force.error / model.force), scientific(time),
                          scientific(least), scientific(time / least, 3)});
  }
}

}  // namespace

int requests(const RequestsOptions& options) {
  const auto selected = select_models(options.models);
  require_writable(options.report);
  Table table{.columns = {"model", "request", "stepper", "tolerance", "runs", "met", "true_error",
                          "estimated_error", "time_s", "cheapest_s", "cost"},
              .rows = {}};
  Counts counts;
  for (const models::AnyModel& any : selected)
    std::visit([&](const auto& model) { add_model(model, options, table, counts); }, any);
  report(
      "Requested errors of force, relative to the model's: what simulate_to gives, and its processor time "
      "over that of the cheapest single run that meets the request; " +
          std::to_string(counts.wrong) + " wrong, " + std::to_string(counts.unmet) + " said not to be met, " +
          std::to_string(counts.dear) + " beyond 4 times the cost",
      table, options.report);
  return counts.wrong;
}

}  // namespace dalembert::bench
