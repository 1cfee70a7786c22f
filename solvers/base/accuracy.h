#pragma once

#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/hidden.h>

#include <cmath>

namespace DALEMBERT_HIDDEN dalembert {

/// A start that violates a constraint by less than this, relative to the scene's length or speed, is taken
/// for one that obeys it in rounded numbers, and projected silently.
inline constexpr double start_tolerance = 1e-8;

/// What Newton's iteration leaves when it has converged, relative: some fifty roundings.
inline constexpr double converged_to = 1e-14;

/// The most that a true error is of the accumulated estimate of all steps, see core/README.md.
inline constexpr double true_over_estimated = 12.0;

/// How exactly a run at a tolerance knows what. Each is a part of the scene's own unit: its length, its time,
/// its speed (see Scales), the largest force beside it.
///
/// A step errs by the tolerance in positions and velocities. Positions that err by e give an acceleration
/// over a time h with an error of e/h^2, and of h^2 by what changes meanwhile: at best of the root of e. So
/// accelerations and forces are known to the root of the tolerance.
class Accuracy {
 public:
  explicit Accuracy(double tolerance) : tolerance_(tolerance) {}

  [[nodiscard]] double of_positions() const { return tolerance_; }
  [[nodiscard]] double of_velocities() const { return tolerance_; }
  [[nodiscard]] double of_times() const { return tolerance_; }
  [[nodiscard]] double of_forces() const { return std::sqrt(tolerance_); }
  [[nodiscard]] double of_accelerations() const { return of_forces(); }

  /// A time in which forces change by no more than they are known to: its square is known as positions are.
  [[nodiscard]] double short_time() const { return std::sqrt(tolerance_); }
  /// The first step of the implicit stepper.
  [[nodiscard]] double first_implicit_step() const { return constants.first_implicit_step * short_time(); }
  /// Changes of the scene that follow each other as fast as this are not resolved.
  [[nodiscard]] double brief_change() const { return constants.brief_changes * short_time(); }
  /// The speed below which two slip velocities come to rest in the direction that they have.
  [[nodiscard]] double rest_in_space() const { return constants.rest_in_space * std::sqrt(tolerance_); }

 private:
  double tolerance_;
};

}  // namespace dalembert
