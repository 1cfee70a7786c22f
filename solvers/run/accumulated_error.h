#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <algorithm>
#include <cmath>

namespace DALEMBERT_HIDDEN dalembert {

/// What a step may err by, the largest of all coordinates, as lengths and speeds.
struct StepError {
  double position = 0.0, velocity = 0.0;              ///< as the method itself estimates it,
  double position_noise = 0.0, velocity_noise = 0.0;  ///< and of round-off
  double late = 0.0;  ///< by which the time at its end, rounded, is later than the step was long
};

/// What the errors of all steps add up to if each displaces the motion as it would a free mass: an error of
/// velocity goes on to displace it,
///
///   V = sum e_v,     Q = sum e_q + int V dt,
///
/// those of round-off, which have no sign, as the root of the sum of their squares. How the motion itself
/// lets differences grow or decay is not in it. Times are rounded, too, of equal steps always to the same
/// side: that shifts the motion in time.
class AccumulatedError {
 public:
  void add(const StepError& step, double h) {
    late_ += step.late;
    most_late_ = std::max(most_late_, std::abs(late_));
    velocity_ += step.velocity;
    square_of_velocity_ += step.velocity_noise * step.velocity_noise;
    position_ += step.position + velocity() * h;
    square_of_position_ += step.position_noise * step.position_noise;
    drift_ += velocity_noise() * h;
  }
  /// What an event imposes holds to the errors so far, and moves by them what it is put onto.
  void displace(double distance) { displaced_ += distance; }
  [[nodiscard]] double displaced() const { return displaced_; }
  /// Of the steps.
  [[nodiscard]] double position() const { return position_ + std::sqrt(square_of_position_); }
  [[nodiscard]] double velocity() const { return velocity_ + velocity_noise(); }
  /// What round-off adds to either.
  [[nodiscard]] double position_noise() const { return drift_ + std::sqrt(square_of_position_); }
  [[nodiscard]] double velocity_noise() const { return std::sqrt(square_of_velocity_); }
  /// By which round-off shifts the motion in time.
  [[nodiscard]] double shift() const { return most_late_; }

 private:
  double position_ = 0.0, velocity_ = 0.0;
  double square_of_position_ = 0.0, square_of_velocity_ = 0.0, drift_ = 0.0;  // of round-off
  double displaced_ = 0.0;
  double late_ = 0.0, most_late_ = 0.0;
};

}  // namespace dalembert
