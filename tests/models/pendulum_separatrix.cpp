#include "dalembert/models/pendulum_separatrix.h"

#include "hanging.h"
#include <dalembert/models/error.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace dalembert::models::pendulum_separatrix_test {
namespace {

TEST(PendulumSeparatrix, KeepsItsEnergyAndItsTensionIsWhatNewtonDemands) {
  const PendulumSeparatrix pendulum{.mass = 2.0, .length = 0.8, .gravity = 9.81};
  expect_newton_and_energy(pendulum.model(), {2.0}, 9.81, std::array{0.1, 0.3, 0.5, 1.0, 1.7}, 5e-3, 1e-7);
}

TEST(PendulumSeparatrix, CreepsUpToTheTopWhereTheRodCarriesTheWeight) {
  const PendulumSeparatrix pendulum;
  const double omega0 = std::sqrt(pendulum.gravity / pendulum.length);
  const Observation<2> late = pendulum.reference(20.0);
  // sech is 2 exp(-omega0 t) = 1e-27 there.
  EXPECT_LT((late.positions[0] - Vec<2>(0.0, pendulum.length)).norm(), 4 * std::exp(-omega0 * 20.0) + 1e-16);
  EXPECT_DOUBLE_EQ(late.forces[0], -pendulum.mass * pendulum.gravity);
}

TEST(PendulumSeparatrix, TensionOfARunChangesSignWhereCoshIsRootSixAndIsRightOnBothSides) {
  const PendulumSeparatrix pendulum;
  const double omega0 = std::sqrt(pendulum.gravity / pendulum.length);
  const double change = std::acosh(std::sqrt(6.0)) / omega0;
  const HangingRods built = pendulum.scene();
  const double tolerance = 1e-8;
  const Trajectory<2> run =
      simulate(built.scene,
               {.t_end = 1.0, .times = {change - 0.01, change, change + 0.01, 1.0}, .tolerance = tolerance});
  const auto tension = [&](std::size_t i) { return -run.multiplier(built.rods[0], i); };
  EXPECT_GT(tension(0), 0.0);
  EXPECT_LT(tension(2), 0.0);
  for (std::size_t i = 0; i < run.size(); ++i) {
    // A hundred steps, each of the tolerance, amplified by up to exp(omega0 t) = 23.
    const double bound = 100 * 23 * tolerance * pendulum.mass * pendulum.gravity;
    EXPECT_NEAR(tension(i), pendulum.reference(run.times()[i]).forces[0], bound) << run.times()[i];
  }
}

}  // namespace
}  // namespace dalembert::models::pendulum_separatrix_test
