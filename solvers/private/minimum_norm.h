#pragma once

#include <dalembert/solvers/private/rows.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <functional>
#include <span>
#include <vector>

namespace dalembert {

/// Forces of dependent constraints. Where rows of W depend on each other, W^T lambda is unique but
/// lambda is not. With every row scaled to unit length, a an independent set and d the others,
///
///   w_d = B w_a,                            one KKT solve for each row of d                   (1)
///   lambda_a = lambda - B^T lambda_d        gives the same force for any lambda_d             (2)
///   (I + B B^T) lambda_d = B lambda         makes |lambda_a|^2 + |lambda_d|^2 the least       (3)
///
/// so that the smallest forces are chosen, and no choice of the independent set or scale of the
/// user's equations shows in the result. A row's force is unique if its column of B is zero.
class MinimumNorm {
 public:
  /// The rows of `system` that are not in `active`.
  /// `lever` as in Violation.
  MinimumNorm(const System& system, const ActiveRows& active, std::vector<double> lever);

  [[nodiscard]] bool needed() const { return !dropped_.empty(); }
  /// Spreads lambda (one per row of the system, zero for dropped ones) by (1)-(3); `solve` solves
  /// [M -W^T; W 0] of the active rows at the same state in place.
  void spread(const std::function<void(std::span<double>)>& solve, std::span<const double> w,
              std::span<double> lambda);
  /// Per row of the system, after `spread`: 1 if its multiplier is determined by the motion.
  [[nodiscard]] std::span<const char> unique() const { return unique_; }

 private:
  const System* system_;
  std::vector<double> lever_;
  std::vector<int> active_, dropped_;
  std::vector<char> unique_;
  std::vector<double> x_, length_;
  Eigen::MatrixXd B_, normal_;
  Eigen::VectorXd scaled_, right_, lambda_d_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

}  // namespace dalembert
