#include "dalembert/solvers/contact/accumulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

namespace {

/// rho of the two: r - rho = rho (r_before - rho).
double limit_of_ratios(double r_before, double r) {
  const double half = 0.5 * (1.0 + r_before), root = half * half - r;
  return root >= 0.0 ? half - std::sqrt(root) : r;
}

/// The sum of all intervals that follow one of length D with ratio r, when the ratios tend to rho.
/// With d = r - rho they are D rho^k (1 + d (1 - rho^k)/(1 - rho)), to first order in d.
double sum_of_rest(double D, double r, double rho) {
  if (!(rho < 1.0)) return std::numeric_limits<double>::infinity();
  return D * rho / (1.0 - rho) * (1.0 + (r - rho) / (1.0 - rho * rho));
}

/// By how much, at most, the limit moves when each of the last four times moves by 1: that of the last, and
/// the sum above by D, r and r_before, where these are rho. It grows without end as rho tends to 1.
double amplification(double rho) {
  if (!(rho < 1.0)) return std::numeric_limits<double>::infinity();
  const double left = 1.0 - rho;
  return 1.0 + 2.0 * rho / left + 2.0 * rho * (1.0 + rho) / (left * left * left);
}

}  // namespace

void Accumulation::add(double t, double error) {
  const double before = std::exchange(interval_, t - std::exchange(last_, t));
  const double ratio_before = std::exchange(ratio_, interval_ / before);
  left_ = infinity;
  if (t - error > limit_) limit_ = change_ = infinity;
  if (!(ratio_before > 0.0 && ratio_before < 1.0)) return;
  const double rho = limit_of_ratios(ratio_before, ratio_);
  left_ = sum_of_rest(interval_, ratio_, rho);
  const double before_this = std::exchange(estimate_, t + left_);
  if (estimate_ == infinity) return;
  const double change = std::abs(estimate_ - before_this);
  // What is of the same series has the same rho: the one found last is known worse.
  if (change >= change_ && !contradicts(error * amplification(std::max(rho, rho_)))) return;
  rho_ = rho;
  change_ = change;
  limit_ = estimate_;
}

/// Whether the last estimate is not of the series that the best one is of.
bool Accumulation::contradicts(double error_of_estimate) const {
  return std::abs(estimate_ - limit_) > change_ + error_of_estimate;
}

}  // namespace dalembert
