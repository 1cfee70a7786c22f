#include "dalembert/solvers/private/manifold.h"

#include <algorithm>
#include <cmath>

namespace dalembert {

namespace {

Violation largest(const System& system, std::span<const double> residual, std::span<const double> w,
                  std::span<const double> lever) {
  Violation worst;
  for (std::size_t r = 0; r < residual.size(); ++r) {
    double square = 0.0;
    for (auto k = static_cast<std::size_t>(system.row_start()[r]);
         k < static_cast<std::size_t>(system.row_start()[r + 1]); ++k) {
      const double slope = w[k] / lever[static_cast<std::size_t>(system.w_columns()[k])];
      square += slope * slope;
    }
    const double size = std::abs(residual[r]) / std::sqrt(square);
    if (!(size <= worst.size)) worst = {size, static_cast<int>(r)};
  }
  return worst;
}

}  // namespace

Violation position_violation(const System& system, const System::Evaluation& e,
                             std::span<const double> lever) {
  return largest(system, e.g, e.w, lever);
}

Violation velocity_violation(const System& system, const System::Evaluation& e,
                             std::span<const double> lever) {
  return largest(system, e.psi, e.w, lever);
}

Manifold::Manifold(const System& system, const ActiveRows& rows, std::vector<double> lever)
    : system_(&system),
      rows_(rows),
      lever_(std::move(lever)),
      e_(system.evaluation()),
      gamma_(static_cast<std::size_t>(system.rows())),
      kkt_(system, rows),
      minimum_norm_(system, rows, lever_) {
  x_.resize(static_cast<std::size_t>(kkt_.size()));
  q_before_.resize(static_cast<std::size_t>(system.coordinates()));
}

void Manifold::evaluate(const Instant& at) {
  system_->evaluate(at, e_);
  ++evaluations_;
}

void Manifold::solve_for_position_step(std::size_t n) {
  std::fill_n(x_.begin(), n, 0.0);
  for (std::size_t r = 0; r < rows_.rows.size(); ++r) {
    const bool holonomic = static_cast<int>(r) < rows_.holonomic;
    x_[n + r] = holonomic ? -e_.g[static_cast<std::size_t>(rows_.rows[r])] : 0.0;
  }
  kkt_.solve(x_);
}

Violation Manifold::project_positions(double t, std::span<double> q, std::span<const double> v,
                                      double tolerance) {
  constexpr int most_iterations = 100;
  constexpr int most_halvings = 30;
  evaluate({t, q, v});
  Violation left = position_violation(*system_, e_, lever_);
  bool matrix_serves = false;
  for (int i = 0; i < most_iterations && left.size > tolerance; ++i) {
    if (!matrix_serves && !kkt_.factorise(e_.w)) break;
    solve_for_position_step(q.size());
    std::ranges::copy(q, q_before_.begin());
    const Violation before = left;
    double fraction = 1.0;
    for (int halving = 0; halving < most_halvings; ++halving, fraction *= 0.5) {
      for (std::size_t k = 0; k < q.size(); ++k) q[k] = q_before_[k] + fraction * x_[k];
      evaluate({t, q, v});
      left = position_violation(*system_, e_, lever_);
      if (left.size < before.size) break;
    }
    if (!(left.size < before.size)) {
      std::ranges::copy(q_before_, q.begin());
      evaluate({t, q, v});
      return before;
    }
    // Close to the manifold one matrix serves for all iterations.
    matrix_serves = left.size < 0.1 * before.size;
  }
  return left;
}

/// (2), with the matrix at hand. Of the equations psi is then out of date, and F if it depends on
/// velocities.
void Manifold::correct_velocities(std::span<double> v) {
  const std::size_t n = v.size();
  std::fill_n(x_.begin(), n, 0.0);
  for (std::size_t r = 0; r < rows_.rows.size(); ++r)
    x_[n + r] = -e_.psi[static_cast<std::size_t>(rows_.rows[r])];
  kkt_.solve(x_);
  for (std::size_t k = 0; k < n; ++k) v[k] += x_[k];
}

/// (3), with the matrix and the forces at hand.
void Manifold::solve_for_accelerations(const Instant& at, std::span<double> a) {
  const std::size_t n = at.q.size();
  system_->bias(at, gamma_);
  std::ranges::copy(e_.force, x_.begin());
  for (std::size_t r = 0; r < rows_.rows.size(); ++r)
    x_[n + r] = -gamma_[static_cast<std::size_t>(rows_.rows[r])];
  kkt_.solve(x_);
  std::copy_n(x_.begin(), n, a.begin());
}

bool Manifold::accelerate(const Instant& at, std::span<double> a) {
  evaluate(at);
  if (!kkt_.factorise(e_.w)) return false;
  solve_for_accelerations(at, a);
  return true;
}

bool Manifold::land(double t, std::span<double> q, std::span<double> v, std::span<double> a) {
  evaluate({t, q, v});
  if (rows_.holonomic > 0) {
    if (!kkt_.factorise(e_.w)) return false;
    solve_for_position_step(q.size());
    for (std::size_t k = 0; k < q.size(); ++k) q[k] += x_[k];
    evaluate({t, q, v});
  }
  if (!kkt_.factorise(e_.w)) return false;
  correct_velocities(v);
  if (!system_->damping_pattern().empty()) evaluate({t, q, v});
  solve_for_accelerations({t, q, v}, a);
  return true;
}

bool Manifold::solve_motion(double t, std::span<const double> q, std::span<double> v, std::span<double> a,
                            std::span<double> lambda) {
  const std::size_t n = q.size();
  evaluate({t, q, v});
  if (!kkt_.factorise(e_.w)) return false;
  if (!rows_.rows.empty()) {
    correct_velocities(v);
    evaluate({t, q, v});
  }
  solve_for_accelerations({t, q, v}, a);
  std::ranges::fill(lambda, 0.0);
  for (std::size_t r = 0; r < rows_.rows.size(); ++r)
    lambda[static_cast<std::size_t>(rows_.rows[r])] = x_[n + r];
  const bool finite = std::ranges::all_of(x_, [](double x) { return std::isfinite(x); });
  if (finite && minimum_norm_.needed()) {
    minimum_norm_.spread([this](std::span<double> x) { kkt_.solve(x); }, e_.w, lambda);
  }
  return finite;
}

}  // namespace dalembert
