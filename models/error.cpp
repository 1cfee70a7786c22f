#include "dalembert/models/error.h"

#include <cmath>
#include <limits>
#include <string>

namespace dalembert::models {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

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
  // Of what a run gives only a force that is not determined is no number: all others are refused.
  for (std::size_t i = 0; i < a.forces.size(); ++i)
    if (!std::isnan(a.forces[i])) error = larger(error, std::abs(a.forces[i] - b.forces[i]));
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
Measurement compare(const Model<D>& model, std::span<const Observation<D>> seen,
                    std::span<const Observation<D>> reference) {
  require_same(seen.size(), reference.size(), "samples");
  Measurement m;
  m.energy_drift = none;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    m.error_position = larger(m.error_position, position_error(seen[i], reference[i]) / model.length);
    m.error_force = larger(m.error_force, force_error(seen[i], reference[i]) / model.force);
  }
  return m;
}

template <int D>
Measurement measure(const Model<D>& model, const Options& options,
                    std::span<const Observation<D>> reference) {
  const Observed<D> observed = model.scene();
  const Trajectory<D> run = simulate(observed.scene, options);
  const auto conserved = [&](std::size_t i) {
    return observed.conserved ? observed.conserved(run.sample(i)) : none;
  };
  std::vector<Observation<D>> seen;
  double drift = 0.0;
  for (std::size_t i = 0; i < run.size(); ++i) {
    seen.push_back(observed.observe(run.sample(i)));
    drift = larger(drift, std::abs(conserved(i) - conserved(0)) / model.energy);
  }
  Measurement m = compare<D>(model, seen, reference);
  m.energy_drift = drift;
  m.statistics = run.statistics();
  return m;
}

template Measurement measure(const Model<2>&, const Options&, std::span<const Observation<2>>);
template Measurement measure(const Model<3>&, const Options&, std::span<const Observation<3>>);
template Measurement compare(const Model<2>&, std::span<const Observation<2>>,
                             std::span<const Observation<2>>);
template Measurement compare(const Model<3>&, std::span<const Observation<3>>,
                             std::span<const Observation<3>>);
template double position_error(const Observation<2>&, const Observation<2>&);
template double position_error(const Observation<3>&, const Observation<3>&);

}  // namespace dalembert::models
