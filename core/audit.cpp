#include "dalembert/core/audit.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace dalembert {

namespace {

/// Orthonormal columns: the displacements that all rows of W allow.
Eigen::MatrixXd tangent_space(const System& system, std::span<const double> w) {
  Eigen::MatrixXd gradients = Eigen::MatrixXd::Zero(system.coordinates(), system.rows());
  for (int r = 0; r < system.rows(); ++r) {
    const auto row = static_cast<std::size_t>(r);
    for (int k = system.row_start()[row]; k < system.row_start()[row + 1]; ++k) {
      gradients(system.w_columns()[static_cast<std::size_t>(k)], r) += w[static_cast<std::size_t>(k)];
    }
    gradients.col(r).normalize();
  }
  if (system.rows() == 0) return Eigen::MatrixXd::Identity(system.coordinates(), system.coordinates());
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(gradients);
  qr.setThreshold(1e-9);
  const Eigen::MatrixXd Q = qr.householderQ();
  return Q.rightCols(Q.cols() - qr.rank());
}

}  // namespace

Audit audit(const System& system, const FlatSample& sample) {
  const Instant at{sample.time, sample.q, sample.v};
  const Layout& layout = *system.layout();
  auto e = system.evaluation();
  system.evaluate(at, e);
  Audit result;

  Eigen::VectorXd Z = Eigen::VectorXd::Zero(system.coordinates());
  for (const auto& constraint : layout.constraints) {
    double power = 0.0;
    for (int s = constraint.first_slot; s < constraint.first_slot + constraint.width; ++s) {
      const auto slot = static_cast<std::size_t>(s);
      const int i = layout.slot_coordinate[slot];
      Z[i] += sample.forces[slot];
      power += sample.forces[slot] * sample.v[static_cast<std::size_t>(i)];
      result.largest_force = std::max(result.largest_force, std::abs(sample.forces[slot]));
    }
    result.constraints.push_back({constraint.label(), power});
  }
  const Eigen::VectorXd work = tangent_space(system, e.w).transpose() * Z;
  if (work.size() > 0) result.virtual_work = work.cwiseAbs().maxCoeff();

  result.forces.push_back({"constant forces", system.constant_power(sample.v)});
  system.for_each_force_power(at, sample.lambda, [&result](std::string name, double power) {
    result.forces.push_back({std::move(name), power});
  });
  return result;
}

}  // namespace dalembert
