#pragma once

#include <dalembert/core/analysis/rank.h>
#include <dalembert/solvers/base/hidden.h>

#include <span>

namespace DALEMBERT_HIDDEN dalembert {

/// w x of a row.
[[nodiscard]] inline double row_times(const System& system, std::span<const double> w, std::size_t row,
                                      std::span<const double> x) {
  double sum = 0.0;
  for (const std::size_t k : system.row(row)) sum += w[k] * x[system.w_columns()[k]];
  return sum;
}
/// x += factor w^T of a row.
inline void add_row(const System& system, std::span<const double> w, std::size_t row, double factor,
                    std::span<double> x) {
  for (const std::size_t k : system.row(row)) x[system.w_columns()[k]] += factor * w[k];
}
/// w M^-1 w^T of a row: the inverse effective mass of its multiplier.
[[nodiscard]] double inverse_effective_mass(const System& system, std::span<const double> w, std::size_t row);
/// |w| of a row; `lengths` turns each coordinate into a length: 1, or the scene's length for an angle.
[[nodiscard]] double gradient_length(const System& system, std::span<const double> w,
                                     std::span<const double> lengths, std::size_t row);
/// The least mass that a row moves: its force accelerates that one, whatever the others weigh.
[[nodiscard]] double lightest_mass(const System& system, std::span<const double> lengths, std::size_t row);
/// The impulse by which a row gives the masses it moves a speed, speed |w| / (w M^-1 w^T), whatever the
/// scale of the user's equation.
[[nodiscard]] double impulse_of_row(const System& system, std::span<const double> w,
                                    std::span<const double> lengths, std::size_t row, double speed);

}  // namespace dalembert
