#include "dalembert/solvers/manifold/scales.h"

#include <dalembert/solvers/base/accuracy.h>
#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace dalembert {

double Scales::largest_rounding(std::span<const double> q) const {
  double farthest = 0.0;
  for (std::size_t i = 0; i < q.size(); ++i) farthest = std::max(farthest, std::abs(q[i]) * length / unit(i));
  return epsilon * farthest;
}

double Scales::roundings_of_difference(std::span<const double> q) const {
  if (length_from_path) return 1.0;
  double farthest = length;
  for (std::size_t i = 0; i < q.size(); ++i)
    if (!is_angle[i]) farthest = std::max(farthest, std::abs(q[i]));
  return farthest / length;
}

double Scales::rounding(std::span<const double> q) const { return 10.0 * largest_rounding(q); }

std::vector<double> Scales::lengths() const {
  std::vector<double> lengths(is_angle.size());
  std::ranges::transform(is_angle, lengths.begin(), [&](char angle) { return angle ? length : 1.0; });
  return lengths;
}

double Scales::largest(std::span<const double> x) const {
  double largest = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, std::abs(x[i]) / unit(i));
  return largest;
}

/// Relative to the distance covered, errors are the same whatever the units and wherever t_end is: a step
/// from rest at constant acceleration a covers a h^2/2, and the first term of its error is smaller by a power
/// of h over the time in which the acceleration changes. Round-off in forces of size m a moves it in a step
/// by eps a h^2, in the positions themselves by eps |q|: that must not count against the tolerance, so the
/// distance is at least some of these over the tolerance.
PathExtent Scales::extended_by(std::span<const double> q, std::span<const double> v, double h,
                               double tolerance) const {
  const double rounding = constants.roundings_of_path * epsilon;
  const double noise = std::max(rounding / tolerance * forced * h, least);
  double least_length = std::max({noise * h, least, lever});
  for (std::size_t i = 0; i < q.size(); ++i)
    if (!is_angle[i]) least_length = std::max(least_length, rounding / tolerance * std::abs(q[i]));
  PathExtent next{std::max(extent.length, least_length), std::max(extent.speed, noise), extent.rate, h};
  for (std::size_t i = 0; i < q.size(); ++i) {
    if (is_angle[i]) {
      next.rate = std::max(next.rate, std::abs(v[i]));
    } else {
      next.length = std::max(next.length, std::abs(q[i] - origin[i]));
      next.speed = std::max(next.speed, std::abs(v[i]));
    }
  }
  next.speed = std::max(next.speed, next.rate * lever);
  next.rate = std::max(next.rate, noise / next.length);
  return next;
}

void Scales::adopt(const PathExtent& next) {
  extent = next;
  length = extent.length;
  time = length / extent.speed;
}

void Scales::adopt_for_first_step(PathExtent next, double t, double tolerance) {
  const double rounding = constants.roundings_of_path * epsilon * std::abs(t);
  next.length = std::max(next.length, next.speed * rounding / Accuracy(tolerance).first_implicit_step());
  adopt(next);
}

double Scales::velocity_error(std::size_t i, double v, double tolerance) const {
  const double speed = is_angle[i] ? extent.rate : extent.speed;
  return tolerance * ((length_from_path ? speed : unit(i) / time) + std::abs(v));
}

}  // namespace dalembert
