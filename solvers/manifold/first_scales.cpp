#include "dalembert/solvers/manifold/first_scales.h"

#include <dalembert/solvers/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dalembert {

namespace {

/// The largest |x_i| of those that are no angles.
double largest_of_lengths(std::span<const double> x, const std::vector<char>& is_angle) {
  double largest = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!is_angle[i]) largest = std::max(largest, std::abs(x[i]));
  }
  return largest;
}

/// Smallest radius of curvature of the holonomic constraints, from their second derivatives at
/// unit gradient; infinite if all are flat. It needs no knowledge of what they are.
double smallest_radius(const System& system, const Instant& at, const System::Evaluation& e) {
  std::vector<double> unit(system.rows(), 0.0);
  for (std::size_t r = 0; r < system.holonomic_rows(); ++r) {
    double square = 0.0;
    for (const std::size_t k : system.row(r)) {
      square += e.w[k] * e.w[k];
    }
    if (system.in_force(r)) unit[r] = 1.0 / std::sqrt(square);
  }
  auto bent = system.linearisation();
  system.linearise_constraints(at, unit, bent);
  double curvature = 0.0;
  const auto is_angle = system.angles();
  for (std::size_t k = 0; k < system.stiffness_of_constraints(); ++k) {
    const auto [row, column] = system.stiffness_pattern()[k];
    if (is_angle[row] || is_angle[column]) continue;
    curvature = std::max(curvature, std::abs(bent.stiffness[k]));
  }
  return 1.0 / curvature;
}

}  // namespace

double least_lever(const System& system, const System::Evaluation& e, const std::vector<char>& is_angle) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t r = 0; r < system.rows(); ++r) {
    if (!system.in_force(r)) continue;
    double of_angles = 0.0, of_lengths = 0.0;
    for (const std::size_t k : system.row(r))
      (is_angle[system.w_columns()[k]] ? of_angles : of_lengths) += e.w[k] * e.w[k];
    if (of_angles > 0.0 && of_lengths > 0.0) least = std::min(least, std::sqrt(of_angles / of_lengths));
  }
  return std::isfinite(least) ? least : 0.0;
}

std::vector<double> forced_acceleration(const System& system, const System::Evaluation& e) {
  std::vector<double> a(e.force);
  for (std::size_t i = 0; i < a.size(); ++i) a[i] /= system.masses()[i];
  return a;
}

void set_length(const System& system, const Instant& at, const System::Evaluation& e, const Options& options,
                double nearest_contact, Scales& scales) {
  const double duration = options.t_end - options.t_start;
  scales.is_angle = system.angles();
  scales.length = options.length > 0.0 ? options.length : system.extent(at.t);
  // Points that coincide but for round-off coincide.
  const double rounding = 10.0 * epsilon * largest_of_lengths(at.q, scales.is_angle);
  if (!(options.length > 0.0) && scales.length <= rounding) scales.length = 0.0;
  if (scales.length > 0.0) return;
  const double radius = smallest_radius(system, at, e);
  const double v = largest_of_lengths(at.v, scales.is_angle);
  const double a = largest_of_lengths(forced_acceleration(system, e), scales.is_angle);
  const double reach = std::isinf(duration) ? radius : v * duration + a * duration * duration;
  // What moves by less than `least` rests as well, as before a force that sets in gently.
  scales.length = reach > Scales::least ? std::min(radius, reach) : std::isfinite(radius) ? radius : 1.0;
  scales.length_from_path = !system.compliant() && (scales.length < radius || std::isinf(scales.length)) &&
                            std::ranges::count(scales.is_angle, 0) > 0;
  // What is slower than would show in the positions is at rest, as where a motion reverses.
  const double shown = std::max(epsilon * largest_of_lengths(at.q, scales.is_angle), Scales::least);
  if (std::isinf(radius) && v > 0.0 && a > 0.0 && v * v / a > shown) scales.length = v * v / a;
  if (std::isinf(scales.length)) scales.length = v + a > Scales::least ? v + a : 1.0;
  if (scales.length_from_path) {
    scales.length = std::min(scales.length, std::max(nearest_contact, epsilon * scales.length));
  }
  scales.lever = least_lever(system, e, scales.is_angle);
  scales.forced = a;
}

double time_scale(const System& system, const System::Evaluation& e, const Start& start, double duration) {
  const double v = start.scales.largest(start.v);
  const double a =
      std::max(start.scales.largest(start.a), start.scales.largest(forced_acceleration(system, e)));
  double time = duration;
  if (v > 0.0) time = std::min(time, 1.0 / v);
  if (a > 0.0) time = std::min(time, 1.0 / std::sqrt(a));
  return std::isinf(time) ? 1.0 : time;
}

}  // namespace dalembert
