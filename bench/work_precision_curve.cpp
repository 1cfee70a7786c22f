#include "dalembert/bench/work_precision_curve.h"

#include <dalembert/bench/median.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dalembert::bench {

namespace {

constexpr double loosest = 1e-3;
constexpr std::size_t most_runs = 21;  // down to 1e-13, the library's least

/// In each round a run is repeated for about 5 ms, at most 50 times.
long runs_per_round(double run_time) { return std::lround(std::clamp(5e-3 / run_time, 1.0, 50.0)); }

}  // namespace

template <int D>
typename WorkPrecisionCurve<D>::Tried WorkPrecisionCurve<D>::run(double tolerance) const {
  const Options options{.t_end = benchmark_->model.t_end, .samples = 2, .tolerance = tolerance};
  const Result result = benchmark_->measure(method_, options, reference_);
  if (!result.outcome.ok() || std::isnan(result.error_position))
    return {tolerance, std::numeric_limits<double>::infinity(), {}};
  return {tolerance, result.error_position, {result.statistics.run_time}};
}

template <int D>
bool WorkPrecisionCurve<D>::ended() const {
  if (runs_.size() == most_runs) return true;
  return !runs_.empty() && !runs_.back().run_times.empty() && runs_.back().run_times.front() > limit_;
}

template <int D>
bool WorkPrecisionCurve<D>::crossed(double error) const {
  const std::size_t k = first_below(error);
  return k + 1 < runs_.size() && runs_[k].error <= error && runs_[k + 1].error <= error;
}

template <int D>
std::size_t WorkPrecisionCurve<D>::first_below(double error) const {
  const auto meets = [&](const Tried& run) { return run.error <= error; };
  const auto pair = std::adjacent_find(runs_.begin(), runs_.end(),
                                       [&](const Tried& a, const Tried& b) { return meets(a) && meets(b); });
  const auto best = std::min_element(runs_.begin(), runs_.end(),
                                     [](const Tried& a, const Tried& b) { return a.error < b.error; });
  return static_cast<std::size_t>((pair != runs_.end() ? pair : best) - runs_.begin());
}

template <int D>
void WorkPrecisionCurve<D>::reach(double error) {
  while (!crossed(error) && !ended()) {
    runs_.push_back(run(loosest * std::pow(10.0, -0.5 * static_cast<double>(runs_.size()))));
  }
  const std::size_t k = first_below(error);
  repeated_.insert(k);
  if (k > 0) repeated_.insert(k - 1);
}

template <int D>
void WorkPrecisionCurve<D>::repeat() {
  for (const std::size_t k : repeated_) {
    Tried& tried = runs_[k];
    if (tried.run_times.empty() || tried.run_times.front() > limit_) continue;
    for (long i = runs_per_round(tried.run_times.front()); i > 0; --i) {
      const Tried again = run(tried.tolerance);
      tried.run_times.insert(tried.run_times.end(), again.run_times.begin(), again.run_times.end());
    }
  }
}

template <int D>
typename WorkPrecisionCurve<D>::Crossing WorkPrecisionCurve<D>::crossing(double error) const {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t k = first_below(error);
  const Tried& tight = runs_[k];
  Crossing found{tight.tolerance, tight.error, tight.run_times.empty() ? nan : median(tight.run_times)};
  if (tight.error > error) return found;
  if (k > 0 && runs_[k - 1].error > error && !runs_[k - 1].run_times.empty()) {
    // Straight between the two runs in logarithmic scales.
    const Tried& loose = runs_[k - 1];
    const double part = std::log(loose.error / error) / std::log(loose.error / tight.error);
    found.run_time = std::pow(median(loose.run_times), 1.0 - part) * std::pow(found.run_time, part);
  }
  // An explicit method at its limit of stability rejects fewer steps, and is faster, at tighter tolerances.
  for (const std::size_t i : repeated_) {
    if (i > k && runs_[i].error <= error)
      found.run_time = std::min(found.run_time, median(runs_[i].run_times));
  }
  return found;
}

template class WorkPrecisionCurve<2>;
template class WorkPrecisionCurve<3>;

}  // namespace dalembert::bench
