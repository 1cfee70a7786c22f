#include "dalembert/models/double_pendulum.h"

#include "hanging.h"

#include <gtest/gtest.h>

#include <array>

namespace dalembert::models::double_pendulum_test {
namespace {

TEST(DoublePendulum, EndsWhereAnIndependentComputationSays) {
  // BENCHMARKS B8, 16 digits; references are good to 1e-13.
  const Observation<2> end = DoublePendulum{}.reference(5.0);
  EXPECT_LT((end.positions[0] - Vec<2>(-0.5868692098162711, -0.8096817464718008)).norm(), 1e-13);
  EXPECT_LT((end.positions[1] - Vec<2>(-1.550778469470443, -1.075912734812652)).norm(), 1e-13);
  EXPECT_NEAR(end.forces[0], 26.40483776515567, 1e-13 * 26.5);
  EXPECT_NEAR(end.forces[1], 17.84893349037244, 1e-13 * 26.5);
}

TEST(DoublePendulum, KeepsItsEnergyAndItsTensionsAreWhatNewtonDemands) {
  const DoublePendulum pendulum{.mass1 = 1.5, .mass2 = 0.6, .length1 = 1.1, .length2 = 0.7, .angle2 = 2.0};
  expect_newton_and_energy(pendulum.model(), {1.5, 0.6}, 9.81, std::array{0.1, 0.4, 0.8, 1.3, 2.9}, 2e-3,
                           1e-6);
}

}  // namespace
}  // namespace dalembert::models::double_pendulum_test
