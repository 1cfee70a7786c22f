#pragma once

#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/results/sample.h>
#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>

#include <Eigen/Core>

#include <span>

namespace DALEMBERT_HIDDEN dalembert {

/// The variational equations of disturbances x = (M^1/2 u, M^1/2 w) along a motion, see `floquet`, at one
/// instant:
///
///   u' = w + G^T z,   w' = -K u - C w + W^T y,   G u = 0,   W w + E u = 0                            (1)
///
/// with time, and so w, in a unit that makes the terms comparable. Compliant rows have become stiffness.
struct Disturbances {
  Eigen::MatrixXd K, C, G, W, E;

  Disturbances(const System& system, const ActiveRows& rows, const FlatSample& at, double unit_of_time);
  [[nodiscard]] Eigen::Index coordinates() const { return K.rows(); }
  /// An orthonormal basis of the x that satisfy the constraints.
  [[nodiscard]] Eigen::MatrixXd basis() const;
};

/// x after a step of h, one solution per column, from (1) at the three nodes of Radau IIA.
[[nodiscard]] Eigen::MatrixXd radau_step(std::span<const Disturbances> nodes, double h,
                                         const Eigen::MatrixXd& x);

/// Its nodes, as fractions of a step.
[[nodiscard]] std::span<const double> radau_nodes();

}  // namespace dalembert
