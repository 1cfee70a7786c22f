#pragma once

namespace dalembert {

constexpr double g = 9.81;
constexpr double tolerance = 1e-10;
/// A run of a few seconds errs by some tens of its tolerance, and so do the times at which it gets anywhere.
constexpr double bound = 100.0 * tolerance;

}  // namespace dalembert
