#include <dalembert/models/chain_over_edge.h>
#include <dalembert/tests/both_steppers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace dalembert::models::chain_on_rough_table_test {
namespace {

constexpr double tolerance = 1e-8;
/// A run errs by some tens of its tolerance.
constexpr double bound = 100.0 * tolerance;

class ChainOnRoughTable : public testing::TestWithParam<Stepper> {};
INSTANTIATE_TEST_SUITE_P(Steppers, ChainOnRoughTable, both_steppers, stepper_name);

TEST_P(ChainOnRoughTable, DoesNotStartWhereCoulombsFrictionHoldsIt) {
  // What lies on the table at first, three R before the corner, sticks: it bears what hangs. How bead and
  // bead share that is not determined, but each within its cone. The edge rises by R e^-3 from there.
  for (const double mu : {1.5, 3.0}) {
    const ChainOverEdge system{.links = 50};
    GuidedChain chain = system.scene();
    const std::vector<double> start(chain.scene.initial_positions().begin(),
                                    chain.scene.initial_positions().end());
    std::vector<Constraint<1>> rough;
    for (std::size_t i = 0; i < chain.beads.size(); ++i) {
      const Particle<2> bead = chain.beads[i];
      if (start[2 * i] > -3.0 * system.edge().radius) continue;
      rough.push_back(chain.scene.add(coulomb(chain.guides[i], Slip{bead, Plane<2>{}}, mu)));
    }
    const auto result =
        simulate(chain.scene, {.t_end = 1.0, .samples = 3, .tolerance = tolerance, .stepper = GetParam()});
    EXPECT_TRUE(result.events().empty()) << mu;
    double pulled = 0.0;
    std::size_t shared = 0;
    for (std::size_t k = 0; k < rough.size(); ++k) {
      const double friction = result.multiplier(rough[k], 2);
      const double pressing = result.multiplier(chain.guides[chain.guides.size() - rough.size() + k], 2);
      EXPECT_LE(std::abs(friction), mu * std::abs(pressing) + bound * system.mass * system.gravity) << mu;
      pulled -= friction;
      if (!result.is_unique(rough[k], 2)) ++shared;
    }
    EXPECT_GT(shared, 1U) << mu;
    for (const auto& bead : chain.beads) {
      EXPECT_LE((result.position(bead, 2) - result.position(bead, 0)).norm(), bound * system.length) << mu;
    }
    const double weight = system.mass * system.gravity;
    EXPECT_NEAR(pulled, weight * system.hanging / system.length,
                weight * system.edge().radius * std::exp(-3.0) / system.length)
        << mu;
  }
}

}  // namespace
}  // namespace dalembert::models::chain_on_rough_table_test
