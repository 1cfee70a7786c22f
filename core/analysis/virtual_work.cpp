#include "dalembert/core/analysis/virtual_work.h"

#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/errors.h>

#include <algorithm>
#include <cmath>

namespace dalembert {

namespace {

/// Unit columns: a basis of the displacements that all rows of W allow, orthogonal in the mass metric.
Eigen::MatrixXd tangent_space(const System& system, std::span<const double> w) {
  Eigen::MatrixXd tangent = orthogonal_complement(rows_in_mass_metric(system, w));
  for (Eigen::Index i = 0; i < tangent.rows(); ++i)
    tangent.row(i) /= std::sqrt(system.masses()[static_cast<std::size_t>(i)]);
  return tangent.colwise().normalized();
}

}  // namespace

VirtualWork virtual_work(const System& system, const FlatSample& sample) {
  const Instant at{sample.time, sample.q, sample.v};
  const Layout& layout = *system.layout();
  auto e = system.evaluation();
  system.evaluate(at, e);
  for (const auto& constraint : layout.constraints) {
    const auto own = constraint.slots().in(sample.forces);
    if (std::ranges::any_of(own, [](double Z) { return std::isnan(Z); }))
      throw UndeterminedForce("No virtual work at this instant: the force of " + constraint.label() +
                              " is not determined; choose another time");
  }
  VirtualWork result;

  Eigen::VectorXd Z = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(system.coordinates()));
  for (const auto& constraint : layout.constraints) {
    double power = 0.0;
    for (const std::size_t slot : constraint.slots()) {
      const int i = layout.slot_coordinate[slot];
      Z[i] += sample.forces[slot];
      power += sample.forces[slot] * sample.v[static_cast<std::size_t>(i)];
      result.largest_force = std::max(result.largest_force, std::abs(sample.forces[slot]));
    }
    result.constraints.push_back({constraint.label(), power});
  }
  const Eigen::VectorXd work = tangent_space(system, e.w).transpose() * Z;
  if (work.size() > 0) result.largest = work.cwiseAbs().maxCoeff();

  result.forces.push_back({"constant forces", system.forces().constant_power(sample.v)});
  system.forces().for_each_power(at, sample.lambda, [&result](std::string name, double power) {
    result.forces.push_back({std::move(name), power});
  });
  return result;
}

}  // namespace dalembert
