#pragma once

#include <dalembert/bench/contender.h>
#include <dalembert/models/model.h>

#include <functional>
#include <map>
#include <span>
#include <vector>

namespace dalembert::bench {

/// What a method's run gave: the model's observations at the times asked for, and what they cost.
template <int D>
struct MethodRun {
  std::vector<models::Observation<D>> seen;
  Statistics statistics;
};

/// Integrates one system from times.front() to times.back() without the library. The tolerance is the
/// method's own: only errors and run times compare.
template <int D>
using Method = std::function<MethodRun<D>(std::span<const double> times, double tolerance)>;

template <int D>
using Methods = std::map<Contender, Method<D>>;

/// A method's run could not be finished.
struct MethodFailure : Error {
  using Error::Error;
};

/// One of them, run as the options say. Throws MethodFailure for whatever its library throws.
template <int D>
[[nodiscard]] MethodRun<D> run(const Methods<D>& methods, Contender contender, const Options& options) try {
  return methods.at(contender)(sample_times(options), options.tolerance);
} catch (const std::exception& error) {
  throw MethodFailure(error.what());
}

}  // namespace dalembert::bench
