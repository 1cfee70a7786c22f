#pragma once

namespace dalembert {

constexpr double g = 9.81;
constexpr double usual_tolerance = 1e-10;

/// The tolerance of the runs of the test at hand; WithEvents sets it.
inline double tolerance = usual_tolerance;
/// A run of a few seconds errs by some tens of its tolerance, and so do the times at which it gets anywhere.
inline double bound = 100.0 * tolerance;

}  // namespace dalembert
