#include "dalembert/constraints/nonholonomic.h"

#include "../equations.h"
#include <dalembert/constraints/distance.h>
#include <dalembert/solvers/simulation.h>

#include <Eigen/Core>
#include <gmock/gmock.h>

namespace dalembert::nonholonomic_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// a = v_y - x v_x + t at r = (2, 3), v = (4, 5), t = 1: a = 5 - 8 + 1, W = (-2, 1),
// gamma = a_x v_x + a_t = -16 + 1.
TEST(Nonholonomic, ResidualGradientAndBiasAreThoseByHand) {
  Scene<2> scene;
  const auto p = scene.add_particle({.mass = 1.0});
  scene.add(nonholonomic(points(p), [](auto t, auto r, auto v) { return v.y() - r.x() * v.x() + t; }));
  const Values now = values(scene.system(), {1.0, Eigen::Vector2d(2.0, 3.0), Eigen::Vector2d(4.0, 5.0)});
  EXPECT_EQ(now.g.size(), 0);
  EXPECT_EQ(now.psi[0], -2.0);
  EXPECT_EQ(now.gamma[0], -15.0);
  EXPECT_EQ(now.W, Eigen::RowVector2d(-2.0, 1.0));
}

// v_y = x v_x at x = 1 with v = (2, 2): W = (-1, 1), gamma = -v_x^2 = -4. Without other forces
// v' = lambda W / m and W v' = 4, so lambda = 2 m and Z = (-4, 4) for m = 2.
TEST(Nonholonomic, ForceIsTheMultiplierTimesTheGradientInVelocities) {
  Scene<2> scene;
  const auto p = scene.add_particle({.mass = 2.0, .position = {1.0, 0.0}, .velocity = {2.0, 2.0}});
  const auto slope = scene.add(nonholonomic(points(p), [](auto r, auto v) { return v.y() - r.x() * v.x(); }));
  const Simulation<2> simulation(scene, {.t_end = 1.0});
  EXPECT_NEAR(simulation.multiplier(slope), 4.0, 16.0 * epsilon * 4.0);
  EXPECT_LE((simulation.constraint_force(slope, p) - Vec<2>(-4.0, 4.0)).norm(), 16.0 * epsilon * 8.0);
}

TEST(Nonholonomic, RefusesAnEquationThatIsNotLinearInTheVelocities) {
  Scene<2> scene;
  const auto p = scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.0}});
  scene.add(nonholonomic(points(p), [](auto, auto v) { return v.squaredNorm() - 1.0; }), "constant speed");
  EXPECT_THAT([&] { (void)simulate(scene, {.t_end = 1.0}); },
              testing::Throws<Error>(
                  testing::Property(&Error::what, AllOf(HasSubstr("Nonholonomic \"constant speed\""),
                                                        HasSubstr("not linear"), HasSubstr("d'Alembert")))));
}

TEST(Nonholonomic, AnEquationThatIsNoNumberIsNamed) {
  Scene<2> scene;
  const auto p = scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.0}});
  scene.add(nonholonomic(points(p), [](auto r, auto v) { return v.y() / r.x(); }), "blade");
  EXPECT_THAT(
      [&] { (void)simulate(scene, {.t_end = 1.0}); },
      ThrowsMessage<InconsistentStart>(AllOf(HasSubstr("Nonholonomic \"blade\""), HasSubstr("finite"))));
}

}  // namespace
}  // namespace dalembert::nonholonomic_test
