#pragma once

#include <dalembert/bench/method.h>
#include <dalembert/bench/outcome.h>
#include <dalembert/models/error.h>

namespace dalembert::bench {

/// What one run gave. If it was refused, the errors are NaN.
struct Entry {
  models::Measurement measured;
  Outcome outcome = {};
};

/// A model and all that can integrate it.
template <int D>
struct Contest {
  models::Model<D> model;
  Methods<D> methods = {};

  [[nodiscard]] bool admits(Contender contender) const {
    return stepper(contender) || methods.contains(contender);
  }
  /// Runs one of them, whatever stepper the options name, and compares with `reference`, the observations
  /// of the model at sample_times(options).
  [[nodiscard]] Entry measure(Contender contender, Options options,
                              std::span<const models::Observation<D>> reference) const;
};

extern template struct Contest<2>;
extern template struct Contest<3>;

}  // namespace dalembert::bench
