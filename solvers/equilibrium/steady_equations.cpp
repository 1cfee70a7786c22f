#include "dalembert/solvers/equilibrium/steady_equations.h"

#include <dalembert/core/analysis/disjoint_sets.h>
#include <dalembert/core/linear/products.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/linear_terms.h>
#include <dalembert/solvers/equilibrium/mass_metric.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::span<const double> numbers(const VectorXd& x) { return {x.data(), static_cast<std::size_t>(x.size())}; }
VectorXd as_vector(std::span<const double> x) {
  return Eigen::Map<const VectorXd>(x.data(), static_cast<Index>(x.size()));
}

}  // namespace

SteadyEquations::SteadyEquations(const System& system, const Islands& parts, const Symmetries& symmetries,
                                 const Scales& scales, const ActiveRows& rows, const State& at, Index kept)
    : n_(at.q.size()),
      m_(static_cast<Index>(rows.size())),
      p_(at.y.size()),
      part_of_row_(parts.of_coordinate),
      parts_(parts.count),
      masses_(as_vector(system.masses())),
      units_(n_ + p_),
      X_(symmetries.fields(at.q)),
      J_(MatrixXd::Zero(n_ + m_ + kept, n_ + p_)),
      J_terms_(J_),
      L_(MatrixXd::Zero(J_.rows(), m_)),
      r_(VectorXd::Zero(J_.rows())),
      r_terms_(r_) {
  for (const std::size_t row : rows.rows) part_of_row_.push_back(parts.of_row(system, row));
  v_ = X_ * at.y;
  const double most = v_.size() > 0 ? v_.cwiseAbs().maxCoeff() : 0.0;
  for (Index i = 0; i < n_; ++i) units_[i] = scales.unit(static_cast<std::size_t>(i));
  units_.tail(p_).setConstant(std::max(most / scales.length, 1e-3 / scales.time));
  still_ = symmetries.displacements(at.q, symmetries.commuting(at.q, at.y));
  add_equations(system, symmetries, rows, at, most);
}

void SteadyEquations::add_equations(const System& system, const Symmetries& symmetries,
                                    const ActiveRows& rows, const State& at, double most) {
  const RotatingFrame frame(symmetries.motion(at.y));
  const Instant now{at.time, numbers(at.q), numbers(v_)};
  const LinearTerms terms = linear_terms(system, frame, now, numbers(at.lambda));
  auto e = system.evaluation();
  system.evaluate(now, e);
  const VectorXd force = as_vector(e.force), inertia = masses_.cwiseProduct(frame.matrix() * v_);
  r_.head(n_) = force - inertia;
  r_terms_.head(n_) = force.cwiseAbs() + inertia.cwiseAbs();
  const MatrixXd AX = frame.matrix() * X_, Xv = symmetries.images(v_);
  J_.block(0, n_, n_, p_) = masses_.asDiagonal() * (AX - Xv);
  J_terms_.block(0, n_, n_, p_) = masses_.asDiagonal() * (AX.cwiseAbs() + Xv.cwiseAbs());
  for (const auto& k : terms.stiffness) {
    J_(static_cast<Index>(k.row()), static_cast<Index>(k.col())) -= k.value();
    J_terms_(static_cast<Index>(k.row()), static_cast<Index>(k.col())) += std::abs(k.value());
  }
  for (const auto& c : terms.damping)
    J_.block(static_cast<Index>(c.row()), n_, 1, p_) -= c.value() * X_.row(static_cast<Index>(c.col()));
  for (Index a = 0; a < m_; ++a) {
    const std::size_t row = rows.rows[static_cast<std::size_t>(a)];
    const double lambda = at.lambda[static_cast<Index>(row)];
    const bool holonomic = row < system.holonomic_rows();
    r_[n_ + a] = holonomic ? system.law(row).residual(e.g[row], lambda) : e.psi[row];
    if (holonomic) L_(n_ + a, a) = system.law(row).compliance;
    for (const std::size_t k : system.row(row)) {
      const auto i = static_cast<Index>(system.w_columns()[k]);
      const double w = terms.w[k];
      r_[i] += w * lambda;
      r_terms_[i] += std::abs(w * lambda);
      r_terms_[n_ + a] += std::abs(w) * (holonomic ? std::max(std::abs(at.q[i]), units_[i]) : most);
      L_(i, a) += w;
      J_(n_ + a, i) += holonomic ? w : terms.e[k];
      if (!holonomic) J_.block(n_ + a, n_, 1, p_) += w * X_.row(i);
    }
  }
  for (const auto& particle : system.layout()->particles) {  // round-off has any direction
    auto own = r_terms_.segment(particle.coordinate, system.layout()->dimension);
    own.setConstant(own.maxCoeff());
  }
}

void SteadyEquations::keep(Index k, double off, double terms, const Eigen::RowVectorXd& gradient) {
  r_[n_ + m_ + k] = off;
  r_terms_[n_ + m_ + k] = terms;
  J_.row(n_ + m_ + k) = gradient;
}

void SteadyEquations::divide_row(Index i, double by) {
  r_[i] /= by;
  r_terms_[i] /= by;
  J_.row(i) /= by;
  J_terms_.row(i) /= by;
  if (L_.cols() > 0) L_.row(i) /= by;  // else it has no memory
}

/// Forces over the roots of the masses, other rows of length 1. Along symmetries that commute with the motion
/// no equation changes, exactly: what is left of their derivative is round-off.
void SteadyEquations::weigh() {
  for (Index i = 0; i < n_; ++i) divide_row(i, std::sqrt(masses_[i]));
  J_ = (J_ * units_.asDiagonal()).eval();
  J_terms_ = J_.cwiseAbs().cwiseMax(J_terms_ * units_.asDiagonal());
  const MatrixXd still =
      orthogonal_complement(orthogonal_complement(units_.head(n_).cwiseInverse().asDiagonal() * still_));
  auto by_q = J_.topLeftCorner(n_ + m_, n_);
  by_q -= MatrixXd(by_q) * still * still.transpose();
  for (Index i = n_; i < J_.rows(); ++i)
    if (const double length = J_.row(i).norm(); length > 0.0) divide_row(i, length);
}

bool SteadyEquations::reads(Index row, std::size_t part) const {
  VectorXd by = J_.row(row).head(n_).transpose();
  by = by.cwiseAbs() + (X_ * J_.row(row).tail(p_).transpose()).cwiseAbs();
  for (Index i = 0; i < n_; ++i)
    if (by[i] != 0.0 && part_of_row_[static_cast<std::size_t>(i)] == part) return true;
  return false;
}

std::vector<double> SteadyEquations::unbalanced() {
  weigh();
  free_ = m_ > 0 ? orthogonal_complement(L_) : MatrixXd::Identity(J_.rows(), J_.rows());
  const MatrixXd across = free_ * free_.transpose();
  const VectorXd left = (across * r_).cwiseAbs(), terms = dense::sizes(across) * r_terms_;
  std::vector<double> most(parts_);
  DisjointSets together(parts_);  // what is kept of several parts couples them
  for (Index i = 0; i < left.size(); ++i) {
    const double by = left[i] > 0.0 ? left[i] / terms[i] : 0.0;
    std::optional<std::size_t> first;
    for (std::size_t part = 0; part < parts_; ++part) {
      if (i < n_ + m_ ? part_of_row_[static_cast<std::size_t>(i)] != part : !reads(i, part)) continue;
      most[part] = std::max(most[part], by);
      together.join(first.value_or(part), part);
      first = part;
    }
  }
  for (std::size_t part = 0; part < parts_; ++part)
    most[together.root(part)] = std::max(most[together.root(part)], most[part]);
  for (std::size_t part = 0; part < parts_; ++part) most[part] = most[together.root(part)];
  return most;
}

VectorXd SteadyEquations::balance() const {
  if (m_ == 0) return VectorXd();
  return dense::least_squares(L_, -r_, rank_threshold);
}

/// J but for what would move parts that stay.
MatrixXd SteadyEquations::slopes_of_others(const std::vector<char>& stays) const {
  MatrixXd J = J_;
  std::vector<Index> still;
  for (Index i = 0; i < n_; ++i)
    if (stays[part_of_row_[static_cast<std::size_t>(i)]]) still.push_back(i);
  if (still.empty()) return J;
  J(Eigen::all, still).setZero();
  if (p_ == 0) return J;
  const MatrixXd moving = dense::kernel(X_(still, Eigen::all), rank_threshold);
  J.rightCols(p_) = (J_.rightCols(p_) * moving * moving.transpose()).eval();
  return J;
}

/// Forces in units of the stiffness that they change by. What is round-off of its terms changes by nothing.
VectorXd SteadyEquations::least_change(const MatrixXd& J) const {
  MatrixXd left = free_.transpose() * J;
  VectorXd right = free_.transpose() * r_;
  const VectorXd least = roundings_of_a_sum * epsilon *
                         (dense::sizes(free_).transpose() * VectorXd(J_terms_.rowwise().maxCoeff()));
  for (Index i = 0; i < left.rows(); ++i) {
    const double length = left.row(i).norm(), unit = length > least[i] ? 1.0 / length : 0.0;
    left.row(i) *= unit;
    right[i] *= unit;
  }
  return dense::least_squares(left, -right, rank_threshold);
}

SteadyEquations::Correction SteadyEquations::correction(const std::vector<char>& stays) const {
  const MatrixXd J = slopes_of_others(stays);
  const VectorXd x = least_change(J);
  Correction found{units_.head(n_).cwiseProduct(x.head(n_)), units_.tail(p_).cwiseProduct(x.tail(p_)),
                   VectorXd::Zero(m_), x.size() > 0 ? x.cwiseAbs().maxCoeff() : 0.0};
  if (!x.allFinite()) found.size = std::numeric_limits<double>::infinity();
  if (m_ > 0 && x.allFinite()) found.lambda = dense::least_squares(L_, -r_ - J * x, rank_threshold);
  return found;
}

}  // namespace dalembert
