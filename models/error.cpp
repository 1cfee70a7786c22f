#include "dalembert/models/error.h"

#include <cmath>
#include <limits>
#include <string>

namespace dalembert::models {

namespace {

void require_same(std::size_t a, std::size_t b, const char* what) {
  if (a == b) return;
  throw Error("a run and its reference differ in the number of " + std::string(what) + ": " +
              std::to_string(a) + " and " + std::to_string(b));
}

/// The larger of the two, or NaN if either is: std::max would lose a NaN.
double larger(double a, double b) { return std::isnan(a) || a > b ? a : b; }

template <int D>
double force_error(const Observation<D>& a, const Observation<D>& b) {
  require_same(a.forces.size(), b.forces.size(), "forces");
  double error = 0.0;
  for (std::size_t i = 0; i < a.forces.size(); ++i)
    error = larger(error, std::abs(a.forces[i] - b.forces[i]));
  return error;
}

}  // namespace

template <int D>
double position_error(const Observation<D>& a, const Observation<D>& b) {
  require_same(a.positions.size(), b.positions.size(), "positions");
  double error = 0.0;
  for (std::size_t i = 0; i < a.positions.size(); ++i)
    error = larger(error, (a.positions[i] - b.positions[i]).norm());
  return error;
}

template <int D>
Measurement measure(const Model<D>& model, const Options& options,
                    std::span<const Observation<D>> reference) {
  const Observed<D> observed = model.scene();
  const Trajectory<D> run = simulate(observed.scene, options);
  require_same(run.size(), reference.size(), "samples");
  const auto conserved = [&](std::size_t i) {
    return observed.conserved ? observed.conserved(run.sample(i)) : std::numeric_limits<double>::quiet_NaN();
  };
  Measurement m;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Observation<D> seen = observed.observe(run.sample(i));
    m.error_position = larger(m.error_position, position_error(seen, reference[i]) / model.length);
    m.error_force = larger(m.error_force, force_error(seen, reference[i]) / model.force);
    m.energy_drift = larger(m.energy_drift, std::abs(conserved(i) - conserved(0)) / model.energy);
  }
  m.statistics = run.statistics();
  return m;
}

template Measurement measure(const Model<2>&, const Options&, std::span<const Observation<2>>);
template Measurement measure(const Model<3>&, const Options&, std::span<const Observation<3>>);
template double position_error(const Observation<2>&, const Observation<2>&);
template double position_error(const Observation<3>&, const Observation<3>&);

}  // namespace dalembert::models
