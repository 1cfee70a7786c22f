#pragma once

#include <dalembert/models/model.h>

#include <numbers>
#include <span>
#include <vector>

namespace dalembert::models {

/// A pendulum on a pivot that moves as prescribed.
struct DrivenPendulum {
  Scene<2> scene;
  Particle<2> bob;
  Constraint<1> rod;  ///< its tension is -multiplier
};

/// Pendulum whose pivot is driven along a line or an ellipse, x = A cos(omega t), y = B cos(omega t + phase)
/// upwards (notes, mex248, mex249, mex250), released at rest relative to the pivot.
///
/// With phi from the downward vertical and (a_x, a_y) the pivot's acceleration, Newton's law for the bob
/// across and along the rod reads
///
///   l phi'' = -(g + a_y) sin phi - a_x cos phi,
///   tension = m [l phi'^2 + (g + a_y) cos phi - a_x sin phi]:
///
/// a pendulum in a gravity that varies. For the three drives of the notes,
///
///   horizontal, x = A cos:                      l phi'' = A omega^2 cos(omega t) cos phi - g sin phi
///   vertical, downwards A cos (y = -A cos):     l phi'' = -(g + A omega^2 cos omega t) sin phi
///   circular, x = A cos, y = A sin:             l phi'' = A omega^2 cos(phi - omega t) - g sin phi.
///
/// Driven vertically and fast, it stands upside down if A^2 omega^2 > 2 g l (Kapitza).
struct DrivenPivot {
  double mass = 1.0;
  double length = 1.0;  ///< l, of the rod
  double gravity = 9.81;
  double amplitude_x = 0.0;  ///< A [length]
  double amplitude_y = 0.0;  ///< B [length]
  double phase = 0.0;        ///< of the vertical motion ahead of the horizontal one [rad]
  double frequency = 10.0;   ///< omega [rad/time]
  double angle = 1.0;        ///< phi at t = 0 [rad]

  [[nodiscard]] static DrivenPivot horizontal(double amplitude = 0.1) { return {.amplitude_x = amplitude}; }
  [[nodiscard]] static DrivenPivot vertical(double amplitude = 0.1) {
    return {.amplitude_y = amplitude, .phase = std::numbers::pi};
  }
  [[nodiscard]] static DrivenPivot circular(double amplitude = 0.1) {
    return {.amplitude_x = amplitude, .amplitude_y = amplitude, .phase = -std::numbers::pi / 2};
  }

  /// Where the pivot is, for any scalar type of time.
  [[nodiscard]] auto pivot(const auto& t) const {
    using std::cos;
    return vec(amplitude_x * cos(frequency * t), amplitude_y * cos(frequency * t + phase));
  }

  [[nodiscard]] DrivenPendulum scene() const;
  [[nodiscard]] std::vector<Observation<2>> reference(std::span<const double> times) const;
  [[nodiscard]] Observation<2> reference(double t) const;
  /// Named driven-pivot-horizontal, -vertical or -circular by which amplitudes are not zero.
  [[nodiscard]] Model<2> model() const;
};

}  // namespace dalembert::models
