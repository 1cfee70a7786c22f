#include "dalembert/solvers/manifold/friction_shares.h"

#include <dalembert/core/analysis/disjoint_sets.h>
#include <dalembert/core/analysis/islands.h>
#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/linear/dense.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/linear/cones.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Some hundred roundings.
constexpr double hundred_roundings = 1e-13;

/// z of (1), lambda in the units of the bounds.
VectorXd least_largest(const MatrixXd& A, const VectorXd& a, const std::vector<Index>& first) {
  const Index n = A.cols();
  ConeProgram program{MatrixXd::Zero(n + 1, n + 1), VectorXd::Unit(n + 1, n), {}};
  double largest = 0.0;
  for (std::size_t i = 0; i + 1 < first.size(); ++i) {
    const Index k = first[i], rows = first[i + 1] - k;
    MatrixXd own = MatrixXd::Zero(rows, n + 1);
    own.leftCols(n) = A.middleRows(k, rows);
    program.cones.push_back({own, a.segment(k, rows), VectorXd::Unit(n + 1, n), 0.0, 1.0});
    largest = std::max(largest, a.segment(k, rows).norm());
  }
  if (largest == 0.0) return VectorXd::Zero(n);
  for (auto& cone : program.cones) cone.a /= largest;
  return largest * program.minimum(2.0 * VectorXd::Unit(n + 1, n)).head(n);
}

}  // namespace

/// What presses a brake and what it holds share, too.
FrictionShares::FrictionShares(const System& system) {
  std::vector<Rough> sticking;
  for (const std::size_t number : system.conditions().frictional_constraints()) {
    const Layout::Constraint& its = system.layout()->constraints[number];
    if (!system.in_force(its.own_rows().front())) continue;
    const auto& law = *system.conditions().of[number].roughness;
    const auto& pressing = system.layout()->constraints[static_cast<std::size_t>(law.pressed_by)];
    sticking.push_back({its.first_row, its.rows, pressing.first_row, law.mu_static});
  }
  if (sticking.empty()) return;
  const Islands parts = islands(system);
  const auto part_of = [&](Index row) { return parts.of_row(system, static_cast<std::size_t>(row)); };
  DisjointSets coupled(parts.count);
  for (const Rough& r : sticking) coupled.join(part_of(r.row), part_of(r.pressing_row));
  for (std::size_t r = 0; r < system.rows(); ++r)
    part_of_row_.push_back(coupled.root(parts.of_row(system, r)));
  all_.resize(parts.count);
  for (const Rough& r : sticking) all_[part_of_row_[static_cast<std::size_t>(r.row)]].push_back(r);
}

std::vector<FrictionShares::Rough> FrictionShares::shared(const std::vector<Rough>& all,
                                                          std::span<const char> unique) {
  std::vector<Rough> chosen;
  for (const Rough& r : all) {
    const auto own = unique.subspan(static_cast<std::size_t>(r.row), static_cast<std::size_t>(r.rows));
    if (std::ranges::find(own, char{0}) != own.end()) chosen.push_back(r);
  }
  return chosen;
}

VectorXd FrictionShares::bounds(const std::vector<Rough>& of, const Forces& lambda) {
  VectorXd each(static_cast<Index>(of.size()));
  for (std::size_t i = 0; i < of.size(); ++i)
    each[static_cast<Index>(i)] = of[i].mu_static * std::abs(lambda[of[i].pressing_row]);
  return each;
}

MatrixXd FrictionShares::leave_to_others(const MatrixXd& N, std::vector<Rough>& chosen, Forces lambda) {
  const double none = rank_threshold * bounds(chosen, lambda).maxCoeff();
  const auto carries = [&](const Rough& r) { return r.mu_static * std::abs(lambda[r.pressing_row]) > none; };
  std::vector<Index> rows;
  for (const Rough& r : chosen)
    for (Index k = 0; k < r.rows && !carries(r); ++k) rows.push_back(r.row + k);
  std::erase_if(chosen, std::not_fn(carries));
  if (rows.empty()) return N;
  const MatrixXd A = N(rows, Eigen::all);
  lambda -= N * dense::least_squares(A, lambda(rows), rank_threshold);
  if (lambda(rows).norm() <= hundred_roundings * lambda.norm()) lambda(rows).setZero();
  return N * dense::kernel(A, rank_threshold);
}

/// (1).
void FrictionShares::share_friction(const MatrixXd& basis, std::vector<Rough> chosen,
                                    const std::vector<SharedContact>& pushing, Forces lambda) {
  std::vector<Index> pressing;
  for (const Rough& r : chosen) pressing.push_back(r.pressing_row);
  for (const SharedContact& c : pushing) pressing.push_back(c.pressing_row);
  const MatrixXd free = basis * dense::kernel(basis(pressing, Eigen::all), rank_threshold);
  if (free.cols() == 0) return;
  const MatrixXd N = leave_to_others(free, chosen, lambda);
  if (chosen.empty() || N.cols() == 0) return;
  std::vector<Index> first{0};
  for (const Rough& r : chosen) first.push_back(first.back() + r.rows);
  const VectorXd bound = bounds(chosen, lambda);
  MatrixXd A(first.back(), N.cols());
  VectorXd a(first.back());
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const Rough& r = chosen[i];
    A.middleRows(first[i], r.rows) = N.middleRows(r.row, r.rows) / bound[static_cast<Index>(i)];
    a.segment(first[i], r.rows) = lambda.segment(r.row, r.rows) / bound[static_cast<Index>(i)];
  }
  const MatrixXd Z = dense::row_space(A, rank_threshold);
  if (Z.cols() > 0) lambda += N * (Z * least_largest(A * Z, a, first));
}

std::vector<SharedContact> FrictionShares::contacts(const std::vector<Rough>& all,
                                                    std::span<const char> unique,
                                                    std::vector<SharedContact> pushing,
                                                    const Forces& lambda) {
  for (const Rough& r : all) {
    const auto own = unique.subspan(static_cast<std::size_t>(r.row), static_cast<std::size_t>(r.rows));
    const bool alone =
        unique[static_cast<std::size_t>(r.pressing_row)] && std::ranges::find(own, char{0}) == own.end();
    if (alone) continue;
    const auto same = std::ranges::find(pushing, r.pressing_row, &SharedContact::pressing_row);
    double sign = 0.0;
    if (same != pushing.end()) {
      sign = same->sign;
    } else if (unique[static_cast<std::size_t>(r.pressing_row)]) {
      sign = lambda[r.pressing_row] < 0.0 ? -1.0 : 1.0;
    }
    SharedContact& its =
        same == pushing.end() || same->rows > 0
            ? pushing.emplace_back(SharedContact{.pressing_row = r.pressing_row, .sign = sign})
            : *same;
    its.row = r.row;
    its.rows = r.rows;
    its.mu = r.mu_static;
  }
  return pushing;
}

void FrictionShares::spread(const MatrixXd& N, std::span<const char> unique,
                            const std::vector<SharedContact>& pushing, std::span<double> lambda) const {
  Forces all(lambda.data(), N.rows());
  for (std::size_t part = 0; part < all_.size(); ++part) {
    if (all_[part].empty()) continue;
    const auto is_elsewhere = [&](Index row) { return part_of_row_[static_cast<std::size_t>(row)] != part; };
    std::vector<Index> columns;
    for (Index k = 0; k < N.cols(); ++k) {
      Index row = 0;
      N.col(k).cwiseAbs().maxCoeff(&row);
      if (!is_elsewhere(row)) columns.push_back(k);
    }
    if (columns.empty()) continue;
    auto push = pushing;
    std::erase_if(push, [&](const SharedContact& c) { return is_elsewhere(c.pressing_row); });
    const MatrixXd own = N(Eigen::all, columns);
    if (auto chosen = shared(all_[part], unique); !chosen.empty())
      share_friction(own, std::move(chosen), push, all);
    share_statically(own, contacts(all_[part], unique, std::move(push), all), all);
  }
}

}  // namespace dalembert
