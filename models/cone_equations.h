#pragma once

#include <dalembert/models/cone.h>

#include <array>
#include <cmath>

namespace dalembert::models {

/// ConeSlide's equations of motion in a real type, for its reference and, in double precision, to be
/// timed. The state is (r, r', phi).
template <class T>
class ConeEquations {
 public:
  explicit ConeEquations(const ConeSlide& cone)
      : mass_(cone.mass),
        gravity_(cone.gravity),
        start_(cone.start_radius),
        sine_(std::sin(T(cone.half_angle))),
        cosine_(std::cos(T(cone.half_angle))),
        h_(cone.start_radius * cone.speed_ratio * std::sqrt(T(cone.gravity) * cone.start_radius)) {}

  [[nodiscard]] std::array<T, 3> start() const { return {start_, 0, 0}; }
  void operator()(const auto& y, auto& y_rate) const {
    const T r = y[0], rate = h_ / (r * r);
    y_rate[0] = y[1];
    y_rate[1] = sine_ * (sine_ * h_ * rate / r - gravity_ * cosine_);
    y_rate[2] = rate;
  }
  [[nodiscard]] Observation<3> observation(const auto& y) const {
    const T r = y[0], phi = y[2];
    const VecOf<T, 3> position(r * std::cos(phi), r * std::sin(phi), r * cosine_ / sine_);
    const T normal_force = mass_ * (gravity_ * sine_ + h_ * h_ / (r * r * r) * cosine_);
    return {.positions = {position.template cast<double>()}, .forces = {static_cast<double>(normal_force)}};
  }

 private:
  T mass_, gravity_, start_;
  T sine_, cosine_;  // of the half angle
  T h_;              // r^2 phi'
};

}  // namespace dalembert::models
