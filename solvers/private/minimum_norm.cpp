#include "dalembert/solvers/private/minimum_norm.h"

#include <algorithm>
#include <cmath>

namespace dalembert {

namespace {

/// Entries of B below this are round-off of the solves that give it.
constexpr double negligible = 1e-9;

std::vector<int> others(const System& system, const ActiveRows& active) {
  std::vector<int> dropped;
  for (int r = 0; r < system.rows(); ++r) {
    if (!std::ranges::binary_search(active.rows, r)) dropped.push_back(r);
  }
  return dropped;
}

}  // namespace

MinimumNorm::MinimumNorm(const System& system, const ActiveRows& active, std::vector<double> lever)
    : system_(&system),
      lever_(std::move(lever)),
      active_(active.rows),
      dropped_(others(system, active)),
      unique_(static_cast<std::size_t>(system.rows()), 1),
      x_(static_cast<std::size_t>(system.coordinates() + active.size())),
      length_(static_cast<std::size_t>(system.rows())) {
  const auto d = static_cast<Eigen::Index>(dropped_.size());
  const auto a = static_cast<Eigen::Index>(active_.size());
  if (d == 0) return;
  B_.resize(d, a);
  normal_.resize(d, d);
  scaled_.resize(a);
  right_.resize(d);
  lambda_d_.resize(d);
  factor_.compute(Eigen::MatrixXd::Identity(d, d));  // makes room
  for (const int r : dropped_) unique_[static_cast<std::size_t>(r)] = 0;
}

void MinimumNorm::spread(const std::function<void(std::span<double>)>& solve, std::span<const double> w,
                         std::span<double> lambda) {
  const auto n = static_cast<std::size_t>(system_->coordinates());
  for (std::size_t r = 0; r < length_.size(); ++r) length_[r] = gradient_length(*system_, w, lever_, r);
  for (std::size_t j = 0; j < dropped_.size(); ++j) {
    // M x - W_a^T y = w_j, W_a x = 0: then y = -(coefficients of w_j in the rows of W_a).
    const auto row = static_cast<std::size_t>(dropped_[j]);
    std::ranges::fill(x_, 0.0);
    for (auto k = static_cast<std::size_t>(system_->row_start()[row]);
         k < static_cast<std::size_t>(system_->row_start()[row + 1]); ++k) {
      x_[static_cast<std::size_t>(system_->w_columns()[k])] += w[k] / length_[row];
    }
    solve(x_);
    for (std::size_t r = 0; r < active_.size(); ++r) {
      B_(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(r)) =
          -x_[n + r] * length_[static_cast<std::size_t>(active_[r])];
    }
  }
  for (std::size_t r = 0; r < active_.size(); ++r) {
    const auto row = static_cast<std::size_t>(active_[r]);
    const auto column = B_.col(static_cast<Eigen::Index>(r));
    scaled_[static_cast<Eigen::Index>(r)] = lambda[row] * length_[row];
    unique_[row] = column.cwiseAbs().maxCoeff() < negligible ? 1 : 0;
  }
  normal_.noalias() = B_ * B_.transpose();
  normal_.diagonal().array() += 1.0;
  factor_.compute(normal_);
  right_.noalias() = B_ * scaled_;
  lambda_d_ = factor_.solve(right_);
  scaled_.noalias() -= B_.transpose() * lambda_d_;
  for (std::size_t r = 0; r < active_.size(); ++r) {
    const auto row = static_cast<std::size_t>(active_[r]);
    lambda[row] = scaled_[static_cast<Eigen::Index>(r)] / length_[row];
  }
  for (std::size_t j = 0; j < dropped_.size(); ++j) {
    const auto row = static_cast<std::size_t>(dropped_[j]);
    lambda[row] = lambda_d_[static_cast<Eigen::Index>(j)] / length_[row];
  }
}

}  // namespace dalembert
