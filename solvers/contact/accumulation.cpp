#include "dalembert/solvers/contact/accumulation.h"

#include <cmath>
#include <utility>

namespace dalembert {

namespace {

/// The sum of all intervals that follow one of length D with ratio r, when r_before was the one before it.
/// With d = r - rho they are D rho^k (1 + d (1 - rho^k)/(1 - rho)), to first order in d.
double sum_of_rest(double D, double r_before, double r) {
  // rho of the two: r - rho = rho (r_before - rho).
  const double half = 0.5 * (1.0 + r_before), root = half * half - r;
  const double rho = root >= 0.0 ? half - std::sqrt(root) : r;
  if (!(rho < 1.0)) return std::numeric_limits<double>::infinity();
  return D * rho / (1.0 - rho) * (1.0 + (r - rho) / (1.0 - rho * rho));
}

}  // namespace

void Accumulation::add(double t) {
  const double before = std::exchange(interval_, t - std::exchange(last_, t));
  const double ratio_before = std::exchange(ratio_, interval_ / before);
  left_ = infinity;
  if (!(ratio_before > 0.0 && ratio_before < 1.0)) return;
  left_ = sum_of_rest(interval_, ratio_before, ratio_);
  const double before_this = std::exchange(estimate_, t + left_);
  const double change = std::abs(estimate_ - before_this);
  if (change >= change_) return;
  change_ = change;
  limit_ = estimate_;
}

}  // namespace dalembert
