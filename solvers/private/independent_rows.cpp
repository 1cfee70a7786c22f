#include "dalembert/solvers/private/independent_rows.h"

#include <dalembert/solvers/private/saddle.h>

#include <Eigen/QR>
#include <Eigen/SparseCore>
#include <Eigen/SparseQR>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dalembert {

namespace {

/// Up to this many entries a dense QR with column pivoting is affordable, and it chooses better.
constexpr std::size_t dense_entries = 100'000;

using SparseColumns = Eigen::SparseMatrix<double, Eigen::ColMajor>;

/// The rows of W M^(-1/2), each of unit length, as columns. A compliant row has, if asked for, an entry of
/// its own besides, for its elongation: with it, it depends on no other.
SparseColumns scaled_rows(const System& system, std::span<const double> w, bool elongations) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int r = 0; r < system.rows(); ++r) {
    const auto first = static_cast<std::size_t>(system.row_start()[static_cast<std::size_t>(r)]);
    const auto last = static_cast<std::size_t>(system.row_start()[static_cast<std::size_t>(r) + 1]);
    for (std::size_t k = first; k < last; ++k) {
      const int i = system.w_columns()[k];
      entries.emplace_back(i, r, w[k] / std::sqrt(system.masses()[static_cast<std::size_t>(i)]));
    }
    if (elongations && system.compliance()[static_cast<std::size_t>(r)] > 0.0)
      entries.emplace_back(system.coordinates() + r, r,
                           std::sqrt(mobility(system, w, static_cast<std::size_t>(r))));
  }
  SparseColumns rows(system.coordinates() + (elongations ? system.rows() : 0), system.rows());
  rows.setFromTriplets(entries.begin(), entries.end());
  for (int r = 0; r < system.rows(); ++r) rows.col(r) /= rows.col(r).norm();
  return rows;
}

std::vector<int> all_rows(const System& system) {
  std::vector<int> all(static_cast<std::size_t>(system.rows()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// Whether no row makes a smaller angle than a thousandth with those before it, by the pivots of
/// W M^-1 W^T, which take a time proportional to the size of a chain; QR of 10,000 rows takes minutes.
bool clearly_independent(const System& system, std::span<const double> w, bool elongations) {
  constexpr double square_of_angle = 1e-6;
  const ActiveRows all{all_rows(system), system.holonomic_rows()};
  if (!SaddleMatrix::complement_suits(system, all)) return false;
  std::vector<double> s(static_cast<std::size_t>(system.rows()), 0.0);
  for (std::size_t r = 0; elongations && r < s.size(); ++r) {
    if (system.compliance()[r] > 0.0) s[r] = mobility(system, w, r);
  }
  SchurComplement complement(system, all.rows);
  return complement.factorise(w, s) && complement.smallest_pivot() > square_of_angle;
}

/// The first of an ordering, in increasing order.
template <class Permutation>
std::vector<int> first_of(const Permutation& permutation, Eigen::Index rank) {
  std::vector<int> rows(permutation.indices().data(), permutation.indices().data() + rank);
  std::ranges::sort(rows);
  return rows;
}

/// As many columns as are independent; of those that depend on each other the longer ones.
std::vector<int> independent_columns(const SparseColumns& columns, double threshold) {
  if (static_cast<std::size_t>(columns.rows()) * static_cast<std::size_t>(columns.cols()) <= dense_entries) {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns.rows(), columns.cols());
    qr.setThreshold(threshold);
    qr.compute(Eigen::MatrixXd(columns));
    return first_of(qr.colsPermutation(), qr.rank());
  }
  Eigen::SparseQR<SparseColumns, Eigen::COLAMDOrdering<int>> qr;
  qr.setPivotThreshold(threshold);
  qr.compute(columns);
  return first_of(qr.colsPermutation(), qr.rank());
}

/// Of the columns, those that depend neither on others of `columns` that are not `second`, nor on each other.
std::vector<int> independent_among(SparseColumns columns, const std::vector<char>& second, double threshold) {
  constexpr double shorter = 1e-3;  // than the first: QR with column pivoting takes these before
  const auto is_second = [&second](int r) { return second[static_cast<std::size_t>(r)] != 0; };
  for (int r = 0; r < columns.cols(); ++r) {
    if (is_second(r)) columns.col(r) *= shorter;
  }
  auto chosen = independent_columns(columns, shorter * threshold);
  std::erase_if(chosen, [&](int r) { return !is_second(r); });
  return chosen;
}

/// Holonomic rows first: of a rod's equation and its derivative the rod is kept.
std::vector<int> independent(const System& system, const SparseColumns& columns, double threshold) {
  const int holonomic = system.holonomic_rows();
  if (holonomic == 0 || holonomic == system.rows()) return independent_columns(columns, threshold);
  auto chosen = independent_columns(columns.leftCols(holonomic), threshold);
  std::vector<char> velocity_level(static_cast<std::size_t>(system.rows()), 0);
  std::fill(velocity_level.begin() + holonomic, velocity_level.end(), 1);
  for (const int r : independent_among(columns, velocity_level, threshold)) chosen.push_back(r);
  return chosen;
}

/// Compliant rows among `active` that depend on others, rigid ones first of all.
std::vector<std::size_t> slack_rows(const System& system, std::span<const double> w,
                                    std::span<const int> active, double threshold) {
  if (!system.compliant() || clearly_independent(system, w, false)) return {};
  std::vector<char> is_compliant;
  for (const double C : system.compliance()) is_compliant.push_back(C > 0.0);
  const auto carrying = independent_among(scaled_rows(system, w, false), is_compliant, threshold);
  std::vector<std::size_t> slack;
  for (std::size_t k = 0; k < active.size(); ++k) {
    const bool carries = std::ranges::binary_search(carrying, active[k]);
    if (is_compliant[static_cast<std::size_t>(active[k])] && !carries) slack.push_back(k);
  }
  return slack;
}

}  // namespace

ActiveRows independent_rows(const System& system, std::span<const double> w, double threshold) {
  if (system.rows() == 0) return {};
  auto rows = clearly_independent(system, w, true)
                  ? all_rows(system)
                  : independent(system, scaled_rows(system, w, system.compliant()), threshold);
  const auto holonomic = std::ranges::count_if(rows, [&](int r) { return r < system.holonomic_rows(); });
  auto slack = slack_rows(system, w, rows, threshold);
  return {std::move(rows), static_cast<int>(holonomic), std::move(slack)};
}

}  // namespace dalembert
