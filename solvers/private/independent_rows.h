#pragma once

#include <dalembert/core/system.h>
#include <dalembert/solvers/private/rows.h>

#include <span>

namespace dalembert {

/// A well-conditioned set of rows of W that all others depend on, by rank-revealing QR of the rows
/// scaled to unit length in the metric of M^-1. `threshold` is the distance, relative to a row's
/// length, below which a row counts as lying in the span of others.
[[nodiscard]] ActiveRows independent_rows(const System& system, std::span<const double> w, double threshold);

/// The threshold at a state that obeys its constraints to round-off: far above round-off, far below
/// what a merely skew pair of constraints shows.
inline constexpr double rank_threshold = 1e-9;

}  // namespace dalembert
