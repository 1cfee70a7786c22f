#include "dalembert/solvers/contact/second_motion.h"

#include <dalembert/core/linear/dense.h>
#include <dalembert/solvers/contact/round_off.h>

#include <cmath>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

using All = std::vector<const RoughState*>;

/// sigma = friction |N|.
MatrixXd friction_of(const All& sliding, Index rows) {
  MatrixXd friction = MatrixXd::Zero(rows, static_cast<Index>(sliding.size()));
  Index row = 0, k = 0;
  for (const RoughState* r : sliding) {
    const auto own = static_cast<Index>(r->rows);
    friction.block(row, k++, own, 1) = -r->mu * r->direction;
    row += own;
  }
  return friction;
}

/// Whether these have the signs, to round-off of the largest, and what starts from rest goes on in its
/// direction, against its friction.
bool satisfies(const VectorXd& N, const VectorXd& sign, const SlipCoupling& coupling,
               const MatrixXd& friction, const All& sliding) {
  if (!N.allFinite()) return false;
  const double none = round_off() * N.lpNorm<Eigen::Infinity>();
  if ((N.cwiseProduct(sign).array() < -none).any()) return false;
  const VectorXd rate = coupling.c + dense::product(coupling.S, VectorXd(friction * N.cwiseAbs()));
  for (Index k = 0; k < N.size(); ++k)
    if (sliding[static_cast<std::size_t>(k)]->at_rest && friction.col(k).dot(rate) > 0.0) return false;
  return true;
}

}  // namespace

std::optional<SecondMotion> SecondMotion::find(const SlipCoupling& coupling, const All& sliding) {
  const auto size = static_cast<Index>(sliding.size());
  const MatrixXd friction = friction_of(sliding, coupling.c.size()), G = dense::product(coupling.B, friction);
  VectorXd sign(size);
  for (Index k = 0; k < size; ++k) sign[k] = sliding[static_cast<std::size_t>(k)]->sign;
  const MatrixXd A = MatrixXd::Identity(size, size) - G * sign.asDiagonal();
  const VectorXd N = dense::solve(A, coupling.N_0);
  const MatrixXd C = dense::solve(A, G);
  const double none = round_off() * N.lpNorm<Eigen::Infinity>();
  for (Index k = 0; k < size; ++k) {
    const RoughState* const rough = sliding[static_cast<std::size_t>(k)];
    const double part = 1.0 + 2.0 * sign[k] * C(k, k);
    if (!tries(*rough) || !(part < 0.0) || std::abs(N[k]) <= none) continue;
    const VectorXd other = N - 2.0 * sign[k] * (N[k] / part) * C.col(k);
    VectorXd signs = sign;
    signs[k] = -signs[k];
    if (satisfies(other, signs, coupling, friction, sliding)) return SecondMotion{rough, N[k], other[k]};
  }
  return std::nullopt;
}

}  // namespace dalembert
