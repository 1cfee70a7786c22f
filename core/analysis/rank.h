#pragma once

#include <dalembert/core/scene/system.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <span>
#include <vector>

namespace dalembert {

/// The constraint rows a solver works with: all of them, unless some are linearly dependent. Holonomic rows
/// come first.
struct ActiveRows {
  std::vector<std::size_t> rows;
  std::size_t holonomic = 0;
  /// Places in `rows` of compliant rows whose gradients depend linearly on others: parallel springs. The
  /// others serve to project positions and velocities; g + C lambda = 0 gives these their forces.
  std::vector<std::size_t> parallel{};

  [[nodiscard]] std::size_t size() const { return rows.size(); }
};

/// The threshold at a state that satisfies its constraints to round-off: far above round-off, far below what
/// a merely skew pair of constraints shows.
inline constexpr double rank_threshold = 1e-9;

/// The rows of W M^-1/2, each of unit length, as columns: the one scaling in which rows of W are compared. It
/// does not depend on how the user scales an equation, nor on the units of coordinates.
[[nodiscard]] Eigen::SparseMatrix<double> rows_in_mass_metric(const System& system,
                                                              std::span<const double> w);

/// A well-conditioned set of rows on which all others depend linearly, by rank-revealing QR of
/// `rows_in_mass_metric`. `threshold` is the distance below which a row counts as in the span of others. A
/// compliant row has its elongation besides: it depends on no other.
///
/// Everything that needs the rank of the constraints uses this: the start, description, virtual work,
/// projection and both steppers.
[[nodiscard]] ActiveRows independent_rows(const System& system, std::span<const double> w,
                                          double threshold = rank_threshold);

/// As many rows as in `like`, as far from each other's span as QR can find them: for a state during a run,
/// where those chosen before have come close to dependent. (How many are independent is decided at the start;
/// where the rank falls for an instant none may be left out for good.)
[[nodiscard]] ActiveRows independent_rows(const System& system, std::span<const double> w,
                                          const ActiveRows& like);

/// The threshold for columns that are known to be independent, of whatever lengths and angles.
inline constexpr double of_full_rank = 0.0;

/// Orthonormal columns that span the orthogonal complement of the given ones, by the same QR: what rows of
/// unit length leave free.
[[nodiscard]] Eigen::MatrixXd orthogonal_complement(const Eigen::MatrixXd& columns,
                                                    double threshold = rank_threshold);

}  // namespace dalembert
