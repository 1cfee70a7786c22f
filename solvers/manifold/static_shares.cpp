#include "dalembert/solvers/manifold/static_shares.h"

#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/linear/dense.h>
#include <dalembert/solvers/linear/cones.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Far enough from their bounds for those of least norm: by (1) what is moved ends between 1/2 and 1.
constexpr double moderate = 0.5;
/// Of the largest normal force, what light ones have at least in d: m = 0 does not depend on it.
constexpr double light = 1e-2;  // 1e-1 and 1e-3 pass the same tests
/// Forces of contacts that press each other are looked for up to this multiple of a load; those that a load
/// of 1 makes larger than its root count as wedged.
constexpr double without_end = 1e6;  // 1e4 and 1e8 pass the same tests
/// Some hundred roundings.
constexpr double rounding = 1e-13;

/// T and S of each contact along z, in the unit of the largest S.
class Shares {
 public:
  Shares(const MatrixXd& N, const std::vector<SharedContact>& contacts,
         const Eigen::Ref<const VectorXd>& lambda)
      : its_(contacts) {
    for (const SharedContact& c : its_) unit_ = std::max(unit_, c.sign * lambda[c.pressing_row]);
    if (unit_ == 0.0) return;
    Index rows = 0;
    for (const SharedContact& c : its_) rows += 1 + c.rows;
    MatrixXd all(rows, N.cols());
    Index place = 0;
    for (const SharedContact& c : its_) {
      all.row(place++) = c.sign * N.row(c.pressing_row);
      all.middleRows(place, c.rows) = N.middleRows(c.row, c.rows);
      place += c.rows;
    }
    take(N, dense::row_space(all, rank_threshold));
    for (const SharedContact& c : its_) {
      const double S = c.sign * lambda[c.pressing_row] / unit_;
      S_0_.push_back(std::abs(S) > rounding ? S : 0.0);
      T_0_.emplace_back(lambda.segment(c.row, c.rows) / unit_);
    }
  }

  [[nodiscard]] bool any() const { return unit_ > 0.0 && basis_.cols() > 0; }
  [[nodiscard]] Index unknowns() const { return basis_.cols(); }
  [[nodiscard]] VectorXd change(const VectorXd& x) const { return unit_ * (basis_ * x); }

  /// rho.
  [[nodiscard]] double largest_part(const VectorXd& x) const {
    double largest = 0.0;
    for (std::size_t i = 0; i < its_.size(); ++i) {
      const double S = S_0_[i] + S_[i].dot(x), T = (T_0_[i] + T_[i] * x).norm();
      if (its_[i].rows == 0 || T <= rounding) continue;
      largest = std::max(largest, S > 0.0 ? T / (its_[i].mu * S) : std::numeric_limits<double>::infinity());
    }
    return largest;
  }

  [[nodiscard]] bool pulls(std::size_t i, const VectorXd& x) const {
    return S_0_[i] + S_[i].dot(x) < -rank_threshold;
  }

  /// The least part of x by which friction is no more than rho times its bounds; all of it for what pulls.
  [[nodiscard]] double part_of(const VectorXd& x, double rho) const {
    double part = 0.0;
    for (std::size_t i = 0; i < its_.size(); ++i) {
      if (S_0_[i] < 0.0) return 1.0;
      const VectorXd T = T_[i] * x;
      const double b = rho * its_[i].mu, S = S_[i].dot(x);
      const double c = T_0_[i].squaredNorm() - b * b * S_0_[i] * S_0_[i];
      if (!(c > 0.0)) continue;  // of c + 2 h p + a p^2 = 0 the smallest positive p
      const double h = T_0_[i].dot(T) - b * b * S_0_[i] * S, a = T.squaredNorm() - b * b * S * S;
      part = std::max(part, c / (std::sqrt(std::max(0.0, h * h - a * c)) - h));
    }
    return std::min(part, 1.0);
  }

  /// x of (1), and m.
  [[nodiscard]] std::pair<VectorXd, double> statical() const {
    const Index n = unknowns();
    ConeProgram program{MatrixXd::Zero(n + 1, n + 1), -VectorXd::Unit(n + 1, n), {}};
    double m = 1.0;
    for (std::size_t i = 0; i < its_.size(); ++i) {
      const double mu = its_[i].rows > 0 ? its_[i].mu : 1.0, d = mu * (std::max(S_0_[i], 0.0) + light);
      add(program, i, T_0_[i], -d, mu * S_0_[i]);
      m = std::min(m, (mu * S_0_[i] - T_0_[i].norm()) / d);
    }
    program.cones.push_back({MatrixXd(0, n + 1), VectorXd(0), -VectorXd::Unit(n + 1, n), 1.0, 1.0});
    bound(program, n);
    const VectorXd x = program.minimum((m - 1.0) * VectorXd::Unit(n + 1, n));
    return {x.head(n), x[n]};
  }

  /// Whether some press each other without a load.
  [[nodiscard]] bool wedged() const {
    const Index n = unknowns();
    ConeProgram program{MatrixXd::Zero(n, n), VectorXd::Zero(n), {}};
    for (std::size_t i = 0; i < its_.size(); ++i) {
      add(program, i, VectorXd::Zero(its_[i].rows), 0.0, 1.0);
      program.c -= S_[i];
    }
    bound(program, n);
    const VectorXd x = program.minimum(VectorXd::Zero(n));
    return -program.c.dot(x) > std::sqrt(without_end);
  }

  /// Leaves what carries nothing without a force.
  void hold_idle(const MatrixXd& N) {
    Index rows = 0;
    std::vector<std::size_t> idle;
    for (std::size_t i = 0; i < its_.size(); ++i) {
      if (S_0_[i] > rank_threshold) continue;
      idle.push_back(i);
      rows += 1 + its_[i].rows;
    }
    if (idle.empty() || !wedged()) return;
    MatrixXd none(rows, unknowns());
    Index place = 0;
    for (const std::size_t i : idle) {
      none.row(place++) = S_[i];
      none.middleRows(place, its_[i].rows) = T_[i];
      place += its_[i].rows;
    }
    take(N, basis_in_z_ * dense::kernel(none, rank_threshold));
  }

 private:
  void take(const MatrixXd& N, const MatrixXd& Z) {
    basis_in_z_ = Z;
    basis_ = N * Z;
    S_.clear();
    T_.clear();
    if (!any()) return;
    for (const SharedContact& c : its_) {
      S_.emplace_back(c.sign * basis_.row(c.pressing_row));
      T_.emplace_back(basis_.middleRows(c.row, c.rows));
    }
  }
  void add(ConeProgram& program, std::size_t i, const VectorXd& a, double of_last, double h) const {
    const Index n = unknowns(), size = program.c.size();
    const double mu = its_[i].rows > 0 ? its_[i].mu : 1.0;
    MatrixXd A = MatrixXd::Zero(its_[i].rows, size);
    A.leftCols(n) = T_[i];
    VectorXd e = VectorXd::Zero(size);
    e.head(n) = mu * S_[i];
    if (size > n) e[n] = of_last;
    program.cones.push_back({A, a, e, h, 1.0});
  }
  static void bound(ConeProgram& program, Index n) {
    MatrixXd A = MatrixXd::Zero(n, program.c.size());
    A.leftCols(n).setIdentity();
    program.cones.push_back({A, VectorXd::Zero(n), VectorXd::Zero(program.c.size()), without_end, 1.0});
  }

  const std::vector<SharedContact>& its_;
  double unit_ = 0.0;
  MatrixXd basis_, basis_in_z_;
  std::vector<double> S_0_;
  std::vector<VectorXd> T_0_;
  std::vector<Eigen::RowVectorXd> S_;
  std::vector<MatrixXd> T_;
};

/// Where friction is furthest from its bounds with given signs of normal forces; rho is infinite where what
/// is one-sided among `stated` would pull.
struct Furthest {
  double rho = std::numeric_limits<double>::infinity();
  VectorXd change = {};  // of lambda
};

Furthest furthest(const MatrixXd& N, const std::vector<SharedContact>& contacts,
                  const std::vector<SharedContact>& stated, const Eigen::Ref<const VectorXd>& lambda) {
  Shares shares(N, contacts, lambda);
  if (shares.any()) shares.hold_idle(N);
  if (!shares.any()) return {};
  const auto [x, m] = shares.statical();
  const double least = shares.largest_part(x);
  const double part = m > 0.0 && least < 1.0 ? shares.part_of(x, 0.5 * (1.0 + least)) : 1.0;
  Furthest its{least, part * shares.change(x)};
  for (std::size_t i = 0; i < stated.size(); ++i)
    if (stated[i].sign != 0.0 && shares.pulls(i, x)) its.rho = std::numeric_limits<double>::infinity();
  return its;
}

}  // namespace

void share_statically(const MatrixXd& N, const std::vector<SharedContact>& contacts,
                      Eigen::Ref<VectorXd> lambda) {
  auto signs = contacts;
  std::vector<std::size_t> either;
  for (std::size_t i = 0; i < signs.size(); ++i) {
    if (signs[i].sign != 0.0) continue;
    signs[i].sign = lambda[signs[i].pressing_row] < 0.0 ? -1.0 : 1.0;
    either.push_back(i);
  }
  const Shares shares(N, signs, lambda);
  if (!shares.any() || shares.largest_part(VectorXd::Zero(shares.unknowns())) <= moderate) return;
  Furthest best = furthest(N, signs, contacts, lambda);
  for (bool better = true; std::exchange(better, false);) {
    for (const std::size_t i : either) {
      if (best.rho <= moderate) break;
      signs[i].sign = -signs[i].sign;
      if (auto other = furthest(N, signs, contacts, lambda); other.rho < best.rho) {
        best = std::move(other);
        better = true;
      } else {
        signs[i].sign = -signs[i].sign;
      }
    }
  }
  if (best.change.size() > 0) lambda += best.change;
}

}  // namespace dalembert
