#pragma once

#include "accurate_runs.h"
#include <dalembert/dalembert.h>

#include <cmath>

namespace dalembert {

/// A pendulum in polar coordinates whose rod is a constraint r = 1: lambda = -tension = -(phi'^2 + g cos
/// phi).
inline LagrangianSystem<2> polar() {
  return LagrangianSystem<2>({.position = {1.0, 1.0}, .names = {"r", "phi"}},
                             [](const auto& q, const auto& v) {
                               return 0.5 * (v[0] * v[0] + q[0] * q[0] * v[1] * v[1]) + g * q[0] * cos(q[1]);
                             });
}

struct Polar {
  LagrangianSystem<2> system = polar();
  Constraint<1> rod = system.constrain([](const auto& q) { return q[0] - 1.0; }, "rod");

  [[nodiscard]] static double tension(const LagrangianMotion<2>& motion, std::size_t i) {
    const double rate = motion.velocity(i)[1];
    return rate * rate + g * std::cos(motion.position(i)[1]);
  }
};

/// A pendulum of length 1.
inline LagrangianSystem<1> by_angle() {
  return LagrangianSystem<1>({.position = Vec<1>(1.0)},
                             [](const auto& q, const auto& v) { return 0.5 * v[0] * v[0] + g * cos(q[0]); });
}

}  // namespace dalembert
