#pragma once

#include <dalembert/models/plane_pendulum.h>

#include <array>
#include <cmath>

namespace dalembert::bench {

/// The plane pendulum in its angle p from the downward vertical, y = (p, p'). Newton's law across the rod
/// and along it:
///
///   l p'' = -g sin p        tension = m (l p'^2 + g cos p)
class PlanePendulumEquation {
 public:
  explicit PlanePendulumEquation(const models::PlanePendulum& pendulum) : p_(pendulum) {}

  [[nodiscard]] std::array<double, 2> start() const { return {p_.amplitude, 0.0}; }
  void operator()(const std::array<double, 2>& y, std::array<double, 2>& y_rate) const {
    y_rate = {y[1], -p_.gravity / p_.length * std::sin(y[0])};
  }
  [[nodiscard]] models::Observation<2> observation(const std::array<double, 2>& y) const {
    const double sine = std::sin(y[0]), cosine = std::cos(y[0]);
    return {.positions = {p_.length * Vec<2>(sine, -cosine)},
            .forces = {p_.mass * (p_.length * y[1] * y[1] + p_.gravity * cosine)}};
  }

 private:
  models::PlanePendulum p_;
};

}  // namespace dalembert::bench
