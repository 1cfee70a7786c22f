#include "dalembert/core/analysis/rank.h"

#include <dalembert/core/linear/dense.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseQR>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace dalembert {

namespace {

/// Up to this many entries a dense QR with column pivoting is affordable, and it chooses better.
constexpr Eigen::Index dense_entries = 100'000;

using Columns = Eigen::SparseMatrix<double>;

/// How many rows to choose: what a threshold finds, or a number.
struct Wanted {
  double threshold;
  std::optional<Eigen::Index> count{};
};

std::size_t number(Eigen::Index i) { return static_cast<std::size_t>(i); }

/// The columns with, for each compliant row, an entry of its own: its elongation, in units of its length.
Columns with_elongations(const System& system, const Columns& rows) {
  std::vector<Eigen::Triplet<double>> entries;
  const double half = std::sqrt(0.5);
  for (int r = 0; r < rows.cols(); ++r) {
    const bool compliant = system.in_force(number(r)) && system.law(number(r)).compliant();
    for (Columns::InnerIterator it(rows, r); it; ++it)
      entries.emplace_back(static_cast<int>(it.row()), r, (compliant ? half : 1.0) * it.value());
    if (compliant) entries.emplace_back(static_cast<int>(rows.rows()) + r, r, half);
  }
  Columns extended(rows.rows() + rows.cols(), rows.cols());
  extended.setFromTriplets(entries.begin(), entries.end());
  return extended;
}

std::vector<std::size_t> rows_in_force(const System& system) {
  std::vector<std::size_t> rows;
  for (std::size_t r = 0; r < system.rows(); ++r)
    if (system.in_force(r)) rows.push_back(r);
  return rows;
}

/// The rows' Gram matrix G = U^T U as L D L^T: the least pivot is the square of the sine of the least angle
/// that a row makes with those before it. Of few rows, as most scenes have, without memory of its own.
constexpr Eigen::Index few = 8;
double least_pivot_of_few(const Columns& rows) {
  const Eigen::Index n = rows.cols();
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, few, few> G(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) G(i, j) = rows.col(i).dot(rows.col(j));
    if (G(i, i) == 0.0) G(i, i) = 1.0;  // a row that is not in force
  }
  double least = 1.0;
  for (Eigen::Index k = 0; k < n && least > 0.0; ++k) {
    least = std::min(least, G(k, k));
    for (Eigen::Index i = k + 1; i < n; ++i)
      for (Eigen::Index j = k + 1; j <= i; ++j) G(i, j) -= G(i, k) * G(j, k) / G(k, k);
  }
  return least;
}

/// Whether no row makes a smaller angle than a thousandth with those before it, by the pivots of
/// the rows' Gram matrix, which take a time proportional to the size of a chain; QR of 10,000 rows takes
/// minutes. Where many constraints share a particle the matrix is full, and QR cheaper.
bool clearly_independent(const Columns& rows) {
  constexpr double square_of_angle = 1e-6;
  constexpr Eigen::Index most_fill = 16;
  if (rows.cols() <= few) return least_pivot_of_few(rows) > square_of_angle;
  Columns gram = (rows.transpose() * rows).pruned();
  if (gram.nonZeros() > most_fill * rows.nonZeros()) return false;
  for (Eigen::Index r = 0; r < rows.cols(); ++r)
    if (rows.col(r).squaredNorm() == 0.0) gram.insert(r, r) = 1.0;  // a row that is not in force
  const Eigen::SimplicialLDLT<Columns> ldl(gram);
  return ldl.info() == Eigen::Success && ldl.vectorD().minCoeff() > square_of_angle;
}

/// The first of an ordering, in increasing order.
std::vector<std::size_t> first_of(std::span<const int> order, Eigen::Index rank) {
  std::vector<std::size_t> rows(order.begin(), order.begin() + rank);
  std::ranges::sort(rows);
  return rows;
}

/// As many columns as are independent; of those that depend on each other the longer ones.
std::vector<std::size_t> independent_columns(const Columns& columns, const Wanted& wanted) {
  const auto dense = [&] {
    const dense::OrthogonalDecomposition qr(columns, wanted.threshold);
    return first_of(qr.order(), wanted.count.value_or(qr.rank()));
  };
  if (columns.rows() * columns.cols() <= dense_entries) return dense();
  Eigen::SparseQR<Columns, Eigen::COLAMDOrdering<int>> qr;
  qr.setPivotThreshold(wanted.threshold);
  qr.compute(columns);
  if (wanted.count && *wanted.count != qr.rank()) return dense();
  const auto& order = qr.colsPermutation().indices();
  return first_of({order.data(), number(order.size())}, qr.rank());
}

/// Of the columns, those that depend neither on others of `columns` that are not `second`, nor on each other.
std::vector<std::size_t> independent_among(Columns columns, const std::vector<char>& second, Wanted wanted) {
  constexpr double shorter = 1e-3;  // than the first: QR with column pivoting takes these before
  for (Eigen::Index r = 0; r < columns.cols(); ++r) {
    if (second[number(r)]) columns.col(r) *= shorter;
  }
  wanted.threshold *= shorter;
  auto chosen = independent_columns(columns, wanted);
  std::erase_if(chosen, [&second](std::size_t r) { return !second[r]; });
  return chosen;
}

/// Holonomic rows first: of a rod's equation and its derivative the rod is kept. Where these come so close to
/// dependent that more rows of velocities than before seem independent, `like` stays.
std::vector<std::size_t> independent(const System& system, const Columns& columns, double threshold,
                                     const ActiveRows* like) {
  const std::size_t holonomic = system.holonomic_rows();
  const auto wanted = [&](std::size_t count) {
    return Wanted{threshold,
                  like != nullptr ? std::optional(static_cast<Eigen::Index>(count)) : std::nullopt};
  };
  if (holonomic == 0 || holonomic == system.rows())
    return independent_columns(columns, wanted(like != nullptr ? like->size() : 0));
  auto chosen = independent_columns(columns.leftCols(static_cast<Eigen::Index>(holonomic)),
                                    wanted(like != nullptr ? like->holonomic : 0));
  std::vector<char> velocity_level(system.rows(), 0);
  std::ranges::fill(std::span(velocity_level).subspan(holonomic), 1);
  for (const std::size_t r :
       independent_among(columns, velocity_level, wanted(like != nullptr ? like->size() : 0)))
    chosen.push_back(r);
  return like != nullptr && chosen.size() != like->size() ? like->rows : chosen;
}

/// Compliant rows among `active` that depend on others, rigid ones first of all.
std::vector<std::size_t> parallel_rows(const System& system, const Columns& columns,
                                       std::span<const std::size_t> active, double threshold) {
  if (!system.compliant() || clearly_independent(columns)) return {};
  std::vector<char> is_compliant;
  for (std::size_t r = 0; r < system.rows(); ++r) is_compliant.push_back(system.law(r).compliant());
  const auto carrying = independent_among(columns, is_compliant, {threshold});
  std::vector<std::size_t> parallel;
  for (std::size_t k = 0; k < active.size(); ++k) {
    const bool carries = std::ranges::binary_search(carrying, active[k]);
    if (is_compliant[active[k]] && !carries) parallel.push_back(k);
  }
  return parallel;
}

ActiveRows choose(const System& system, std::span<const double> w, double threshold, const ActiveRows* like) {
  if (system.rows() == 0) return {};
  const Columns columns = rows_in_mass_metric(system, w);
  const Columns extended = system.compliant() ? with_elongations(system, columns) : columns;
  const bool all = like != nullptr ? like->size() == system.rows_in_force() : clearly_independent(extended);
  auto rows = all ? rows_in_force(system) : independent(system, extended, threshold, like);
  const auto holonomic =
      std::ranges::count_if(rows, [&](std::size_t r) { return r < system.holonomic_rows(); });
  auto parallel = parallel_rows(system, columns, rows, threshold);
  return {std::move(rows), number(holonomic), std::move(parallel)};
}

}  // namespace

Eigen::SparseMatrix<double> rows_in_mass_metric(const System& system, std::span<const double> w) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t r = 0; r < system.rows(); ++r) {
    for (const std::size_t k : system.row(r)) {
      const std::size_t i = system.w_columns()[k];
      entries.emplace_back(static_cast<int>(i), static_cast<int>(r), w[k] / std::sqrt(system.masses()[i]));
    }
  }
  Columns rows(static_cast<Eigen::Index>(system.coordinates()), static_cast<Eigen::Index>(system.rows()));
  rows.setFromTriplets(entries.begin(), entries.end());
  for (Eigen::Index r = 0; r < rows.cols(); ++r) {
    const double length = rows.col(r).norm();
    if (length > 0.0) rows.col(r) /= length;
  }
  return rows;
}

ActiveRows independent_rows(const System& system, std::span<const double> w, double threshold) {
  return choose(system, w, threshold, nullptr);
}

ActiveRows independent_rows(const System& system, std::span<const double> w, const ActiveRows& like) {
  return choose(system, w, rank_threshold, &like);
}

Eigen::MatrixXd orthogonal_complement(const Eigen::MatrixXd& columns, double threshold) {
  const Eigen::Index n = columns.rows();
  if (columns.cols() == 0) return Eigen::MatrixXd::Identity(n, n);
  const dense::OrthogonalDecomposition qr(columns, threshold);
  return qr.Q().rightCols(n - qr.rank());
}

}  // namespace dalembert
