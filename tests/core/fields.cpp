#include "dalembert/core/forces/fields.h"

#include "../equations.h"
#include <dalembert/core/scene/scene.h>

#include <Eigen/Core>
#include <gmock/gmock.h>

#include <limits>

namespace dalembert::fields_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A particle and a rotor in a state in which nothing is zero.
class Fields : public testing::Test {
 protected:
  Scene<2> scene;
  Particle<2> p = scene.add_particle({.mass = 2.0});
  Rotor rotor = scene.add_rotor({.inertia = 1.0});
  State state{0.3, Eigen::Vector3d(3.0, 4.0, 0.7), Eigen::Vector3d(1.5, -2.0, 0.4)};

  [[nodiscard]] Eigen::VectorXd force() const { return values(scene.system(), state).F; }
  void expect_consistent_force() const { expect_consistent(scene.system(), state, Eigen::VectorXd()); }
};

TEST_F(Fields, PointGravityPullsOnePoint) {
  scene.add(PointGravity{p, 2.0, {0.0, -9.81}});
  EXPECT_EQ(force(), Eigen::Vector3d(0.0, -19.62, 0.0));
  EXPECT_EQ(scene.system().forces().energy(state.instant()), 2.0 * 9.81 * 4.0);
}

// |v| = 2.5.
TEST_F(Fields, DragOpposesTheVelocity) {
  scene.add(LinearDrag{p, 0.5});
  EXPECT_EQ(force(), Eigen::Vector3d(-0.75, 1.0, 0.0));
  expect_consistent_force();
}
TEST_F(Fields, QuadraticDragGrowsWithTheSquareOfTheSpeed) {
  scene.add(QuadraticDrag{p, 0.5});
  EXPECT_TRUE(force().isApprox(Eigen::Vector3d(-1.875, 2.5, 0.0), 1e-15));
  expect_consistent_force();
}
TEST_F(Fields, QuadraticDragVanishesAtRestWithItsDerivatives) {
  scene.add(QuadraticDrag{p, 0.5});
  state.v.setZero();
  EXPECT_EQ(force(), Eigen::Vector3d::Zero());
  EXPECT_TRUE(derivatives(scene.system(), state, Eigen::VectorXd()).damping.isZero(0.0));
}

TEST_F(Fields, TorqueActsOnARotor) {
  scene.add(Torque{rotor, 1.25});
  EXPECT_EQ(force(), Eigen::Vector3d(0.0, 0.0, 1.25));
  EXPECT_EQ(scene.system().forces().energy(state.instant()), -1.25 * 0.7);
}

// Stretched from 4 to |(3, 4)| = 5 with stiffness 10: it pulls by 10 towards the origin.
TEST_F(Fields, AnElasticStringPullsWhenTautAndHangsWhenSlack) {
  scene.add(ElasticString{Fixed<2>{}, p, 10.0, 4.0});
  EXPECT_TRUE(force().isApprox(Eigen::Vector3d(-6.0, -8.0, 0.0), 1e-15));
  expect_consistent_force();
  state.q.head(2) = Eigen::Vector2d(1.0, 2.0);
  EXPECT_EQ(force(), Eigen::Vector3d::Zero());
  EXPECT_EQ(scene.system().forces().energy(state.instant()), 0.0);
}

TEST_F(Fields, RefuseWhatMakesNoSense) {
  EXPECT_THAT(
      [&] {
        scene.add(LinearDrag{p, -1.0}, "air");
      },
      ThrowsMessage<InvalidScene>(AllOf(HasSubstr("LinearDrag \"air\""), HasSubstr("coefficient"))));
  EXPECT_THAT(
      [&] {
        scene.add(QuadraticDrag{p, nan});
      },
      ThrowsMessage<InvalidScene>(HasSubstr("coefficient")));
  EXPECT_THAT(
      [&] {
        scene.add(PointGravity{p, -2.0, {0.0, 1.0}});
      },
      ThrowsMessage<InvalidScene>(HasSubstr("mass")));
  EXPECT_THAT([&] { scene.add(Torque{rotor, nan}); }, ThrowsMessage<InvalidScene>(HasSubstr("torque")));
  EXPECT_THAT(
      [&] {
        scene.add(ElasticString{Fixed<2>{}, p, 1.0, 0.0});
      },
      ThrowsMessage<InvalidScene>(HasSubstr("relaxed_length")));
}

}  // namespace
}  // namespace dalembert::fields_test
