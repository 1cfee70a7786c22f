#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/linear_terms.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A sum of products counts as 0 below this many roundings of the largest of them.
inline constexpr double roundings_of_a_sum = 1e3;

/// Linear terms of some coordinates and rows as dense matrices in x = M^1/2 u:
///
///   K, C <- M^-1/2 (K, C) M^-1/2,    W <- W M^-1/2,  E <- E M^-1/2,  both over the length of W's row  (1)
///
/// Compliant rows have become stiffness, w w^T / c. Of the others the holonomic ones come first.
struct MassMetric {
  Eigen::VectorXd root;  ///< M^-1/2
  Eigen::MatrixXd K, C, W, E;
  Eigen::MatrixXd
      K_terms;  ///< what K sums, without signs: weight or load may balance centrifugal forces in it
  Eigen::Index holonomic = 0;

  MassMetric(const System& system, const LinearTerms& terms, std::span<const std::size_t> coordinates,
             std::span<const std::size_t> rows);
};

/// K - K^T, the circulatory forces, without round-off: entry by entry, so that the stiffest spring of a scene
/// does not hide an asymmetry elsewhere. Entries are known to round-off of themselves and of the stiffness of
/// their two coordinates, off which they may have cancelled.
[[nodiscard]] Eigen::SparseMatrix<double> circulatory(const LinearTerms& terms, std::size_t coordinates);

}  // namespace dalembert
