#include "dalembert/solvers/run/outgrown.h"

#include <dalembert/solvers/linear/rows.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace dalembert {

namespace {

/// A body turns around within the scene's time by a force of about 1 in these units. Unequal masses or
/// lengths can explain hundreds.
constexpr double unexplained = 1e4;

}  // namespace

std::string outgrown_constraint(const System& system, const Scales& scales, std::span<const double> w,
                                std::span<const double> lambda, std::span<const double> lambda_at_start) {
  const auto lever = scales.lever();
  double most = unexplained;
  std::optional<std::size_t> row;
  for (std::size_t r = 0; r < lambda.size(); ++r) {
    const double unit = impulse_of_row(system, w, lever, r, scales.speed()) / scales.time;
    const double size = std::abs(lambda[r]) / std::max(unit, std::abs(lambda_at_start[r]));
    if (!(size > most)) continue;
    most = size;
    row = r;
  }
  if (!row) return {};
  std::ostringstream what;
  what << "the multiplier of " << system.row_label(*row) << " has grown to " << lambda[*row];
  if (const auto hint = system.singular_hint(*row); !hint.empty()) what << " (singular if " << hint << ')';
  return what.str();
}

}  // namespace dalembert
