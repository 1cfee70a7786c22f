#include "dalembert/solvers/run/diagnosis.h"

#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/linear/rows.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace dalembert {

namespace {

/// A force of about 1 in these units turns a body around within the scene's time. Unequal masses or lengths
/// can explain hundreds.
constexpr double unexplained = 1e4;
/// Times known only to this fraction of the scene's own are worth a warning.
constexpr double too_coarse = 1e-10;

}  // namespace

std::string unbounded_multiplier(const System& system, const Scales& scales, std::span<const double> w,
                                 std::span<const double> lambda, std::span<const double> lambda_at_start) {
  const auto lengths = scales.lengths();
  double most = unexplained;
  std::optional<std::size_t> row;
  for (std::size_t r = 0; r < lambda.size(); ++r) {
    const double unit = impulse_of_row(system, w, lengths, r, scales.speed()) / scales.time;
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

std::string coarse_time(const Scales& scales, double time) {
  const double resolution = epsilon * std::abs(time);
  if (resolution <= too_coarse * scales.time) return {};
  std::ostringstream what;
  what << "double precision resolves times here only to " << resolution
       << ": choose t_start and t_end closer to 0";
  return what.str();
}

}  // namespace dalembert
