#include "dalembert/bench/ladder.h"

#include <dalembert/bench/median.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dalembert::bench {

namespace {

constexpr double loosest = 1e-3;
constexpr std::size_t most_rungs = 21;  // down to 1e-13, the library's least

/// In each round a rung runs for about 5 ms, at most 50 times.
long runs_per_round(double run_time) { return std::lround(std::clamp(5e-3 / run_time, 1.0, 50.0)); }

}  // namespace

template <int D>
typename Ladder<D>::Rung Ladder<D>::run(double tolerance) const {
  const Options options{.t_end = contest_->model.t_end, .samples = 2, .tolerance = tolerance};
  const Entry entry = contest_->measure(contender_, options, reference_);
  if (!entry.outcome.ok() || std::isnan(entry.measured.error_position))
    return {tolerance, std::numeric_limits<double>::infinity(), {}};
  return {tolerance, entry.measured.error_position, {entry.measured.statistics.run_time}};
}

template <int D>
bool Ladder<D>::ended() const {
  if (rungs_.size() == most_rungs) return true;
  return !rungs_.empty() && !rungs_.back().run_times.empty() && rungs_.back().run_times.front() > limit_;
}

template <int D>
bool Ladder<D>::crossed(double error) const {
  const std::size_t k = first_below(error);
  return k + 1 < rungs_.size() && rungs_[k].error <= error && rungs_[k + 1].error <= error;
}

template <int D>
std::size_t Ladder<D>::first_below(double error) const {
  const auto meets = [&](const Rung& rung) { return rung.error <= error; };
  const auto pair = std::adjacent_find(rungs_.begin(), rungs_.end(),
                                       [&](const Rung& a, const Rung& b) { return meets(a) && meets(b); });
  const auto best = std::min_element(rungs_.begin(), rungs_.end(),
                                     [](const Rung& a, const Rung& b) { return a.error < b.error; });
  return static_cast<std::size_t>((pair != rungs_.end() ? pair : best) - rungs_.begin());
}

template <int D>
void Ladder<D>::climb(double error) {
  while (!crossed(error) && !ended()) {
    rungs_.push_back(run(loosest * std::pow(10.0, -0.5 * static_cast<double>(rungs_.size()))));
  }
  const std::size_t k = first_below(error);
  repeated_.insert(k);
  if (k > 0) repeated_.insert(k - 1);
}

template <int D>
void Ladder<D>::repeat() {
  for (const std::size_t k : repeated_) {
    Rung& rung = rungs_[k];
    if (rung.run_times.empty() || rung.run_times.front() > limit_) continue;
    for (long i = runs_per_round(rung.run_times.front()); i > 0; --i) {
      const Rung again = run(rung.tolerance);
      rung.run_times.insert(rung.run_times.end(), again.run_times.begin(), again.run_times.end());
    }
  }
}

template <int D>
typename Ladder<D>::Crossing Ladder<D>::crossing(double error) const {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t k = first_below(error);
  const Rung& tight = rungs_[k];
  Crossing found{tight.tolerance, tight.error, tight.run_times.empty() ? nan : median(tight.run_times)};
  if (tight.error > error) return found;
  if (k > 0 && rungs_[k - 1].error > error && !rungs_[k - 1].run_times.empty()) {
    // Straight between the two rungs in logarithmic scales.
    const Rung& loose = rungs_[k - 1];
    const double part = std::log(loose.error / error) / std::log(loose.error / tight.error);
    found.run_time = std::pow(median(loose.run_times), 1.0 - part) * std::pow(found.run_time, part);
  }
  // An explicit method at its limit of stability rejects fewer steps, and is faster, at tighter tolerances.
  for (const std::size_t i : repeated_) {
    if (i > k && rungs_[i].error <= error)
      found.run_time = std::min(found.run_time, median(rungs_[i].run_times));
  }
  return found;
}

template class Ladder<2>;
template class Ladder<3>;

}  // namespace dalembert::bench
