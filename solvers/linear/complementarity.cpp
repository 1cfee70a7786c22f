#include "dalembert/solvers/linear/complementarity.h"

#include <dalembert/solvers/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Entries of a column below this fraction of its largest, a rounding error for each pivot so far, are 0.
constexpr double rounding_of_pivots = 1e3 * epsilon;

/// The equations w - M z - 1 z0 = q solved for the basic variables: each row is (w-part | z-part | z0 | q).
/// Variables are numbered in that order, w_i is i, z_i is n + i, z0 is 2 n.
class Tableau {
 public:
  Tableau(const MatrixXd& M, const VectorXd& q) : n_(q.size()), rows_(n_, 2 * n_ + 2) {
    rows_ << MatrixXd::Identity(n_, n_), -M, VectorXd::Constant(n_, -1.0), q;
    for (Index i = 0; i < n_; ++i) basis_.push_back(i);
  }

  [[nodiscard]] Index z0() const { return 2 * n_; }
  [[nodiscard]] Index complement(Index variable) const {
    return variable < n_ ? variable + n_ : variable - n_;
  }

  /// The ratio test: the row whose basic variable is the first to vanish as another grows from 0; none if
  /// that is unbounded. Ties go to z0, else to the lexicographically least row.
  [[nodiscard]] std::optional<Index> blocking_row(Index entering) const {
    const double least = rounding_of_pivots * rows_.col(entering).cwiseAbs().maxCoeff();
    std::optional<Index> best;
    for (Index i = 0; i < n_; ++i) {
      if (rows_(i, entering) <= least) continue;
      if (!best || before(i, *best, entering)) best = i;
    }
    return best;
  }
  /// The row at which z0 enters: that of the least q, and of ties the last, which comes first in the
  /// lexicographic order.
  [[nodiscard]] Index most_negative() const {
    const auto q = rows_.col(2 * n_ + 1);
    const double least = q.minCoeff() * (1.0 - rounding_of_pivots);
    Index row = n_ - 1;
    while (q[row] > least) --row;
    return row;
  }

  /// A pivot: puts a variable into the basis; returns the one that leaves.
  Index exchange(Index row, Index entering) {
    rows_.row(row) /= rows_(row, entering);
    for (Index i = 0; i < n_; ++i) {
      if (i == row) continue;
      rows_.row(i) -= rows_(i, entering) * rows_.row(row);
      rows_(i, entering) = 0.0;
    }
    return std::exchange(basis_[static_cast<std::size_t>(row)], entering);
  }

  /// The greatest q was 1.
  [[nodiscard]] double value_of_z0() const {
    const auto row = std::ranges::find(basis_, z0()) - basis_.begin();
    return rows_(row, 2 * n_ + 1);
  }
  [[nodiscard]] VectorXd z() const {
    VectorXd z = VectorXd::Zero(n_);
    for (Index i = 0; i < n_; ++i) {
      const Index variable = basis_[static_cast<std::size_t>(i)];
      if (variable >= n_ && variable < z0()) z[variable - n_] = std::max(rows_(i, 2 * n_ + 1), 0.0);
    }
    return z;
  }

 private:
  /// Whether row i vanishes before row k, by (q, w-part) over the entries of the entering column.
  [[nodiscard]] bool before(Index i, Index k, Index entering) const {
    const double a = rows_(i, entering), b = rows_(k, entering);
    const auto ratio = [&](Index column) {
      const double x = rows_(i, column) / a, y = rows_(k, column) / b;
      return std::abs(x - y) <= rounding_of_pivots * std::max({std::abs(x), std::abs(y), 1.0}) ? 0.0 : x - y;
    };
    if (const double d = ratio(2 * n_ + 1); d != 0.0) return d < 0.0;
    if (basis_[static_cast<std::size_t>(i)] == z0()) return true;
    if (basis_[static_cast<std::size_t>(k)] == z0()) return false;
    for (Index column = 0; column < n_; ++column)
      if (const double d = ratio(column); d != 0.0) return d < 0.0;
    return false;
  }

  Index n_;
  MatrixXd rows_;
  std::vector<Index> basis_;
};

}  // namespace

std::optional<VectorXd> complementary_solution(const MatrixXd& M, const VectorXd& q) {
  const Index n = q.size();
  if (n == 0 || q.minCoeff() >= 0.0) return VectorXd::Zero(n);
  VectorXd unit(n);  // of z; that of w is its inverse
  for (Index i = 0; i < n; ++i) unit[i] = M(i, i) > 0.0 ? 1.0 / std::sqrt(M(i, i)) : 1.0;
  const VectorXd scaled = unit.cwiseProduct(q);
  const double largest = scaled.cwiseAbs().maxCoeff();
  Tableau tableau(unit.asDiagonal() * M * unit.asDiagonal(), scaled / largest);
  Index leaving = tableau.exchange(tableau.most_negative(), tableau.z0());
  while (leaving != tableau.z0()) {
    const Index entering = tableau.complement(leaving);
    const auto row = tableau.blocking_row(entering);
    if (!row && tableau.value_of_z0() <= rounding_of_pivots) break;  // solved but for round-off
    if (!row) return std::nullopt;
    leaving = tableau.exchange(*row, entering);
  }
  return VectorXd(largest * unit.cwiseProduct(tableau.z()));
}

}  // namespace dalembert
