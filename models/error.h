#pragma once

#include <dalembert/models/model.h>

#include <span>
#include <vector>

namespace dalembert::models {

/// How far a run of a model is from its hand derivation.
struct Measurement {
  double error_position = 0.0;  ///< largest at any sample, relative to the model's length
  double error_force = 0.0;     ///< largest at any sample, relative to the model's force
  double energy_drift = 0.0;    ///< largest change of what is conserved, relative to the model's energy; NaN
                                ///< if nothing is
  Statistics statistics;
};

/// Runs a model and compares every sample with `reference`, the observations of the model at
/// sample_times(options). Throws what `simulate` throws.
template <int D>
[[nodiscard]] Measurement measure(const Model<D>& model, const Options& options,
                                  std::span<const Observation<D>> reference);

/// The same, computing the reference.
template <int D>
[[nodiscard]] Measurement measure(const Model<D>& model, const Options& options) {
  return measure<D>(model, options, model.observations(sample_times(options)));
}

/// The errors alone, of observations that came from anywhere; the drift is NaN.
template <int D>
[[nodiscard]] Measurement compare(const Model<D>& model, std::span<const Observation<D>> seen,
                                  std::span<const Observation<D>> reference);

/// Largest distance between the positions of two observations of the same points [length].
template <int D>
[[nodiscard]] double position_error(const Observation<D>& a, const Observation<D>& b);

extern template Measurement measure(const Model<2>&, const Options&, std::span<const Observation<2>>);
extern template Measurement measure(const Model<3>&, const Options&, std::span<const Observation<3>>);
extern template Measurement compare(const Model<2>&, std::span<const Observation<2>>,
                                    std::span<const Observation<2>>);
extern template Measurement compare(const Model<3>&, std::span<const Observation<3>>,
                                    std::span<const Observation<3>>);
extern template double position_error(const Observation<2>&, const Observation<2>&);
extern template double position_error(const Observation<3>&, const Observation<3>&);

}  // namespace dalembert::models
