#include "dalembert/solvers/manifold/weakest_direction.h"

#include <dalembert/solvers/linear/rows.h>

#include <cmath>
#include <numeric>

namespace dalembert {

double WeakestDirection::find(SaddleMatrix& matrix, const ActiveRows& rows, std::span<const double> w) {
  // Where the smallest value matters it is far below the others, and two iterations give it to a few per
  // cent.
  constexpr int iterations = 3;
  const auto n = system_->coordinates();
  const auto m = rows.size();
  x_.assign(n + m, 0.0);
  u_.resize(m);
  for (std::size_t k = 0; k < m; ++k)
    u_[k] = 1.0 + 0.5 * std::sin(static_cast<double>(k));  // no mode's shape
  double square = 1.0;
  for (int i = 0; i < iterations; ++i) {
    const double length = std::sqrt(std::inner_product(u_.begin(), u_.end(), u_.begin(), 0.0));
    std::fill_n(x_.begin(), n, 0.0);
    for (std::size_t k = 0; k < m; ++k) {
      u_[k] /= length;
      x_[n + k] = u_[k] * std::sqrt(inverse_effective_mass(*system_, w, rows.rows[k]));
    }
    matrix.solve(x_);
    double projection = 0.0;
    for (std::size_t k = 0; k < m; ++k) {
      const double y = x_[n + k] * std::sqrt(inverse_effective_mass(*system_, w, rows.rows[k]));
      projection += y * u_[k];
      u_[k] = y;
    }
    square = 1.0 / projection;
  }
  return std::sqrt(std::abs(square));
}

}  // namespace dalembert
