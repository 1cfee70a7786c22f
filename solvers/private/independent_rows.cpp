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

/// The rows of W M^(-1/2), each of unit length, as columns. A compliant row has an entry of its own
/// besides, for its elongation: it depends on no other.
SparseColumns scaled_rows(const System& system, std::span<const double> w) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int r = 0; r < system.rows(); ++r) {
    const auto first = static_cast<std::size_t>(system.row_start()[static_cast<std::size_t>(r)]);
    const auto last = static_cast<std::size_t>(system.row_start()[static_cast<std::size_t>(r) + 1]);
    double square = 0.0;
    for (std::size_t k = first; k < last; ++k) {
      const int i = system.w_columns()[k];
      entries.emplace_back(i, r, w[k] / std::sqrt(system.masses()[static_cast<std::size_t>(i)]));
      square += entries.back().value() * entries.back().value();
    }
    if (system.compliance()[static_cast<std::size_t>(r)] > 0.0)
      entries.emplace_back(system.coordinates() + r, r, std::sqrt(square));
  }
  SparseColumns rows(system.coordinates() + (system.compliant() ? system.rows() : 0), system.rows());
  rows.setFromTriplets(entries.begin(), entries.end());
  for (int r = 0; r < system.rows(); ++r) rows.col(r) /= rows.col(r).norm();
  return rows;
}

ActiveRows all_rows(const System& system) {
  ActiveRows all{std::vector<int>(static_cast<std::size_t>(system.rows())), system.holonomic_rows()};
  std::iota(all.rows.begin(), all.rows.end(), 0);
  return all;
}

/// Whether no row makes a smaller angle than a thousandth with those before it, by the pivots of
/// W M^-1 W^T, which take a time proportional to the size of a chain; QR of 10,000 rows takes minutes.
bool clearly_independent(const System& system, std::span<const double> w) {
  constexpr double square_of_angle = 1e-6;
  const auto all = all_rows(system);
  if (!SaddleMatrix::complement_suits(system, all)) return false;
  std::vector<double> compliant(system.compliance().begin(), system.compliance().end());
  for (std::size_t r = 0; r < compliant.size(); ++r) {
    if (compliant[r] > 0.0) compliant[r] = mobility(system, w, r);
  }
  SchurComplement complement(system, all.rows);
  return complement.factorise(w, compliant) && complement.smallest_pivot() > square_of_angle;
}

template <class Permutation>
ActiveRows first_of(const Permutation& permutation, Eigen::Index rank, const System& system) {
  ActiveRows active;
  for (Eigen::Index k = 0; k < rank; ++k) active.rows.push_back(static_cast<int>(permutation.indices()[k]));
  std::ranges::sort(active.rows);
  active.holonomic = static_cast<int>(
      std::ranges::count_if(active.rows, [&](int r) { return r < system.holonomic_rows(); }));
  return active;
}

}  // namespace

ActiveRows independent_rows(const System& system, std::span<const double> w, double threshold) {
  if (system.rows() == 0) return {};
  if (clearly_independent(system, w)) return all_rows(system);
  const SparseColumns rows = scaled_rows(system, w);
  if (static_cast<std::size_t>(rows.rows()) * static_cast<std::size_t>(rows.cols()) <= dense_entries) {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows.rows(), rows.cols());
    qr.setThreshold(threshold);
    qr.compute(Eigen::MatrixXd(rows));
    return first_of(qr.colsPermutation(), qr.rank(), system);
  }
  Eigen::SparseQR<SparseColumns, Eigen::COLAMDOrdering<int>> qr;
  qr.setPivotThreshold(threshold);
  qr.compute(rows);
  return first_of(qr.colsPermutation(), qr.rank(), system);
}

}  // namespace dalembert
