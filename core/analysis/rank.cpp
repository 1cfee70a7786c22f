#include "dalembert/core/analysis/rank.h"

#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseQR>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace dalembert {

namespace {

/// Up to this many entries a dense QR with column pivoting is affordable, and it chooses better.
constexpr std::size_t dense_entries = 100'000;

using Columns = Eigen::SparseMatrix<double>;

/// How many rows to choose: what a threshold finds, or a number.
struct Wanted {
  double threshold;
  std::optional<Eigen::Index> count{};
};

/// The columns with, for each compliant row, an entry of its own: its elongation, in units of its length.
Columns with_elongations(const System& system, const Columns& rows) {
  std::vector<Eigen::Triplet<double>> entries;
  const double half = std::sqrt(0.5);
  for (int r = 0; r < rows.cols(); ++r) {
    const bool yields = system.compliance()[static_cast<std::size_t>(r)] > 0.0;
    for (Columns::InnerIterator it(rows, r); it; ++it)
      entries.emplace_back(static_cast<int>(it.row()), r, (yields ? half : 1.0) * it.value());
    if (yields) entries.emplace_back(static_cast<int>(rows.rows()) + r, r, half);
  }
  Columns extended(rows.rows() + rows.cols(), rows.cols());
  extended.setFromTriplets(entries.begin(), entries.end());
  return extended;
}

std::vector<int> all_rows(const System& system) {
  std::vector<int> all(static_cast<std::size_t>(system.rows()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// Whether no row makes a smaller angle than a thousandth with those before it, by the pivots of
/// the rows' Gram matrix, which take a time proportional to the size of a chain; QR of 10,000 rows takes
/// minutes. Where many constraints share a particle the matrix is full, and QR cheaper.
bool clearly_independent(const Columns& rows) {
  constexpr double square_of_angle = 1e-6;
  constexpr Eigen::Index most_fill = 16;
  const Columns gram = (rows.transpose() * rows).pruned();
  if (gram.nonZeros() > most_fill * rows.nonZeros()) return false;
  const Eigen::SimplicialLDLT<Columns> ldl(gram);
  return ldl.info() == Eigen::Success && ldl.vectorD().minCoeff() > square_of_angle;
}

/// The first of an ordering, in increasing order.
template <class Permutation>
std::vector<int> first_of(const Permutation& permutation, Eigen::Index rank) {
  std::vector<int> rows(permutation.indices().data(), permutation.indices().data() + rank);
  std::ranges::sort(rows);
  return rows;
}

/// As many columns as are independent; of those that depend on each other the longer ones.
std::vector<int> independent_columns(const Columns& columns, const Wanted& wanted) {
  const auto dense = [&] {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns.rows(), columns.cols());
    qr.setThreshold(wanted.threshold);
    qr.compute(Eigen::MatrixXd(columns));
    return first_of(qr.colsPermutation(), wanted.count.value_or(qr.rank()));
  };
  if (static_cast<std::size_t>(columns.rows()) * static_cast<std::size_t>(columns.cols()) <= dense_entries)
    return dense();
  Eigen::SparseQR<Columns, Eigen::COLAMDOrdering<int>> qr;
  qr.setPivotThreshold(wanted.threshold);
  qr.compute(columns);
  if (wanted.count && *wanted.count != qr.rank()) return dense();
  return first_of(qr.colsPermutation(), qr.rank());
}

/// Of the columns, those that depend neither on others of `columns` that are not `second`, nor on each other.
std::vector<int> independent_among(Columns columns, const std::vector<char>& second, Wanted wanted) {
  constexpr double shorter = 1e-3;  // than the first: QR with column pivoting takes these before
  const auto is_second = [&second](int r) { return second[static_cast<std::size_t>(r)] != 0; };
  for (int r = 0; r < columns.cols(); ++r) {
    if (is_second(r)) columns.col(r) *= shorter;
  }
  wanted.threshold *= shorter;
  auto chosen = independent_columns(columns, wanted);
  std::erase_if(chosen, [&](int r) { return !is_second(r); });
  return chosen;
}

/// Holonomic rows first: of a rod's equation and its derivative the rod is kept.
std::vector<int> independent(const System& system, const Columns& columns, double threshold,
                             const ActiveRows* like) {
  const int holonomic = system.holonomic_rows();
  const auto wanted = [&](int count) {
    return Wanted{threshold, like != nullptr ? std::optional<Eigen::Index>(count) : std::nullopt};
  };
  if (holonomic == 0 || holonomic == system.rows())
    return independent_columns(columns, wanted(like != nullptr ? like->size() : 0));
  auto chosen =
      independent_columns(columns.leftCols(holonomic), wanted(like != nullptr ? like->holonomic : 0));
  std::vector<char> velocity_level(static_cast<std::size_t>(system.rows()), 0);
  std::fill(velocity_level.begin() + holonomic, velocity_level.end(), 1);
  for (const int r : independent_among(columns, velocity_level, wanted(like != nullptr ? like->size() : 0)))
    chosen.push_back(r);
  return chosen;
}

/// Compliant rows among `active` that depend on others, rigid ones first of all.
std::vector<std::size_t> slack_rows(const System& system, const Columns& columns, std::span<const int> active,
                                    double threshold) {
  if (!system.compliant() || clearly_independent(columns)) return {};
  std::vector<char> is_compliant;
  for (const double C : system.compliance()) is_compliant.push_back(C > 0.0);
  const auto carrying = independent_among(columns, is_compliant, {threshold});
  std::vector<std::size_t> slack;
  for (std::size_t k = 0; k < active.size(); ++k) {
    const bool carries = std::ranges::binary_search(carrying, active[k]);
    if (is_compliant[static_cast<std::size_t>(active[k])] && !carries) slack.push_back(k);
  }
  return slack;
}

ActiveRows choose(const System& system, std::span<const double> w, double threshold, const ActiveRows* like) {
  if (system.rows() == 0) return {};
  const Columns columns = rows_in_mass_metric(system, w);
  const Columns extended = system.compliant() ? with_elongations(system, columns) : columns;
  const bool all = like != nullptr ? like->size() == system.rows() : clearly_independent(extended);
  auto rows = all ? all_rows(system) : independent(system, extended, threshold, like);
  const auto holonomic = std::ranges::count_if(rows, [&](int r) { return r < system.holonomic_rows(); });
  auto slack = slack_rows(system, columns, rows, threshold);
  return {std::move(rows), static_cast<int>(holonomic), std::move(slack)};
}

}  // namespace

Eigen::SparseMatrix<double> rows_in_mass_metric(const System& system, std::span<const double> w) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int r = 0; r < system.rows(); ++r) {
    const auto first = static_cast<std::size_t>(system.row_start()[static_cast<std::size_t>(r)]);
    const auto last = static_cast<std::size_t>(system.row_start()[static_cast<std::size_t>(r) + 1]);
    for (std::size_t k = first; k < last; ++k) {
      const int i = system.w_columns()[k];
      entries.emplace_back(i, r, w[k] / std::sqrt(system.masses()[static_cast<std::size_t>(i)]));
    }
  }
  Columns rows(system.coordinates(), system.rows());
  rows.setFromTriplets(entries.begin(), entries.end());
  for (int r = 0; r < system.rows(); ++r) {
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

}  // namespace dalembert
