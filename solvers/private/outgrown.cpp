#include "dalembert/solvers/private/outgrown.h"

#include <cmath>
#include <sstream>

namespace dalembert {

namespace {

/// A body turns around within the scene's time by a force of about 1 in these units. Unequal masses or
/// lengths can explain hundreds.
constexpr double unexplained = 1e4;

}  // namespace

double impulse_of_row(const System& system, const Scales& scales, std::span<const double> w,
                      std::size_t row) {
  double square = 0.0;
  for (auto k = static_cast<std::size_t>(system.row_start()[row]);
       k < static_cast<std::size_t>(system.row_start()[row + 1]); ++k) {
    const auto i = static_cast<std::size_t>(system.w_columns()[k]);
    const double slope = w[k] * scales.coordinate[i] / scales.length;
    square += slope * slope;
  }
  return scales.speed() * std::sqrt(square) / mobility(system, w, row);
}

std::string outgrown_constraint(const System& system, const Scales& scales, std::span<const double> w,
                                std::span<const double> lambda) {
  double most = unexplained;
  int row = -1;
  for (std::size_t r = 0; r < lambda.size(); ++r) {
    const double size = std::abs(lambda[r]) * scales.time / impulse_of_row(system, scales, w, r);
    if (!(size > most)) continue;
    most = size;
    row = static_cast<int>(r);
  }
  if (row < 0) return {};
  std::ostringstream what;
  what << "the multiplier of " << system.row_label(row) << " has grown to "
       << lambda[static_cast<std::size_t>(row)];
  if (const auto hint = system.singular_hint(row); !hint.empty()) what << " (singular if " << hint << ')';
  return what.str();
}

}  // namespace dalembert
