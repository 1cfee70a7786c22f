#pragma once

#include <dalembert/bench/method.h>
#include <dalembert/models/error.h>
#include <dalembert/tests/outcome.h>

namespace dalembert::bench {

/// What one run gave. If it was refused, the errors are NaN.
struct Result : models::Measurement {
  Outcome outcome = {};
};

/// A model and all that can integrate it.
template <int D>
struct Benchmark {
  models::Model<D> model;
  Methods<D> methods = {};

  [[nodiscard]] bool has(Method method) const { return stepper(method) || methods.contains(method); }
  /// Runs one of them, whatever stepper the options name, and compares with `reference`, the observations
  /// of the model at sample_times(options).
  [[nodiscard]] Result measure(Method method, Options options,
                               std::span<const models::Observation<D>> reference) const;
};

template <int D>
Benchmark(models::Model<D>, Methods<D>) -> Benchmark<D>;  // clang 14 deduces none for aggregates

extern template struct Benchmark<2>;
extern template struct Benchmark<3>;

}  // namespace dalembert::bench
