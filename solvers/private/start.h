#pragma once

#include <dalembert/core/system.h>
#include <dalembert/solvers/options.h>
#include <dalembert/solvers/private/hidden.h>
#include <dalembert/solvers/private/rows.h>

#include <cmath>
#include <limits>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The scene's own length and time, from which absolute tolerances and the first step follow, so
/// that a scene runs alike in any units.
struct Scales {
  double length;
  double time;
  std::vector<double> coordinate;  ///< of each coordinate: `length`, or 1 for an angle
  std::vector<double> origin;      ///< the coordinates at the start

  [[nodiscard]] double speed() const { return length / time; }
  /// The error allowed to coordinate i at q: relative to the scene, or to how far the coordinate has
  /// come, wherever the origin lies; and never below round-off.
  [[nodiscard]] double position_error(std::size_t i, double q, double tolerance) const {
    return tolerance * (coordinate[i] + std::abs(q - origin[i])) +
           std::numeric_limits<double>::epsilon() * std::abs(q);
  }
  /// How far from its constraints round-off alone may leave a state.
  [[nodiscard]] double rounding(std::span<const double> q) const;
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

/// A start from a state on the way of a run that began with `before`, in its scales: put onto the
/// constraints, with as many rows as before, chosen anew. Throws StepFailure where they are dependent.
[[nodiscard]] Start begin_anew(const System& system, const Start& before, double t, std::span<const double> q,
                               std::span<const double> v);

}  // namespace dalembert
