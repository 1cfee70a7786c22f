#include "counted_new.h"
#include "scenes.h"

#include <gtest/gtest.h>

#include <vector>

namespace dalembert::allocation_test {
namespace {

TEST(Allocation, IsCounted) {
  const long before = allocations();
  const std::vector<double> some(100);
  EXPECT_EQ(allocations(), before + 1);
}

TEST(Allocation, DoesNotHappenWhileStepping) {
  const EachKind each;
  Simulation<2> simulation(each.scene, {.t_end = 1.0});
  const long before = allocations();
  for (int i = 0; i < 20; ++i) simulation.step();
  EXPECT_EQ(allocations(), before);
}

TEST(Allocation, DoesNotHappenWhileAdvancing) {
  const EachKind each;
  Simulation<2> simulation(each.scene, {.t_end = 1.0});
  const long before = allocations();
  for (const double t : {0.1, 0.2, 0.5, 1.0}) simulation.advance_to(t);
  EXPECT_EQ(allocations(), before);
}

// The first steps look whether what rests begins to slide, and a step that fails, until the length of steps
// is found, throws.
class AllocationWithFriction : public testing::TestWithParam<Stepper> {};
INSTANTIATE_TEST_SUITE_P(Steppers, AllocationWithFriction, testing::Values(Stepper::ida, Stepper::erk),
                         [](const auto& tested) { return std::string(name(tested.param)); });

TEST_P(AllocationWithFriction, DoesNotHappenWhileStepping) {
  EachKind each;
  each.scene.add(friction_law(
      each.upper_rod, points(each.upper, each.bead), [](auto lambda, auto, auto, auto v_u, auto v_b) {
        return std::tuple{(-0.01 * lambda * lambda * v_u).eval(), (-0.01 * lambda * v_b).eval()};
      }));
  Simulation<2> simulation(each.scene, {.t_end = 10.0, .stepper = GetParam()});
  for (int i = 0; i < 12; ++i) simulation.step();
  const long before = allocations();
  for (int i = 0; i < 4; ++i) simulation.step();
  simulation.advance_to(simulation.time() + 0.01);
  EXPECT_EQ(allocations(), before);
}

TEST(Allocation, DoesNotHappenWhileReading) {
  const EachKind each;
  const Simulation<2> simulation(each.scene, {.t_end = 1.0});
  const long before = allocations();
  EXPECT_GT(simulation.constraint_force(each.upper).norm() + simulation.energy(), 0.0);
  EXPECT_EQ(allocations(), before);
}

// The samples of a run have their room before it begins. (Without the audit, which names at the end the worst
// element of each law that was not kept to the last bit.)
TEST(Allocation, DoesNotDependOnTheLengthOfARun) {
  const EachKind each;
  const auto during = [&](double t_end, int samples) {
    Simulation<2> simulation(each.scene, {.t_end = t_end, .samples = samples, .audit = Audited::off});
    const long before = allocations();
    (void)simulation.run();
    return allocations() - before;
  };
  EXPECT_EQ(during(0.1, 2), during(1.0, 500));
}

}  // namespace
}  // namespace dalembert::allocation_test
