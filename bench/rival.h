#pragma once

#include <dalembert/bench/contender.h>
#include <dalembert/models/model.h>

#include <functional>
#include <map>
#include <span>
#include <vector>

namespace dalembert::bench {

/// What a rival's run gave: the model's observations at the times asked for, and what they cost.
template <int D>
struct RivalRun {
  std::vector<models::Observation<D>> seen;
  Statistics statistics;
};

/// Integrates one system from times.front() to times.back() without the library. The tolerance is the
/// rival's own: only errors and run times compare.
template <int D>
using Rival = std::function<RivalRun<D>(std::span<const double> times, double tolerance)>;

template <int D>
using Rivals = std::map<Contender, Rival<D>>;

/// A rival's run could not be finished.
struct RivalFailure : Error {
  using Error::Error;
};

/// One of them, run as the options say. Throws RivalFailure for whatever its library throws.
template <int D>
[[nodiscard]] RivalRun<D> run(const Rivals<D>& rivals, Contender contender, const Options& options) try {
  return rivals.at(contender)(sample_times(options), options.tolerance);
} catch (const std::exception& error) {
  throw RivalFailure(error.what());
}

}  // namespace dalembert::bench
