#include "dalembert/solvers/certificate/simulate_to.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/certificate/better_run.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

namespace dalembert {

namespace {

/// Explicit runs of the catalogue err by up to 700 tolerances in force, one in five by more than this. Twice
/// as many, or half, cost a sixth more or less where the first runs serve.
constexpr double usual_error = 50.0;
constexpr double loosest = 1e-2;
/// What a tolerance is chosen for, as a part of the request: errors follow it to a factor of 2.
constexpr double aim = 0.5;
/// The second run's part of the tolerance. Runs of order 8 at T and T/30 cost 1 + 30^(1/8) = 2.53 times the
/// first, at T/100 2.78 times; the estimate is right to a thirtieth in place of a hundredth, a small part of
/// what `aim` leaves.
constexpr double of_certifying = 1.0 / 30.0;
/// Errors that follow the tolerance less than its square root are not looked for.
constexpr double least_power = 0.5;
constexpr int most_attempts = 8;
/// A run that one at the least tolerance of all still certifies.
constexpr double least = 2.0 * smallest_tolerance / TwoRuns::most_of_better;
/// An explicit run of more steps is looked at: whether an implicit one takes fewer.
constexpr long telling_steps = 1000;
/// A thread costs some 0.2 ms, with the memory that is its own: a tenth of this [s].
constexpr double worth_a_thread = 2e-3;

void require_request(const Request& r) {
  const auto require = [](bool good, const char* what, double value) {
    if (good) return;
    std::ostringstream out;
    out << "Request " << what << " = " << value << ": must be finite and > 0, or 0 if it is not asked for";
    throw InvalidArgument(out.str());
  };
  const auto sensible = [](double x) { return std::isfinite(x) && x >= 0.0; };
  require(sensible(r.force_error), "force_error", r.force_error);
  require(sensible(r.position_error), "position_error", r.position_error);
  require(sensible(r.event_error), "event_error", r.event_error);
  if (r.force_error == 0.0 && r.position_error == 0.0 && r.event_error == 0.0)
    throw InvalidArgument("simulate_to: ask for a force_error, position_error or event_error");
}

Options options_of(const Request& request) {
  Options options = request.options;
  options.t_end = request.t_end;
  options.t_start = request.t_start;
  options.samples = request.samples;
  options.times = request.times;
  options.sample_interval = 0.0;
  options.stepper = Stepper::erk;
  if (options.audit == Audited::off) options.audit = Audited::error;
  return options;
}

/// What errors are relative to.
struct Sizes {
  double length = 1.0, time = 1.0, force = 1.0;
};

template <int D>
Sizes sizes_at_start(const Scene<D>& scene, const Options& options) {
  const Simulation<D> start(scene, options);
  const Statistics statistics = start.statistics();
  Sizes sizes{statistics.length, statistics.time, 0.0};
  const Sample<D> now = start.sample();
  for (const double lambda : now.flat().lambda)
    if (std::isfinite(lambda)) sizes.force = std::max(sizes.force, std::abs(lambda));
  for (const auto& particle : now.layout().particles)
    sizes.force = std::max(sizes.force, particle.mass * sizes.length / (sizes.time * sizes.time));
  return sizes;
}

/// Runs, each by the errors of those before it, until a certificate meets the request.
class Approach {
 public:
  Approach(Run run, const Request& request, const Sizes& sizes)
      : run_(std::move(run)), request_(request), sizes_(sizes), options_(options_of(request)) {}

  [[nodiscard]] TwoRuns find() {
    begin();
    while (keep_if_best() > 1.0 && attempts_++ < most_attempts && refine()) {
    }
    outcome.met = best_excess_ <= 1.0;
    outcome.words = words();
    return std::move(*best_);
  }

  RequestOutcome outcome;

 private:
  [[nodiscard]] double first_tolerance() const {
    double part = std::numeric_limits<double>::infinity();
    const auto ask = [&](double error, double unit) {
      if (error > 0.0) part = std::min(part, error / unit);
    };
    const bool relative = request_.relative;
    ask(request_.force_error, relative ? 1.0 : sizes_.force);
    ask(request_.position_error, relative ? 1.0 : sizes_.length);
    ask(request_.event_error, sizes_.time / (relative ? request_.t_end - request_.t_start : 1.0));
    return std::clamp(part / usual_error, least, loosest);
  }

  void begin() {
    options_.tolerance = first_tolerance();
    Options first = options_, second = certifying(options_);
    first.max_steps = second.max_steps = std::min(telling_steps, options_.max_steps);
    take(pair(first, second, false));
    const bool stopped = !run_of_first_.stopped.empty();
    if (!stopped && better_.stopped.empty()) return;
    const FinishedRun& cut = stopped ? run_of_first_ : better_;
    if (is_stiff(cut)) {
      options_.stepper = Stepper::ida;
      cut_short_ = cut;
    }
    start_pair();
    if (run_of_first_.failure) std::rethrow_exception(run_of_first_.failure);
  }

  static Options certifying(const Options& options) {
    return tighter(options, options.stepper, of_certifying);
  }

  /// Whether an explicit run, which was cut short, would take more steps than an implicit one.
  [[nodiscard]] bool is_stiff(const FinishedRun& cut) {
    const long steps = cut.record->statistics.steps;
    if (steps < telling_steps) return true;  // something else stopped it
    const double part = (cut.reached - options_.t_start) / (options_.t_end - options_.t_start);
    const double all = static_cast<double>(steps) / std::max(part, 1e-6);
    Options implicit = options_;
    implicit.stepper = Stepper::ida;
    implicit.max_steps = static_cast<long>(std::min(all, static_cast<double>(options_.max_steps)));
    return count(finish(run_, implicit)).stopped.empty();
  }

  /// A run at the tolerance of the options, and one to certify it.
  void start_pair() {
    const bool long_runs = run_of_first_.record->statistics.run_time > worth_a_thread;
    take(pair(options_, certifying(options_), long_runs));
  }

  [[nodiscard]] std::pair<FinishedRun, FinishedRun> pair(const Options& a, const Options& b, bool at_once) {
    if (at_once) return finish_both(run_, a, b);
    FinishedRun first = finish(run_, a);
    return {std::move(first), finish(run_, b)};
  }

  void take(std::pair<FinishedRun, FinishedRun> pair) {
    run_of_first_ = count(std::move(pair.first));
    better_ = count(std::move(pair.second));
  }
  FinishedRun count(FinishedRun finished) {
    ++outcome.runs;
    outcome.processor_time += finished.record->statistics.run_time;
    return finished;
  }

  /// The largest error over what it may be, infinite where one is not known.
  [[nodiscard]] double excess(const TwoRuns& runs) const {
    const LargestErrors errors = largest_errors(runs);
    const bool no_force_known = errors.force.of.empty() && runs.largest_force() > 0.0;
    if (!run_of_first_.stopped.empty() || errors.beyond > 0 || (request_.force_error > 0.0 && no_force_known))
      return std::numeric_limits<double>::infinity();
    double most = 0.0;
    const auto ask = [&](double error, double wanted, double unit) {
      if (wanted > 0.0) most = std::max(most, error / (wanted * (request_.relative ? unit : 1.0)));
    };
    ask(errors.force.error, request_.force_error, runs.largest_force() > 0.0 ? runs.largest_force() : 1.0);
    ask(errors.position.error, request_.position_error, runs.reference()->statistics.length);
    ask(errors.event_time.error, request_.event_error, request_.t_end - request_.t_start);
    return most;
  }

  /// Up to when the errors of a run are; of two that are not known to the end the longer is the better.
  [[nodiscard]] double known_until(const TwoRuns& runs) const {
    return run_of_first_.stopped.empty() ? runs.known_until()
                                         : std::min(runs.known_until(), run_of_first_.reached);
  }

  double keep_if_best() {
    const std::string& stopped = run_of_first_.stopped.empty() ? better_.stopped : run_of_first_.stopped;
    PassedOver both;
    if (cut_short_ && stopped.empty()) {
      Options better = options_;
      better.tolerance = better_.record->tolerance;
      both = passed_over([this](const Options& own) { return count(finish(run_, own)).record; }, better,
                         *run_of_first_.record, *cut_short_);
    }
    TwoRuns runs(run_of_first_.record, better_.record, stopped, both);
    excess_ = excess(runs);
    const double known = known_until(runs);
    if (!best_ || excess_ < best_excess_ || (excess_ == best_excess_ && known > best_known_)) {
      best_excess_ = excess_;
      best_known_ = known;
      best_.emplace(std::move(runs));
    }
    return excess_;
  }

  [[nodiscard]] bool claims_are_too_close() const {
    return better_.stopped.empty() && run_of_first_.stopped.empty() &&
           better_.record->statistics.accuracy >
               TwoRuns::most_of_better * run_of_first_.record->statistics.accuracy;
  }

  /// Whether the more accurate run is so of one at another tolerance too, by half the ratio to be sure.
  [[nodiscard]] bool serves_at(double tolerance) const {
    const double claim = run_of_first_.record->statistics.accuracy * tolerance / options_.tolerance;
    return 2.0 * better_.record->statistics.accuracy <= TwoRuns::most_of_better * claim;
  }

  /// The next runs; false if there are none more accurate.
  bool refine() {
    const double of_better = better_.record->tolerance;
    if (claims_are_too_close() && of_better > smallest_tolerance) {
      Options next = options_;
      next.tolerance = of_better;
      better_ = count(finish(run_, certifying(next)));
      return true;
    }
    if (options_.tolerance <= least) return false;
    const double wanted =
        std::isfinite(excess_) ? std::max(std::pow(aim / excess_, 1.0 / power()), 1e-4) : 1e-2;
    excess_before_ = excess_;
    tolerance_before_ = options_.tolerance;
    const double next = std::max(wanted * options_.tolerance, least);
    if (better_.stopped.empty() && serves_at(next)) {
      options_.tolerance = next;  // the more accurate run still is
      run_of_first_ = count(finish(run_, options_));
    } else if (next >= of_better && better_.stopped.empty()) {
      options_.tolerance = of_better;
      run_of_first_ = std::exchange(better_, count(finish(run_, certifying(options_))));
    } else {
      options_.tolerance = next;
      start_pair();
    }
    return true;
  }

  /// Of the tolerance, that errors follow: 1, but near a singular position forces are known to its square
  /// root. By the last two runs.
  [[nodiscard]] double power() const {
    if (!std::isfinite(excess_before_) || !(options_.tolerance < tolerance_before_)) return 1.0;
    const double seen = std::log(excess_before_ / excess_) / std::log(tolerance_before_ / options_.tolerance);
    return std::clamp(seen, least_power, 1.0);
  }

  [[nodiscard]] std::string words() const {
    const Record& run = *best_->run();
    std::ostringstream out;
    out.precision(3);
    out << (outcome.met ? "The request is met" : "The request is not met") << " by " << run.stepper
        << " at tolerance " << run.tolerance << ", after " << outcome.runs << " runs";
    if (outcome.met) return out.str();
    if (std::isfinite(best_excess_)) out << ": the error is " << best_excess_ << " times as large";
    if (!best_->reservation().empty()) out << ": " << best_->reservation();
    if (best_->vibrates())
      out << ": what vibrates faster than implicit steps follow counts with twice its amplitude";
    out << "; of the tolerances down to " << options_.tolerance << " it is the best";
    return out.str();
  }

  Run run_;
  const Request& request_;
  Sizes sizes_;
  Options options_;
  FinishedRun run_of_first_, better_;
  std::optional<FinishedRun> cut_short_;  ///< an explicit one, of a stiff scene
  std::optional<TwoRuns> best_;
  double excess_ = 0.0, best_excess_ = 0.0, best_known_ = 0.0;
  double excess_before_ = std::numeric_limits<double>::infinity(), tolerance_before_ = 0.0;
  int attempts_ = 0;
};

}  // namespace

template <int D>
SimulatedTo<D> simulate_to(const Scene<D>& scene, const Request& request,
                           const std::vector<Event<D>>& events) {
  require_request(request);
  const Options options = options_of(request);
  (void)sample_times(options);
  Approach approach([&](const Options& own) { return simulate(scene, own, events).record(); }, request,
                    sizes_at_start(scene, options));
  TwoRuns found = approach.find();
  return {Certificate<D>(std::move(found)), approach.outcome};
}

template SimulatedTo<2> simulate_to(const Scene<2>&, const Request&, const std::vector<Event<2>>&);
template SimulatedTo<3> simulate_to(const Scene<3>&, const Request&, const std::vector<Event<3>>&);

}  // namespace dalembert
