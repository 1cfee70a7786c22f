#include "dalembert/solvers/manifold/minimum_norm.h"

#include <dalembert/solvers/base/irregular.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/linear/complementarity.h>
#include <dalembert/solvers/linear/rows.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

namespace {

/// The worst change of the positions is some times worse than the one that is tried.
constexpr double margin = 10.0;

std::vector<Eigen::Index> others(const System& system, const ActiveRows& active) {
  std::vector<Eigen::Index> dropped;
  for (std::size_t r = 0; r < system.rows(); ++r) {
    if (system.in_force(r) && !std::ranges::binary_search(active.rows, r))
      dropped.push_back(static_cast<Eigen::Index>(r));
  }
  return dropped;
}

/// The groups of a symmetric matrix that have nothing to do with each other.
std::vector<std::vector<Eigen::Index>> connected(const Eigen::MatrixXd& M) {
  std::vector<std::vector<Eigen::Index>> groups;
  std::vector<char> met(static_cast<std::size_t>(M.rows()), 0);
  for (Eigen::Index first = 0; first < M.rows(); ++first) {
    if (std::exchange(met[static_cast<std::size_t>(first)], 1)) continue;
    auto& group = groups.emplace_back(1, first);
    for (std::size_t k = 0; k < group.size(); ++k)
      for (Eigen::Index j = 0; j < M.rows(); ++j)
        if (M(group[k], j) != 0.0 && !std::exchange(met[static_cast<std::size_t>(j)], 1)) group.push_back(j);
  }
  return groups;
}

/// y of (4) where no z lets all push: by the proximal point method, M y_(k+1) + E (y_(k+1) - y_k) + p = w
/// with a small E, whose steps tend to the least pull. What is left of the first falls by E/M in each; y
/// grows as 1/E.
Eigen::VectorXd least_pull(const Eigen::MatrixXd& M, const Eigen::VectorXd& p) {
  constexpr double small = 1e-6;  // 1e-4 and 1e-8 pass the same tests
  constexpr int steps = 3;
  const Eigen::VectorXd E = small * M.diagonal();
  const Eigen::MatrixXd regular = M + Eigen::MatrixXd(E.asDiagonal());
  Eigen::VectorXd y = Eigen::VectorXd::Zero(p.size());
  for (int k = 0; k < steps; ++k) {
    const auto next = complementary_solution(regular, p - E.cwiseProduct(y));
    if (!next) break;
    y = *next;
  }
  return y;
}

/// How exactly positions are known: to some roundings of the farthest, and to what is left of the
/// constraints.
double rounding(const System& system, const Instant& at, const System::Evaluation& e,
                std::span<const double> lengths) {
  constexpr double roundings = 4.0;
  double size = 0.0;
  for (std::size_t i = 0; i < lengths.size(); ++i)
    size = std::max(size, roundings * epsilon * std::abs(at.q[i]) * lengths[i]);
  for (std::size_t r = 0; r < e.g.size(); ++r) {
    if (!system.law(r).compliant() && e.g[r] != 0.0)
      size = std::max(size, std::abs(e.g[r]) / gradient_length(system, e.w, lengths, r));
  }
  return size;
}

}  // namespace

MinimumNorm::MinimumNorm(const System& system, const ActiveRows& active, std::vector<double> lengths)
    : system_(&system),
      lengths_(std::move(lengths)),
      active_(active.rows.begin(), active.rows.end()),
      dropped_(others(system, active)),
      unique_(system.rows(), 1),
      shares_(system) {
  if (!dropped_.empty()) place(system);
}

void MinimumNorm::place(const System& system) {
  std::vector<const Layout::Constraint*> constraints;
  for (const auto& c : system.layout()->constraints) constraints.push_back(&c);
  std::ranges::sort(constraints, {}, &Layout::Constraint::first_row);
  Eigen::Index first = 0, forces = 0;
  for (const auto* c : constraints) {
    if (!c->internal) {
      stated_.push_back({c->first_row, c->rows, c->inputs, first, forces});
      forces += stated_.back().forces();
    }
    first += static_cast<Eigen::Index>(c->rows) * c->inputs;
  }
  for (const std::size_t number : system.conditions().contacts()) {
    const auto& c = system.layout()->constraints[number];
    if (system.in_force(c.own_rows().front()))
      one_sided_.push_back(
          {.pressing_row = c.first_row, .sign = system.conditions().of[number].contact->sign()});
  }
  for (const Eigen::Index r : dropped_) unique_[static_cast<std::size_t>(r)] = 0;
  const auto d = static_cast<Eigen::Index>(dropped_.size());
  const auto m = static_cast<Eigen::Index>(system.rows());
  x_.resize(system.coordinates() + active_.size());
  U_.resize(static_cast<std::size_t>(first));
  nudge_ = irregular(lengths_.size());
  q_nearby_.resize(lengths_.size());
  nearby_ = system.evaluation();
  size_.resize(m);
  N_.resize(m, d);
  DN_.resize(forces, d);
  zero_.resize(d);
  scale_.resize(d);
  lambda_.resize(m, 1);
  right_.resize(forces, 1);
}

void MinimumNorm::spread(const Solve& solve, const Instant& at, const System::Evaluation& e,
                         std::span<double> lambda) {
  measure(e.w);
  evaluate_nearby(at, e);
  find_null_space(solve, e.w);
  mark_unique();
  Eigen::Map<Eigen::VectorXd> all(lambda.data(), N_.rows());
  lambda_ = all;
  minimise();
  all.noalias() += N_ * z_;
  const auto pushing = sharing();
  keep_pushing(pushing, lambda);
  shares_.spread(N_, unique_, pushing, lambda);
}

/// The rods inside bodies are of unit gradient: their multipliers are forces.
void MinimumNorm::measure(std::span<const double> w) {
  system_->forces_at_points(w, lengths_, U_);
  size_.setOnes();
  for (const Stated& c : stated_) {
    for (Eigen::Index k = 0; k < c.rows; ++k)
      size_[c.row + k] =
          Eigen::Map<Eigen::VectorXd>(&U_[static_cast<std::size_t>(c.first + k * c.inputs)], c.inputs).norm();
  }
}

void MinimumNorm::evaluate_nearby(const Instant& at, const System::Evaluation& e) {
  const double size = rounding(*system_, at, e, lengths_);
  for (std::size_t i = 0; i < lengths_.size(); ++i) q_nearby_[i] = at.q[i] + nudge_[i] * size / lengths_[i];
  system_->evaluate({at.t, q_nearby_, at.v}, nearby_);
}

void MinimumNorm::find_null_space(const Solve& solve, std::span<const double> w) {
  constexpr int solves = 2;  // the first may have lost half of the digits, see SaddleMatrix
  const auto y = std::span(x_).subspan(lengths_.size());
  N_.setZero();
  for (Eigen::Index j = 0; j < N_.cols(); ++j) {
    N_(dropped_[static_cast<std::size_t>(j)], j) = 1.0;
    for (int k = 0; k < solves; ++k) {
      solve_for_correction(solve, w, j);
      for (std::size_t r = 0; r < y.size(); ++r) N_(active_[r], j) += y[r];
    }
    solve_for_correction(solve, nearby_.w, j);
    double change = epsilon * N_.col(j).cwiseProduct(size_).lpNorm<Eigen::Infinity>();
    for (std::size_t r = 0; r < y.size(); ++r) change = std::max(change, std::abs(y[r]) * size_[active_[r]]);
    zero_[j] = margin * change;
  }
}

/// M x - W_a^T y = W^T N_j,  W_a x = 0: then y is the correction of N_j.
void MinimumNorm::solve_for_correction(const Solve& solve, std::span<const double> w, Eigen::Index j) {
  std::ranges::fill(x_, 0.0);
  for (Eigen::Index r = 0; r < N_.rows(); ++r) {
    const double factor = N_(r, j);
    if (factor != 0.0) add_row(*system_, w, static_cast<std::size_t>(r), factor, x_);
  }
  solve(x_);
}

void MinimumNorm::mark_unique() {
  for (const Eigen::Index r : active_) {
    char& unique = unique_[static_cast<std::size_t>(r)];
    unique = 1;
    for (Eigen::Index j = 0; j < N_.cols(); ++j) {
      if (std::abs(N_(r, j)) * size_[r] > zero_[j]) unique = 0;
    }
    if (unique) N_.row(r).setZero();
  }
}

/// D x, column by column of x.
void MinimumNorm::weigh(const Eigen::MatrixXd& multipliers, Eigen::MatrixXd& forces) const {
  using Rows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
  for (const Stated& c : stated_) {
    const auto own = multipliers.middleRows(c.row, c.rows);
    auto force = forces.middleRows(c.force, c.forces());
    if (c.rows == 1) {
      force = size_[c.row] * own;
    } else {
      force.noalias() = Rows(&U_[static_cast<std::size_t>(c.first)], c.rows, c.inputs).transpose() * own;
    }
  }
}

/// (3). What changes no stated force stays out of the basis: a column of D N that is zero to rounding, as
/// where the equations of one constraint repeat each other, and what columns have in common.
void MinimumNorm::minimise() {
  weigh(N_, DN_);
  weigh(lambda_, right_);
  double zero = 0.0;  // of columns of length 1
  for (Eigen::Index j = 0; j < DN_.cols(); ++j) {
    const double length = DN_.col(j).norm();
    scale_[j] = length > zero_[j] ? 1.0 / length : 0.0;
    zero = std::max(zero, zero_[j] * scale_[j]);
  }
  DN_ *= scale_.asDiagonal();
  qr_.compute(DN_, zero);
  z_ = -qr_.solve(right_).cwiseProduct(scale_);
}

/// Those that do not push alone.
std::vector<SharedContact> MinimumNorm::sharing() const {
  std::vector<SharedContact> sharing;
  for (const SharedContact& one : one_sided_)
    if (!unique_[static_cast<std::size_t>(one.pressing_row)]) sharing.push_back(one);
  return sharing;
}

/// (4), for those that share with each other. Of what neither pushes nor pulls the force is 0 exactly.
void MinimumNorm::keep_pushing(const std::vector<SharedContact>& sharing, std::span<double> lambda) const {
  const auto n = static_cast<Eigen::Index>(sharing.size());
  Eigen::Map<Eigen::VectorXd> all(lambda.data(), N_.rows());
  Eigen::MatrixXd A(n, N_.cols());
  Eigen::VectorXd p(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const SharedContact& one = sharing[static_cast<std::size_t>(i)];
    A.row(i) = one.sign * N_.row(one.pressing_row);
    p[i] = one.sign * all[one.pressing_row];
  }
  if (n == 0 || p.minCoeff() >= 0.0) return;
  const Eigen::MatrixXd P = scale_.asDiagonal() * qr_.pseudo_inverse();
  const Eigen::MatrixXd AP = dense::product(A, P);
  const Eigen::MatrixXd response = dense::product(P, Eigen::MatrixXd(AP.transpose()));
  const Eigen::MatrixXd M = dense::product(A, response);
  for (const auto& group : connected(M)) {
    const auto push = complementary_solution(M(group, group), p(group));
    const Eigen::VectorXd y = push ? *push : least_pull(M(group, group), p(group));
    all += dense::product(N_, dense::product(Eigen::MatrixXd(response(Eigen::all, group)), y));
    for (std::size_t i = 0; push && i < group.size(); ++i)
      if (y[static_cast<Eigen::Index>(i)] > 0.0)
        all[sharing[static_cast<std::size_t>(group[i])].pressing_row] = 0.0;
  }
}

}  // namespace dalembert
