#include "dalembert/solvers/manifold/weakest_direction.h"

#include <dalembert/solvers/linear/rows.h>

#include <algorithm>
#include <cmath>

namespace dalembert {

void WeakestDirection::find(SaddleMatrix& matrix, const ActiveRows& rows, std::span<const double> w,
                            const Islands& islands) {
  // Where the smallest value matters it is far below the others, and two iterations give it to a few per
  // cent.
  constexpr int iterations = 3;
  const auto n = system_->coordinates();
  const auto m = rows.size();
  x_.assign(n + m, 0.0);
  u_.resize(m);
  for (std::size_t k = 0; k < m; ++k)
    u_[k] = 1.0 + 0.5 * std::sin(static_cast<double>(k));  // no mode's shape
  const auto D = [&](std::size_t k) { return std::sqrt(inverse_effective_mass(*system_, w, rows.rows[k])); };
  const auto island = [&](std::size_t k) { return islands.of_row(*system_, rows.rows[k]); };
  for (int i = 0; i < iterations; ++i) {
    measure(rows, islands);
    std::fill_n(x_.begin(), n, 0.0);
    for (std::size_t k = 0; k < m; ++k) x_[n + k] = D(k) * u_[k] / std::sqrt(square_[island(k)]);
    matrix.solve(x_);
    for (std::size_t k = 0; k < m; ++k) u_[k] = D(k) * x_[n + k];
  }
}

void WeakestDirection::measure(const ActiveRows& rows, const Islands& islands) {
  square_.assign(islands.count, 0.0);
  for (std::size_t k = 0; k < rows.size(); ++k)
    square_[islands.of_row(*system_, rows.rows[k])] += u_[k] * u_[k];
}

std::size_t WeakestDirection::weakest_island(const ActiveRows& rows, const Islands& islands) {
  measure(rows, islands);
  return static_cast<std::size_t>(std::ranges::max_element(square_) - square_.begin());
}

/// The last iteration made unit vectors 1/sigma^2 long.
double WeakestDirection::smallest_singular_value(SaddleMatrix& matrix, const ActiveRows& rows,
                                                 std::span<const double> w, const Islands& islands) {
  find(matrix, rows, w, islands);
  measure(rows, islands);
  double largest = 1.0;
  for (const double square : square_) largest = std::max(largest, square);
  return std::pow(largest, -0.25);
}

}  // namespace dalembert
