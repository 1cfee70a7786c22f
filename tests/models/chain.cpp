#include "dalembert/models/chain.h"

#include "hanging.h"
#include <dalembert/models/double_pendulum.h>
#include <dalembert/models/plane_pendulum.h>

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace dalembert::models::chain_test {
namespace {

/// What references are good for.
constexpr double round_off = 1e-13;

void expect_last(const Observation<2>& end, const Vec<2>& last_bead, double first_rod, double bound) {
  EXPECT_LT((end.positions.back() - last_bead).norm(), bound);
  EXPECT_NEAR(end.forces.front(), first_rod, bound * 9.81);
}

TEST(Chain, TenBeadsEndWhereAnIndependentComputationSays) {
  expect_last(Chain{.beads = 10}.reference(1.0), {-0.9133122294063770, -0.1496551414188306},
              1.553412331851652, round_off);
}

TEST(Chain, HundredBeadsEndWhereAnIndependentComputationSays) {
  // At a tolerance of 1e-13 per step, for speed, over 10^4 steps. (At full precision, 3 s, it agrees to
  // 1e-15; so does the chain of 1,000 beads of the same table, in minutes.)
  const auto end = Chain{.beads = 100}.reference(std::array{1.0}, 1e-13L);
  expect_last(end.front(), {-0.9075034885152906, -0.1797636627668147}, 2.778685746938135, 1e4 * 1e-13);
}

TEST(Chain, KeepsItsEnergyAndItsTensionsAreWhatNewtonDemands) {
  const Chain chain{.beads = 5, .length = 2.0, .mass = 3.0};
  expect_newton_and_energy(chain.model(), std::vector<double>(5, 0.6), 9.81, std::array{0.1, 0.4, 0.7}, 1e-3,
                           1e-5);
}

TEST(Chain, OneBeadIsAPendulumAndTwoAreADoublePendulum) {
  const double t = 0.9;
  const Observation<2> one = Chain{.beads = 1, .length = 1.3, .mass = 0.7}.reference(t);
  const Observation<2> pendulum = PlanePendulum{.mass = 0.7, .length = 1.3}.reference(t);
  expect_last(one, pendulum.positions[0], pendulum.forces[0], round_off);

  const Observation<2> two = Chain{.beads = 2, .length = 2.0, .mass = 2.0}.reference(t);
  const Observation<2> both = DoublePendulum{}.reference(t);
  expect_last(two, both.positions[1], both.forces[0], 2 * round_off);
  EXPECT_NEAR(two.forces[1], both.forces[1], 2 * round_off * 9.81);
}

}  // namespace
}  // namespace dalembert::models::chain_test
