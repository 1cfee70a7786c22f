#include "dalembert/solvers/manifold/singular_start.h"

#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/linear/rows.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace dalembert {

namespace {

/// In the metric of the masses, of a force.
double norm(const System& system, std::span<const double> force) {
  double square = 0.0;
  for (std::size_t i = 0; i < system.coordinates(); ++i) square += force[i] * force[i] / system.masses()[i];
  return std::sqrt(square);
}

void add_row(const System& system, std::span<const double> entries, std::size_t row, double factor,
             std::span<double> force) {
  for (const std::size_t k : system.row(row)) force[system.w_columns()[k]] += factor * entries[k];
}

}  // namespace

std::optional<std::size_t> singular_row(const Problem& problem, const Start& start, double t) {
  const System& system = problem.system();
  if (start.rows.size() == system.rows_in_force()) return std::nullopt;
  const std::vector<std::size_t> active(
      start.rows.rows.begin(), start.rows.rows.begin() + static_cast<std::ptrdiff_t>(start.rows.holonomic));
  const auto& along = largest(start.v) > 0.0 ? start.v : start.a;
  auto e = system.evaluation();
  auto change = system.linearisation();
  system.evaluate({t, start.q, along}, e);
  system.linearise_constraints({t, start.q, along}, std::vector<double>(system.rows()), change);
  SaddleMatrix matrix(problem.pattern(active));
  if (!matrix.factorise({.w = e.w})) return std::nullopt;
  const std::size_t n = system.coordinates();
  // Positions are known to rank_threshold at best, and so is the residue of a sum that is 0.
  const double known = std::sqrt(rank_threshold);
  std::vector<double> x(matrix.size()), others(n);
  for (std::size_t r = 0; r < system.holonomic_rows(); ++r) {
    if (!system.in_force(r) || system.law(r).compliant() || std::ranges::find(active, r) != active.end())
      continue;
    std::ranges::fill(x, 0.0);
    add_row(system, e.w, r, 1.0, x);
    matrix.solve(x);  // u: 1 here, and the multipliers found of the others
    std::ranges::fill(others, 0.0);
    for (std::size_t j = 0; j < active.size(); ++j)
      add_row(system, change.psi_q, active[j], x[n + j], others);
    std::ranges::fill(x, 0.0);
    add_row(system, change.psi_q, r, 1.0, x);
    const double scale = std::max(norm(system, x), norm(system, others));
    for (std::size_t i = 0; i < n; ++i) x[i] += others[i];
    matrix.solve(x);
    double left = 0.0;
    for (std::size_t i = 0; i < n; ++i) left += system.masses()[i] * x[i] * x[i];
    if (std::sqrt(left) > known * scale) return r;
  }
  return std::nullopt;
}

}  // namespace dalembert
