#include "dalembert/models/pendulum_rotation.h"

#include "hanging.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace dalembert::models::pendulum_rotation_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

TEST(PendulumRotation, KeepsItsEnergyAndItsTensionIsWhatNewtonDemands) {
  const PendulumRotation pendulum{.mass = 0.5, .length = 1.2, .gravity = 9.81, .energy_ratio = 1.1};
  expect_newton_and_energy(pendulum.model(), {0.5}, 9.81, std::array{0.1, 0.4, 0.9, 2.0, 6.6}, 2e-3, 1e-6);
}

TEST(PendulumRotation, IsOverTheTopAfterHalfATurnWithTheTensionThatItsEnergyLeaves) {
  const PendulumRotation pendulum;
  const double weight = pendulum.mass * pendulum.gravity;
  const Observation<2> top = pendulum.reference(pendulum.period() / 2);
  // Half the period is rounded to epsilon/2 and the bob passes at less than 7 m/s.
  EXPECT_LT((top.positions[0] - Vec<2>(0.0, pendulum.length)).norm(), 8 * epsilon);
  // 2 E/l - 5 m g with E = 2 m g l energy_ratio; largest term 6 weights.
  EXPECT_NEAR(top.forces[0], (4 * pendulum.energy_ratio - 5) * weight, 12 * epsilon * weight);
}

TEST(PendulumRotation, TurnAtHighEnergyTakesAsLongAsTheNotesExpansionSays) {
  // T = (2 pi/w)(1 + kappa^2/4), w^2 = 2 E/(m l^2) (mex147); the next term of K is (9/64) kappa^4.
  for (const double ratio : {1e2, 1e3, 1e4}) {
    const PendulumRotation pendulum{.energy_ratio = ratio};
    const double kappa2 = 1.0 / ratio;
    const double w = 2 * std::sqrt(pendulum.gravity / pendulum.length * ratio);
    const double remainder = pendulum.period() * w / (2 * std::numbers::pi) - (1 + kappa2 / 4);
    EXPECT_NEAR(remainder, 9.0 / 64 * kappa2 * kappa2, kappa2 * kappa2 * kappa2 + 8 * epsilon) << ratio;
  }
}

}  // namespace
}  // namespace dalembert::models::pendulum_rotation_test
