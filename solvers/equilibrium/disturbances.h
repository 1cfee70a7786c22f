#pragma once

#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/results/sample.h>
#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>

#include <Eigen/Core>

#include <array>
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
};

/// (1) without its multipliers: x = B c with an orthonormal basis B of what the constraints allow, and
/// N^T x' = N^T A x with one, N, of what multipliers do not act on. As many numbers c as the scene has free
/// directions and velocities, whatever the number of its coordinates.
struct FreeDisturbances {
  Eigen::MatrixXd basis, across;  ///< B, N
  Eigen::MatrixXd rate;           ///< N^T A B

  explicit FreeDisturbances(const Disturbances& all);
};

/// Radau IIA of five stages, order 9: the collocation at `radau_nodes`, fractions of a step of which the last
/// is 1. Stiffly accurate, and what decays fast decays in a step of any length (Hairer, Wanner, Solving ODEs
/// II, IV.5 and VII.4).
inline constexpr std::array<double, 5> radau_nodes{0.057104196114517682, 0.27684301363812383,
                                                   0.58359043236891682, 0.86024013565621945, 1.0};
inline constexpr double radau_order = 9.0;

/// c at the end of a step of h for c at its start, from (1) there and at the nodes.
[[nodiscard]] Eigen::MatrixXd radau_step(const FreeDisturbances& start,
                                         std::span<const FreeDisturbances> nodes, double h);

}  // namespace dalembert
