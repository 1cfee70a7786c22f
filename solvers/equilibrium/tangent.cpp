#include "dalembert/solvers/equilibrium/tangent.h"

#include <dalembert/core/analysis/islands.h>
#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/linear/products.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// What N^T X N sums, without signs.
MatrixXd summed(const MatrixXd& N, const MatrixXd& X) {
  return dense::restricted(dense::sizes(N), dense::sizes(X));
}

double largest_of(const MatrixXd& X) { return X.size() > 0 ? X.cwiseAbs().maxCoeff() : 0.0; }

/// Nonholonomic rows that holonomic ones imply say nothing of their own.
void leave_out_implied_rows(Tangent& t) {
  const double none = t.zero_of_rows();
  std::vector<Index> own;
  for (Index k = 0; k < t.B.rows(); ++k) {
    if (t.B.row(k).norm() < rank_threshold) t.B.row(k).setZero();
    if (!t.B.row(k).isZero(0.0) || largest_of(t.E.row(k)) > none) own.push_back(k);
  }
  t.B = t.B(own, Eigen::all).eval();
  t.E = t.E(own, Eigen::all).eval();
  t.E_terms = t.E_terms(own, Eigen::all).eval();
}

Tangent tangent(const System& system, const LinearTerms& terms, std::vector<std::size_t> coordinates,
                std::span<const std::size_t> rows) {
  const MassMetric metric(system, terms, coordinates, rows);
  const MatrixXd N = orthogonal_complement(metric.W.topRows(metric.holonomic).transpose());
  MatrixXd skew = MatrixXd(circulatory(terms, system.coordinates()));
  skew = skew(coordinates, coordinates).eval();
  const double known = round_off_of_a_sum * terms.roundings;
  skew = onto(N, metric.root.asDiagonal() * skew * metric.root.asDiagonal(), known);
  const Index velocity_rows = metric.W.rows() - metric.holonomic;
  const MatrixXd E = metric.E.bottomRows(velocity_rows);
  Tangent t{system.coordinates(),
            std::move(coordinates),
            metric.root.asDiagonal() * N,
            dense::restricted(N, metric.K),
            onto(N, metric.C, known),  // 0 where a guide takes up Coriolis forces
            MatrixXd(metric.W.bottomRows(velocity_rows)) * N,
            E * N,
            skew.isZero(0.0),
            metric.root.cwiseInverse().asDiagonal() * N,
            summed(N, metric.K_terms),
            dense::sizes(E) * dense::sizes(N),
            terms.roundings};
  // What a force sums by itself is not seen: nothing is known better than to round-off of the largest.
  t.K_terms = t.K_terms.cwiseMax(largest_of(t.K)).eval();
  t.E_terms = t.E_terms.cwiseMax(largest_of(t.E)).eval();
  if (t.symmetric) t.K = ((t.K + t.K.transpose()) / 2).eval();
  if (t.K.size() > 0 && t.K.cwiseAbs().maxCoeff() <= t.zero()) t.K.setZero();
  leave_out_implied_rows(t);
  return t;
}

void rest_along(const MatrixXd& symmetric, Tangent& t) {
  if (symmetric.cols() == 0) return;
  const MatrixXd own = t.metric.transpose() * MatrixXd(symmetric(t.coordinates, Eigen::all));
  if (own.isZero(0.0)) return;
  const MatrixXd still = orthogonal_complement(orthogonal_complement(own));
  const MatrixXd onto_still = still * still.transpose();
  t.K -= t.K * onto_still;
  t.E -= t.E * onto_still;
  if (t.symmetric) t.K -= onto_still * t.K;
}

void fix(const UniformMotion& motion, Tangent& t) {
  for (const auto& A : motion.fixing) {
    const MatrixXd whole = A, own = whole(t.coordinates, t.coordinates);
    MatrixXd beta = t.metric.transpose() * (own * t.shapes);
    if (!beta.isZero(rank_threshold)) t.fixing.push_back(std::move(beta));
  }
}

}  // namespace

MatrixXd onto(const MatrixXd& N, const MatrixXd& X, double known) {
  const MatrixXd Y = dense::restricted(N, X), size = summed(N, X);
  return (Y.array().abs() > known * size.array()).select(Y, MatrixXd::Zero(Y.rows(), Y.cols()));
}

double Tangent::scale_time() {
  double Omega = std::sqrt(K.norm());
  if (Omega == 0.0) Omega = std::max(C.norm(), E.norm());
  if (Omega == 0.0) return 1.0;
  K /= Omega * Omega;
  K_terms /= Omega * Omega;
  C /= Omega;
  E /= Omega;
  E_terms /= Omega;
  return Omega;
}

std::vector<Tangent> tangents(const System& system, const LinearTerms& terms, const UniformMotion* motion) {
  const Islands parts = islands(system);
  std::vector<std::vector<std::size_t>> coordinates(parts.count), rows(parts.count);
  for (std::size_t i = 0; i < system.coordinates(); ++i) coordinates[parts.of_coordinate[i]].push_back(i);
  for (std::size_t r = 0; r < system.rows(); ++r) rows[parts.of_row(system, r)].push_back(r);
  std::vector<Tangent> all;
  for (std::size_t k = 0; k < parts.count; ++k) {
    all.push_back(tangent(system, terms, std::move(coordinates[k]), rows[k]));
    if (motion == nullptr) continue;
    rest_along(motion->symmetric, all.back());
    fix(*motion, all.back());
  }
  return all;
}

}  // namespace dalembert
