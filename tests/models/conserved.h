#pragma once

#include "newton.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <span>

/// Further checks of a hand derivation against its own positions, differentiated numerically.
namespace dalembert::models {

/// Checks that the force of constraint on a point is m (a - g). The bound of the comparison must itself be
/// below 1e-6 `scale`.
template <int D>
void expect_newton(const Stencil<D>& point, double mass, double gravity, const Vec<D>& force, double scale) {
  const auto demanded = force_by_newton(point, mass, gravity);
  EXPECT_LT((force - demanded.value).norm(), demanded.error);
  EXPECT_LT(demanded.error, 1e-6 * scale);
}

/// Checks that a quantity is the same at all times, within its own bounds, which must be below 1e-6 `scale`.
inline void expect_constant(std::span<const double> times,
                            const std::function<Bounded<double>(double t)>& quantity, double scale) {
  const Bounded<double> first = quantity(times.front());
  for (const double t : times) {
    const Bounded<double> now = quantity(t);
    EXPECT_LE(std::abs(now.value - first.value), now.error + first.error) << "t = " << t;
    EXPECT_LT(now.error, 1e-6 * scale);
  }
}

/// Energy - omega times the angular momentum about the last axis, or in the plane about the origin, of one
/// point.
template <int D>
[[nodiscard]] Bounded<double> jacobi_integral(const Stencil<D>& point, double mass, double gravity,
                                              double omega) {
  const auto total = energy(point, mass, gravity);
  const auto v = point.velocity();
  const Vec<D> r = point.position();
  const double rho = std::hypot(r[0], r[1]);
  return {total.value - omega * mass * (r[0] * v.value[1] - r[1] * v.value[0]),
          total.error + std::abs(omega) * mass * rho * v.error};
}

}  // namespace dalembert::models
