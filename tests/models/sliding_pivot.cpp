#include "dalembert/models/sliding_pivot.h"

#include "conserved.h"
#include <dalembert/models/plane_pendulum.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace dalembert::models::sliding_pivot_test {
namespace {

constexpr std::array times{0.1, 0.4, 1.1, 2.7};

TEST(SlidingPivot, KeepsItsEnergyAndItsForcesAreWhatNewtonDemands) {
  const SlidingPivot pivot{.block_mass = 1.7, .bob_mass = 0.6, .length = 0.8, .angle = 2.2};
  const Model<2> model = pivot.model();
  const double h = 2e-3;
  for (const double t : times) {
    const Stencil<2> block(model, t, h, 0), bob(model, t, h, 1);
    const Observation<2> seen = pivot.reference(t);
    const Vec<2> pull = seen.forces[0] * (block.position() - bob.position()).normalized();
    expect_newton<2>(bob, pivot.bob_mass, pivot.gravity, pull, model.force);
    expect_newton<2>(block, pivot.block_mass, pivot.gravity, Vec<2>(0.0, seen.forces[1]) - pull, model.force);
  }
  expect_constant(
      times,
      [&](double t) {
        const auto of_block = energy(Stencil<2>(model, t, h, 0), pivot.block_mass, pivot.gravity);
        const auto of_bob = energy(Stencil<2>(model, t, h, 1), pivot.bob_mass, pivot.gravity);
        return Bounded<double>{of_block.value + of_bob.value, of_block.error + of_bob.error};
      },
      model.energy);
}

TEST(SlidingPivot, TurnsAsFastAsTheFirstIntegralSays) {
  // phi'^2 = (2g/L)(cos phi - cos phi0)/(1 - mu cos^2 phi), from the derivative of the bob's place on the
  // block.
  const SlidingPivot pivot{.block_mass = 1.3, .bob_mass = 0.9, .angle = 1.9};
  const double mu = 0.9 / 2.2;
  for (const double t : times) {
    const Stencil<2> block(pivot.model(), t, 2e-3, 0), bob(pivot.model(), t, 2e-3, 1);
    const double cosine = block.position().y() - bob.position().y();
    const auto v_block = block.velocity(), v_bob = bob.velocity();
    const double speed = (v_bob.value - v_block.value).norm(), error = v_block.error + v_bob.error;
    const double expected = 2 * 9.81 * (cosine - std::cos(1.9)) / (1 - mu * cosine * cosine);
    EXPECT_NEAR(speed * speed, expected, 2 * error * (speed + error)) << t;
  }
}

TEST(SlidingPivot, IsBackAtItsStartAfterAPeriod) {
  const SlidingPivot pivot{.angle = 2.5};
  const Observation<2> start = pivot.reference(0.0), back = pivot.reference(pivot.period());
  // At rest a rounding of the period counts in second order; 1e-13 is what references are good for.
  EXPECT_LT((back.positions[1] - start.positions[1]).norm(), 1e-13);
}

TEST(SlidingPivot, IsThePlanePendulumIfTheBlockIsHeavy) {
  // Forces and period differ by the order of m/M = 1e-12, over 10 radians of phase.
  const SlidingPivot pivot{.block_mass = 1e12, .bob_mass = 1.0, .angle = 1.5};
  const PlanePendulum pendulum{.amplitude = 1.5};
  for (const double t : times) {
    EXPECT_LT((pivot.reference(t).positions[1] - pendulum.reference(t).positions[0]).norm(), 1e-11);
    EXPECT_NEAR(pivot.reference(t).forces[0], pendulum.reference(t).forces[0], 1e-11 * 3 * 9.81);
  }
}

}  // namespace
}  // namespace dalembert::models::sliding_pivot_test
