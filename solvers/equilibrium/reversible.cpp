#include "dalembert/solvers/equilibrium/reversible.h"

#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/errors.h>
#include <dalembert/core/linear/products.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/disturbances.h>
#include <dalembert/solvers/equilibrium/reversor.h>
#include <dalembert/solvers/equilibrium/symmetries.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// f' and R of the theorem in some coordinates.
struct Reduced {
  MatrixXd f, R;
};

/// The same map of displacements and of velocities, or two, in the metric of the masses.
MatrixXd on_states(const VectorXd& root, const MatrixXd& of_q, const MatrixXd& of_v) {
  const Index n = root.size();
  MatrixXd both = MatrixXd::Zero(2 * n, 2 * n);
  both.topLeftCorner(n, n) = root.asDiagonal() * of_q * root.cwiseInverse().asDiagonal();
  both.bottomRightCorner(n, n) = root.asDiagonal() * of_v * root.cwiseInverse().asDiagonal();
  return both;
}

/// Disturbances x = B c that the constraints allow have N^T x' = N^T A x, and in the frame that moves along
/// x' less its motion of x. Across the displacements Y by symmetries and by others, Q^T B^T Y = 0, the rest
/// is f'.
Reduced reduced(const Disturbances& all, const MatrixXd& frame, const MatrixXd& mirror, const MatrixXd& Y) {
  const FreeDisturbances free(all);
  const MatrixXd &B = free.basis, N = free.across;
  const MatrixXd Q = orthogonal_complement(B.transpose() * Y);
  const MatrixXd rate =
      dense::solve(MatrixXd(N.transpose() * B), MatrixXd(free.rate - N.transpose() * frame * B));
  return {Q.transpose() * rate * Q, Q.transpose() * (B.transpose() * mirror * B) * Q};
}

/// A basis of the displacements, and all that is outside of a part. (A symmetry that leaves the state as it
/// is displaces it by round-off, in no direction.)
MatrixXd with_others(const MatrixXd& Y, const Islands& parts, std::size_t part) {
  const Index n = Y.rows() / 2, rank = Y.cols() - dense::kernel(Y, rank_threshold).cols();
  MatrixXd all = MatrixXd::Zero(2 * n, rank + 2 * n);
  all.leftCols(rank) = dense::orthonormal(Y, rank);
  for (Index i = 0; i < 2 * n; ++i)
    all(i, rank + i) = parts.of_coordinate[static_cast<std::size_t>(i % n)] != part ? 1.0 : 0.0;
  return all;
}

/// Whether R = 1, or -1 along one line, on which f'^2 = -omega^2. Where omega passes 0 a state is known to
/// the root of round-off, and omega^2 as well.
bool is_stable_by(const Reduced& x) {
  const MatrixXd one = MatrixXd::Identity(x.R.rows(), x.R.cols()), onto_line = 0.5 * (one - x.R);
  if (onto_line.norm() <= rank_threshold) return true;
  const double size = x.f.norm();
  const bool reversible =
      (x.R * x.R - one).norm() <= rank_threshold && (x.R * x.f + x.f * x.R).norm() <= rank_threshold * size;
  return reversible && std::lround(onto_line.trace()) == 1 &&
         (onto_line * x.f * x.f).trace() < -std::sqrt(epsilon) * size * size;
}

/// Whether some symmetry leaves the state as it is, but not states near it of a part.
bool is_fixed(const Symmetries& symmetries, const MatrixXd& Y, const Islands& parts, std::size_t part) {
  const MatrixXd fixing = dense::kernel(Y, rank_threshold);
  for (Index k = 0; k < fixing.cols(); ++k) {
    const auto A = symmetries.motion(fixing.col(k)).A;
    for (Index i = 0; i < A.rows(); ++i)
      if (parts.of_coordinate[static_cast<std::size_t>(i)] == part && A.row(i).norm() > rank_threshold)
        return true;
  }
  return false;
}

}  // namespace

ReversibleMotion::ReversibleMotion(const Problem& problem, const FlatSample& at, const UniformMotion& motion)
    : problem_(problem), at_(at), motion_(&motion) {}

bool ReversibleMotion::is_stable(std::size_t part) {
  const auto known = found_.find(part);
  return known != found_.end() ? known->second : (found_[part] = find(part));
}

bool ReversibleMotion::decided() const {
  return std::ranges::any_of(found_, [](const auto& one) { return one.second; });
}

bool ReversibleMotion::find(std::size_t part) const try {
  const System& system = problem_.system();
  const Start start = consistent_start(
      problem_, at_.q, at_.v,
      {.t_end = std::numeric_limits<double>::infinity(), .t_start = at_.time, .assemble = true});
  const auto mirrors = reversors(problem_, start, at_.time, part);
  if (mirrors.empty()) return false;
  const Symmetries symmetries(problem_, start, at_.time);
  const auto n = static_cast<Index>(system.coordinates());
  const VectorXd q = Eigen::Map<const VectorXd>(at_.q.data(), n),
                 v = Eigen::Map<const VectorXd>(at_.v.data(), n),
                 root = Eigen::Map<const VectorXd>(system.masses().data(), n).cwiseSqrt();
  const double T = start.scales.time;
  MatrixXd Y(2 * n, symmetries.size());
  Y << root.asDiagonal() * symmetries.fields(q), T * root.asDiagonal() * symmetries.images(v);
  if (is_fixed(symmetries, Y, problem_.islands(), part)) return false;
  const MatrixXd A = T * MatrixXd(motion_->A);
  const Disturbances all(system, start.rows, at_, T);
  return std::ranges::any_of(mirrors, [&](const Reversor& R) {
    return is_stable_by(reduced(all, on_states(root, A, A), on_states(root, R.S, R.V),
                                with_others(Y, problem_.islands(), part)));
  });
} catch (const Error&) {
  return false;  // not decided by this
}

}  // namespace dalembert
