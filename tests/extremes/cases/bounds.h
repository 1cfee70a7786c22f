#pragma once

#include <dalembert/models/error.h>
#include <dalembert/tests/extremes/cases/case.h>

#include <algorithm>
#include <cmath>

namespace dalembert::extremes {

inline constexpr double infinite = std::numeric_limits<double>::infinity();
inline constexpr double epsilon = std::numeric_limits<double>::epsilon();
inline constexpr double g = 9.81;
/// Of a run whose case is not about it.
inline constexpr double tolerance = 1e-8;

/// What a run may err by, in lengths of the scene, if each of its S steps errs by all that its tolerance
/// allows, each the same way, and the motion does not amplify errors: e x length in position and
/// e x length/T in velocity, T the scene's own time, which displaces the scene by as much again in every T
/// that is left,
///
///   S e (1 + t/(2 T)),
///
/// with e = `tolerance_of_a_step`. A motion that amplifies errors multiplies this by how much it does.
[[nodiscard]] inline double added_up(const Run& run, double tolerance, double own_times) {
  const double of_a_step = tolerance_of_a_step(run.stepper, tolerance);
  return static_cast<double>(run.statistics.steps) * of_a_step * (1.0 + 0.5 * own_times);
}

/// Motion and forces of a model over [0, t_end] against its hand derivation: the larger of the two errors.
template <int D>
[[nodiscard]] Run compared(const models::Model<D>& model, const Options& options) {
  const models::Measurement m = models::measure<D>(model, options);
  return {.error = std::isnan(m.error_force) ? m.error_force : std::max(m.error_position, m.error_force),
          .statistics = m.statistics};
}

/// Motion alone.
template <int D>
[[nodiscard]] Run compared_motion(const models::Model<D>& model, const Options& options) {
  const models::Measurement m = models::measure<D>(model, options);
  return {.error = m.error_position, .statistics = m.statistics};
}

/// The larger of the two, or NaN if either is.
[[nodiscard]] inline double larger(double a, double b) { return std::isnan(a) || a > b ? a : b; }

/// A run that is to be stopped in mid-run: the error is `measure(failure)`, infinite if nothing stopped it.
template <int D, class Measure>
[[nodiscard]] Run stopped(const Scene<D>& scene, const Options& options, const Measure& measure) {
  try {
    return {.error = infinite, .statistics = simulate(scene, options).statistics()};
  } catch (const IntegrationFailure& failure) {
    return ended_by(failure, measure(failure));
  }
}

/// A run that stability or double precision may not allow: if `may_be_refused` it may stop with an
/// IntegrationFailure that says `why`, which is then no error.
[[nodiscard]] Run unless_refused(const std::function<Run()>& run, bool may_be_refused, std::string_view why);

/// A stiff scene in the explicit stepper, whose steps are limited by stability: it may reach the end, or must
/// report that max_steps were reached.
[[nodiscard]] inline Run unless_too_stiff(const std::function<Run()>& run, Stepper stepper) {
  return unless_refused(run, stepper == Stepper::erk, "max_steps");
}

}  // namespace dalembert::extremes
