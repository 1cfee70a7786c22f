#include "dalembert/solvers/linear/rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dalembert {

double inverse_effective_mass(const System& system, std::span<const double> w, std::size_t row) {
  double sum = 0.0;
  for (const std::size_t k : system.row(row)) {
    sum += w[k] * w[k] / system.masses()[system.w_columns()[k]];
  }
  return sum;
}

double gradient_length(const System& system, std::span<const double> w, std::span<const double> lengths,
                       std::size_t row) {
  double square = 0.0;
  for (const std::size_t k : system.row(row)) {
    const double slope = w[k] / lengths[system.w_columns()[k]];
    square += slope * slope;
  }
  return std::sqrt(square);
}

double lightest_mass(const System& system, std::span<const double> lengths, std::size_t row) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t k : system.row(row)) {
    const std::size_t i = system.w_columns()[k];
    least = std::min(least, system.masses()[i] / (lengths[i] * lengths[i]));
  }
  return least;
}

double impulse_of_row(const System& system, std::span<const double> w, std::span<const double> lengths,
                      std::size_t row, double speed) {
  return speed * gradient_length(system, w, lengths, row) / inverse_effective_mass(system, w, row);
}

}  // namespace dalembert
