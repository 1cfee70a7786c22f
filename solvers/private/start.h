#pragma once

#include <dalembert/core/system.h>
#include <dalembert/solvers/options.h>
#include <dalembert/solvers/private/kkt.h>

#include <vector>

namespace dalembert {

/// The scene's own length and time, from which absolute tolerances and the first step follow, so
/// that a scene runs alike in any units.
struct Scales {
  double length;
  double time;
  std::vector<double> coordinate;  ///< of each coordinate: `length`, or 1 for an angle

  [[nodiscard]] double speed() const { return length / time; }
  /// What turns each coordinate into a length: 1, or `length` for an angle.
  [[nodiscard]] std::vector<double> lever() const;
};

/// A state that obeys the constraints at position, velocity and acceleration level.
struct Start {
  std::vector<double> q, v, a, lambda;
  ActiveRows rows;
  Scales scales;
};

/// Checks the given state against the constraints, or with options.assemble moves it onto them,
/// and finds accelerations and multipliers. Throws InconsistentStart, naming the constraint.
[[nodiscard]] Start consistent_start(const System& system, std::span<const double> q,
                                     std::span<const double> v, const Options& options);

}  // namespace dalembert
