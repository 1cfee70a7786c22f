#include "dalembert/core/scene/scene.h"

#include <dalembert/constraints/distance.h>
#include <dalembert/constraints/holonomic.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dalembert::scene_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Property;
using testing::ThrowsMessage;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Scene, RefusesAMassThatIsNotFiniteAndPositive) {
  for (const double mass : {0.0, -1.0, nan, infinity, -infinity}) {
    Scene<2> scene;
    EXPECT_THAT([&] { scene.add_particle({.mass = mass}, "bob"); },
                ThrowsMessage<InvalidScene>(AllOf(HasSubstr("\"bob\""), HasSubstr("mass = "),
                                                  HasSubstr("> 0"), HasSubstr("use Fixed"))))
        << mass;
  }
}

TEST(Scene, RefusesAPositionThatIsNotFinite) {
  for (const double x : {nan, infinity, -infinity}) {
    Scene<3> scene;
    EXPECT_THAT(
        [&] {
          scene.add_particle({.mass = 1.0, .position = {0.0, x, 0.0}}, "bob");
        },
        ThrowsMessage<InvalidScene>(
            AllOf(HasSubstr("\"bob\""), HasSubstr("position = (0, "), HasSubstr("must be finite"))));
  }
}

TEST(Scene, RefusesAVelocityThatIsNotFinite) {
  for (const double x : {nan, infinity, -infinity}) {
    Scene<2> scene;
    EXPECT_THAT(
        [&] {
          scene.add_particle({.mass = 1.0, .position = {0.0, 0.0}, .velocity = {x, 1.0}}, "bob");
        },
        ThrowsMessage<InvalidScene>(
            AllOf(HasSubstr("\"bob\""), HasSubstr("velocity = ("), HasSubstr("must be finite"))));
  }
}

TEST(Scene, RefusesGravityThatIsNotFinite) {
  Scene<2> scene;
  EXPECT_THAT(
      [&] {
        scene.add(UniformGravity<2>{{0.0, nan}});
      },
      ThrowsMessage<InvalidScene>(AllOf(HasSubstr("UniformGravity"), HasSubstr("must be finite"))));
}

TEST(Scene, RefusesAHandleThatWasNeverAdded) {
  Scene<2> scene("mine");
  const Particle<2> unknown;
  EXPECT_THAT(
      [&] {
        scene.add(Distance{Fixed<2>{}, unknown, 1.0}, "rod");
      },
      ThrowsMessage<InvalidArgument>(
          AllOf(HasSubstr("Distance \"rod\""), HasSubstr("never added"), HasSubstr("scene \"mine\""))));
}

TEST(Scene, RefusesAHandleOfAnotherScene) {
  Scene<2> scene("mine"), other;
  const auto foreign = other.add_particle({.mass = 1.0});
  EXPECT_THAT(
      [&] {
        scene.add(Distance{Fixed<2>{}, foreign, 1.0}, "rod");
      },
      ThrowsMessage<InvalidArgument>(
          AllOf(HasSubstr("Distance \"rod\""), HasSubstr("another scene"), HasSubstr("add_particle"))));
  EXPECT_THAT(
      [&] {
        scene.add(Spring{Fixed<2>{}, foreign, 1.0}, "spiral");
      },
      ThrowsMessage<InvalidArgument>(AllOf(HasSubstr("Spring \"spiral\""), HasSubstr("another scene"))));
}

TEST(Scene, RefusesAFixedPointThatIsNotFinite) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0});
  EXPECT_THAT(
      [&] {
        scene.add(Distance{Fixed<2>{{nan, 0.0}}, bob, 1.0}, "rod");
      },
      ThrowsMessage<InvalidScene>(AllOf(HasSubstr("Distance \"rod\""), HasSubstr("fixed point (nan, 0)"))));
}

TEST(Scene, RefusesANameThatIsTaken) {
  Scene<2> scene("mine");
  const auto bob = scene.add_particle({.mass = 1.0}, "bob");
  const auto taken = ThrowsMessage<InvalidScene>(
      AllOf(HasSubstr("\"bob\""), HasSubstr("taken in scene \"mine\""), HasSubstr("must differ")));
  EXPECT_THAT([&] { scene.add_particle({.mass = 1.0}, "bob"); }, taken);
  EXPECT_THAT([&] { scene.add(Distance{Fixed<2>{}, bob, 1.0}, "bob"); }, taken);
  EXPECT_THAT([&] { scene.add(Spring{Fixed<2>{}, bob, 1.0}, "bob"); }, taken);
}

TEST(Scene, ANameOfARefusedElementCanBeUsedAgain) {
  Scene<2> scene;
  EXPECT_THROW(scene.add_particle({.mass = -1.0}, "bob"), InvalidScene);
  const auto bob = scene.add_particle({.mass = 1.0}, "bob");
  EXPECT_THROW(scene.add(Distance{Fixed<2>{}, bob, -1.0}), InvalidScene);
  EXPECT_NO_THROW(scene.add(Distance{Fixed<2>{}, bob, 1.0}));
  EXPECT_THROW(scene.add(Spring{Fixed<2>{}, Particle<2>{}, 1.0}, "spiral"), InvalidArgument);
  EXPECT_NO_THROW(scene.add(Spring{Fixed<2>{}, bob, 1.0}, "spiral"));
}

TEST(Scene, ARefusedElementLeavesNoTrace) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0});
  const std::string before = scene.system().describe();
  const double extent = scene.system().extent(0.0);
  EXPECT_THROW(scene.add(Distance{Fixed<2>{{100.0, 0.0}}, Particle<2>{}, 1.0}), InvalidArgument);
  EXPECT_THROW(scene.add(Distance{Fixed<2>{{100.0, 0.0}}, bob, -1.0}), InvalidScene);
  EXPECT_EQ(scene.system().describe(), before);
  EXPECT_EQ(scene.system().extent(0.0), extent);
}

TEST(Scene, AnAutomaticNameGivesWayToTheUsersOwn) {
  Scene<2> scene;
  scene.add_particle({.mass = 1.0}, "particle1");
  EXPECT_NO_THROW(scene.add_particle({.mass = 1.0}));
}

TEST(Scene, NamesReachTheLayout) {
  Scene<2> scene("pendulum");
  const auto bob = scene.add_particle({.mass = 2.0}, "bob");
  scene.add_particle({.mass = 1.0});
  scene.add(Distance{Fixed<2>{{1.0, 0.0}}, bob, 1.0}, "rod");
  scene.add(Distance{Fixed<2>{{0.0, 1.0}}, bob, 1.0});
  const auto system = scene.system();
  const Layout& layout = *system.layout();
  EXPECT_EQ(layout.scene, "pendulum");
  EXPECT_EQ(layout.particles[0].name, "bob");
  EXPECT_EQ(layout.particles[0].mass, 2.0);
  EXPECT_EQ(layout.particles[1].name, "particle1");
  EXPECT_EQ(layout.constraints[0].label(), "Distance \"rod\"");
  EXPECT_EQ(layout.constraints[1].label(), "Distance \"Distance1\"");
}

TEST(Scene, HandlesAreNumberedAndBelongToTheirScene) {
  Scene<3> scene;
  const auto a = scene.add_particle({.mass = 1.0});
  const auto b = scene.add_particle({.mass = 1.0});
  EXPECT_EQ(b.index, 1);
  EXPECT_EQ(b.coordinate, 3);
  EXPECT_EQ(a.scene, b.scene);
  EXPECT_NE(a, b);
  EXPECT_NE(a.scene, Scene<3>().add_particle({.mass = 1.0}).scene);
}

TEST(Scene, HandlesStayValidWhenTheSceneIsMoved) {
  Scene<2> first;
  const auto bob = first.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  Scene<2> second = std::move(first);
  EXPECT_NO_THROW(second.add(Distance{Fixed<2>{}, bob, 1.0}));
}

TEST(Scene, KeepsTheInitialState) {
  Scene<2> scene;
  scene.add_particle({.mass = 1.0, .position = {1.0, 2.0}, .velocity = {3.0, 4.0}});
  scene.add_particle({.mass = 1.0, .position = {5.0, 6.0}});
  EXPECT_THAT(scene.initial_positions(), testing::ElementsAre(1.0, 2.0, 5.0, 6.0));
  EXPECT_THAT(scene.initial_velocities(), testing::ElementsAre(3.0, 4.0, 0.0, 0.0));
}

TEST(Scene, AnEmptySceneHasNoEquations) {
  Scene<2> scene("nothing");
  EXPECT_THAT([&] { (void)scene.system(); },
              ThrowsMessage<InvalidScene>(AllOf(HasSubstr("\"nothing\" is empty"), HasSubstr("add"))));
}

TEST(Scene, GravityActsOnParticlesAddedBeforeAndAfterAndAddsUp) {
  Scene<2> scene;
  scene.add_particle({.mass = 2.0});
  scene.add(UniformGravity<2>{{0.0, -10.0}});
  scene.add(UniformGravity<2>{{1.0, 0.0}});
  scene.add_particle({.mass = 3.0});
  const auto system = scene.system();
  auto e = system.evaluation();
  system.evaluate({0.0, scene.initial_positions(), scene.initial_velocities()}, e);
  EXPECT_THAT(e.force, testing::ElementsAre(2.0, -20.0, 3.0, -30.0));
}

TEST(Scene, ExtentIsTheDiagonalOfTheBoxAroundAllPoints) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0, .position = {0.0, 0.0}});
  scene.add(Distance{Fixed<2>{{3.0, 0.0}}, bob, 3.0});
  scene.add(Spring{driven([](auto t) { return vec(t, 4.0); }), bob, 1.0});
  EXPECT_DOUBLE_EQ(scene.system().extent(0.0), 5.0);
}

// 1/t has no value at t = 0, where a run need not begin; an infinite extent would mean that every
// error is small.
TEST(Scene, APathWithoutABeginningDoesNotStretchTheExtent) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0, .position = {3.0, 0.0}});
  scene.add(Distance{driven([](auto t) { return vec(1.0 / t, 0.0); }), bob, 2.0});
  scene.add(Spring{Fixed<2>{{3.0, 4.0}}, bob, 1.0});
  EXPECT_DOUBLE_EQ(scene.system().extent(0.0), 4.0);
}

TEST(Scene, LaterChangesDoNotReachASystemMadeBefore) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  scene.add(Distance{Fixed<2>{}, bob, 1.0});
  const auto system = scene.system();
  scene.add(Distance{Fixed<2>{{1.0, 1.0}}, bob, 1.0});
  scene.add_particle({.mass = 1.0});
  EXPECT_EQ(system.rows(), 1);
  EXPECT_EQ(system.coordinates(), 2);
}

}  // namespace
}  // namespace dalembert::scene_test
