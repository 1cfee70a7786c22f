#include "scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace dalembert::start_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

TEST(Start, AnEmptySceneIsAnError) {
  const Scene<2> scene("nothing");
  EXPECT_THAT(
      [&] { (void)simulate(scene, {.t_end = 1.0}); },
      ThrowsMessage<InvalidScene>(AllOf(HasSubstr("\"nothing\" is empty"), HasSubstr("add at least one"))));
}

TEST(Start, APositionOffAConstraintIsAnError) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.25, 0.0}});
  scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");
  EXPECT_THAT(
      [&] { (void)simulate(scene, {.t_end = 1.0}); },
      ThrowsMessage<InconsistentStart>(AllOf(HasSubstr("Distance \"rod\""), HasSubstr("initial positions"),
                                             HasSubstr("distance of 0.25"), HasSubstr("assemble"))));
}

TEST(Start, WhatIsWrongIsSaidAlsoAsTheEquationHasIt) {
  Scene<2> scene;
  const auto a = scene.add_particle({.mass = 1.0}),
             b = scene.add_particle({.mass = 1.0, .position = {6.0, 0.0}});
  scene.add(Distance{a, b, 600.0}, "rope");  // each end is as near to it as 594 m over the root of 2
  EXPECT_THAT(
      [&] { (void)simulate(scene, {.t_end = 1.0}); },
      ThrowsMessage<InconsistentStart>(AllOf(HasSubstr("Distance \"rope\""), HasSubstr("distance of 420.02"),
                                             HasSubstr("its equation gives -594"))));
}

TEST(Start, AVelocityAgainstAConstraintIsAnError) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}, .velocity = {0.5, 1.0}});
  scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");
  EXPECT_THAT(
      [&] { (void)simulate(scene, {.t_end = 1.0}); },
      ThrowsMessage<InconsistentStart>(AllOf(HasSubstr("Distance \"rod\""), HasSubstr("initial velocities"),
                                             HasSubstr("speed of 0.5"), HasSubstr("assemble"))));
}

TEST(Start, AVelocityAgainstANonholonomicConstraintIsAnError) {
  Scene<2> scene;
  const auto skate = scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.5}});
  scene.add(nonholonomic(points(skate), [](auto, auto v) { return v.y(); }), "blade");
  EXPECT_THAT([&] { (void)simulate(scene, {.t_end = 1.0}); },
              ThrowsMessage<InconsistentStart>(
                  AllOf(HasSubstr("Nonholonomic \"blade\""), HasSubstr("speed of 0.5"))));
}

// The driven pivot moves at 2 along the rod; a bob at rest violates the rod by that speed.
TEST(Start, ABobThatDoesNotFollowItsDrivenPivotIsAnError) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  scene.add(Distance{driven([](auto t) { return vec(2.0 * t, 0.0); }), bob, 1.0}, "rod");
  EXPECT_THAT(
      [&] { (void)simulate(scene, {.t_end = 1.0}); },
      ThrowsMessage<InconsistentStart>(AllOf(HasSubstr("Distance \"rod\""), HasSubstr("speed of 2"))));
}

// 1e200^2/2 is more than the largest double, though the speed itself is not.
TEST(Start, AnEnergyThatOverflowsIsAnError) {
  Scene<2> scene;
  scene.add_particle({.mass = 1.0, .velocity = {1e200, 0.0}});
  EXPECT_THAT([&] { (void)simulate(scene, {.t_end = 1.0}); },
              ThrowsMessage<InconsistentStart>(AllOf(HasSubstr("double precision"), HasSubstr("units"))));
}

// The square of the distance between them is not a number that a double holds.
TEST(Start, APositionBeyondReasonIsAnError) {
  Scene<2> scene;
  scene.add_particle({.mass = 1.0});
  const auto far = scene.add_particle({.mass = 1.0, .position = {1e200, 0.0}});
  scene.add(OnCurve{far, Plane<2>{}});
  EXPECT_THAT([&] { (void)simulate(scene, {.t_end = 1.0}); },
              ThrowsMessage<InconsistentStart>(AllOf(HasSubstr("size of this scene"), HasSubstr("units"))));
}

// A rod of 1 and one of 0.5 cannot span the gap of 2 between two fixed points.
TEST(Start, RodsThatCannotSpanTheirGapAreAnError) {
  Scene<2> scene;
  const auto joint = scene.add_particle({.mass = 1.0, .position = {1.0, 0.1}});
  scene.add(Distance{Fixed<2>{{0.0, 0.0}}, joint, 1.0}, "left rod");
  scene.add(Distance{Fixed<2>{{2.0, 0.0}}, joint, 0.5}, "right rod");
  EXPECT_THAT(
      [&] { (void)simulate(scene, {.t_end = 1.0, .assemble = true}); },
      ThrowsMessage<InconsistentStart>(AllOf(HasSubstr(" rod\" cannot be satisfied"),
                                             HasSubstr("other constraints"), HasSubstr("check lengths"))));
}

TEST(Start, WithinRoundedNumbersIsAccepted) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0, .position = {0.577350269, 0.816496581}});
  scene.add(Distance{Fixed<2>{}, bob, 1.0});
  const Simulation<2> simulation(scene, {.t_end = 1.0});
  EXPECT_NEAR(simulation.position(bob).norm(), 1.0, 4.0 * epsilon);
}

// sin(pi) in double precision is 1.2e-16: so a drive that begins at rest moves by its own round-off.
TEST(Start, RoundOffOfADriveThatBeginsAtRestIsNotHeldAgainstIt) {
  const double pi = std::acos(-1.0);
  Scene<2> scene;
  const auto hand = driven([pi](auto t) { return vec(0.1 * cos(2.0 * t + pi), 0.0 * t); });
  const auto bob = scene.add_particle({.mass = 1.0, .position = {0.9, 0.0}});
  scene.add(Distance{hand, bob, 1.0}, "rod");
  const auto run = simulate(scene, {.t_end = 1.0, .samples = 2});
  EXPECT_NEAR(run.position(bob, 1).x(), 1.0 - 0.1 * std::cos(2.0), 1e-6);  // of 0.2 at a tolerance of 1e-6
}

TEST(Start, ADriveIsKnownByWhatItAcceleratesBy) {
  const auto starts = [](double speed) {
    Scene<2> scene;
    const auto hand = driven([speed](auto t) { return vec(0.5 * t * t + speed * t, 0.0 * t); });
    const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
    scene.add(Distance{hand, bob, 1.0}, "rod");
    (void)simulate(scene, {.t_end = 0.1, .samples = 2});
  };
  starts(1e-9);  // of sqrt(a L) = 1: what is below 1e-8 counts as satisfied
  EXPECT_THAT([&] { starts(1e-7); }, ThrowsMessage<InconsistentStart>(HasSubstr("speed of 1e-07")));
}

// The row asks for a speed of twice the distance from a line, which a particle on it misses by its rounding.
TEST(Start, RoundOffOfAPositionIsNotHeldAgainstARowThatReadsIt) {
  const auto starts_at = [](double y) {
    Scene<2> scene;
    const auto p = scene.add_particle({.mass = 1.0, .position = {0.3, y}});
    scene.add(nonholonomic(points(p), [](auto r, auto v) { return v.x() - 2.0 * r.y(); }), "row");
    (void)simulate(scene, {.t_end = 0.1, .samples = 2});
  };
  starts_at(epsilon * 0.3);
  EXPECT_THAT([&] { starts_at(100.0 * epsilon); }, ThrowsMessage<InconsistentStart>(HasSubstr("\"row\"")));
}

// In such a time the bead moves by centimetres, but its place on the Earth is known to a nanometre only.
TEST(Start, RoundOffOfALargePositionIsNotHeldAgainstAShortRun) {
  constexpr double radius = 6.4e6;
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
  const auto bead =
      scene.add_particle({.mass = 1.0, .position = radius * Vec<3>(0.1, 0.7, 0.4).normalized()});
  scene.add(OnSurface{bead, Sphere<3>{.radius = radius}});
  EXPECT_NO_THROW((void)Simulation<3>(scene, {.t_end = 0.03}));
}

// Two particles of 1 and 3 kg, 4 apart, on a rod of 2: the least mass-weighted change shares the
// 2 in the inverse ratio of the masses, 1.5 and 0.5.
TEST(Assembly, MovesAHeavyParticleLess) {
  Scene<2> scene;
  const auto light = scene.add_particle({.mass = 1.0, .position = {0.0, 0.0}});
  const auto heavy = scene.add_particle({.mass = 3.0, .position = {4.0, 0.0}});
  scene.add(Distance{light, heavy, 2.0});
  const Simulation<2> simulation(scene, {.t_end = 1.0, .assemble = true});
  EXPECT_LE((simulation.position(light) - Vec<2>(1.5, 0.0)).norm(), 16.0 * epsilon * 4.0);
  EXPECT_LE((simulation.position(heavy) - Vec<2>(3.5, 0.0)).norm(), 16.0 * epsilon * 4.0);
}

// They part at 4: momenta change by equal and opposite amounts until they do not, at the common
// velocity 3 * 4 / (1 + 3). The velocities across the rod stay.
TEST(Assembly, ChangesVelocitiesByAnImpulseAlongTheRod) {
  Scene<2> scene;
  const auto light = scene.add_particle({.mass = 1.0, .position = {0.0, 0.0}, .velocity = {0.0, 1.0}});
  const auto heavy = scene.add_particle({.mass = 3.0, .position = {2.0, 0.0}, .velocity = {4.0, -1.0}});
  scene.add(Distance{light, heavy, 2.0});
  const Simulation<2> simulation(scene, {.t_end = 1.0, .assemble = true});
  EXPECT_LE((simulation.velocity(light) - Vec<2>(3.0, 1.0)).norm(), 16.0 * epsilon * 4.0);
  EXPECT_LE((simulation.velocity(heavy) - Vec<2>(3.0, -1.0)).norm(), 16.0 * epsilon * 4.0);
}

TEST(Assembly, LeavesAConsistentStartAlone) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}, .velocity = {0.0, 2.0}});
  scene.add(Distance{Fixed<2>{}, bob, 1.0});
  const Simulation<2> simulation(scene, {.t_end = 1.0, .assemble = true});
  EXPECT_EQ(simulation.position(bob), Vec<2>(1.0, 0.0));
  EXPECT_EQ(simulation.velocity(bob), Vec<2>(0.0, 2.0));
}

// A bob at rest on a pivot that moves at 2 along the rod is taken along.
TEST(Assembly, FollowsADrivenPivot) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.1, 0.0}, .velocity = {0.0, 0.5}});
  scene.add(Distance{driven([](auto t) { return vec(2.0 * t, 0.0); }), bob, 1.0});
  const Simulation<2> simulation(scene, {.t_end = 1.0, .assemble = true});
  EXPECT_LE((simulation.position(bob) - Vec<2>(1.0, 0.0)).norm(), 16.0 * epsilon);
  EXPECT_LE((simulation.velocity(bob) - Vec<2>(2.0, 0.5)).norm(), 16.0 * epsilon * 2.0);
}

// A square with both diagonals, two of its nodes held: nothing can move, and of any speeds only round-off is
// left, in which no equations agree with each other.
TEST(Start, FrameThatCannotMoveIsPutToRest) {
  for (const double speed : {0.0, 1e-9, 1.0, 1e12}) {
    Scene<2> scene;
    const Vec<2> centre(0.3, -0.7);
    const std::array<Vec<2>, 4> r{centre + Vec<2>(1.0, 0.0), centre + Vec<2>(0.0, 1.0),
                                  centre - Vec<2>(1.0, 0.0), centre - Vec<2>(0.0, 1.0)};
    std::vector<Particle<2>> node;
    for (const auto& at : r)
      node.push_back(
          scene.add_particle({.mass = 1.0, .position = at, .velocity = {0.1 * speed, speed * at.x()}}));
    for (std::size_t j = 1; j < node.size(); ++j)
      for (std::size_t i = 0; i < j; ++i) scene.add(Distance{node[i], node[j], (r[j] - r[i]).norm()});
    for (std::size_t i = 0; i < 2; ++i) scene.add(Coincident{Fixed<2>{r[i]}, node[i]});
    const auto run = simulate(scene, {.t_end = 1.0, .samples = 2, .assemble = true});
    EXPECT_EQ(run.statistics().degrees_of_freedom, 0);
    EXPECT_LE((run.position(node[2], 1) - r[2]).norm(), 100.0 * epsilon * std::max(speed, 1.0));
  }
}

// The same with driven nodes: all move alike, and nothing that the speeds make is left in the accelerations.
TEST(Start, DrivenFrameFollowsItsDrive) {
  Scene<2> scene;
  const std::array<Vec<2>, 5> r{Vec<2>(1.0, 0.1), {0.4, 1.2}, {-0.7, 0.8}, {-0.9, -0.6}, {0.3, -1.1}};
  std::vector<Particle<2>> node;
  for (const auto& at : r) node.push_back(scene.add_particle({.mass = 1.0, .position = at}));
  for (std::size_t j = 1; j < node.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) scene.add(Distance{node[i], node[j], (r[j] - r[i]).norm()});
  for (std::size_t i = 0; i < 2; ++i) {
    scene.add(Coincident{driven([at = r[i]](auto t) {
                           using std::sin;
                           return vec(at.x() + 0.3 * sin(7.0 * t), at.y() - 0.2 * sin(7.0 * t));
                         }),
                         node[i]});
  }
  const auto run = simulate(scene, {.t_end = 1.0, .samples = 2, .tolerance = 1e-8, .assemble = true});
  const Vec<2> moved(0.3 * std::sin(7.0), -0.2 * std::sin(7.0));
  EXPECT_LE((run.position(node[3], 1) - r[3] - moved).norm(), 100.0 * epsilon);
}

/// A four-bar linkage with equal opposite sides of 1 and 2, stretched out: a parallelogram and its opposite
/// branch meet there, with (t - u)(3 t + u) = 0 for the rates t, u of the two cranks.
Scene<2> stretched_out(double t, double u) {
  Scene<2> scene("stretched out");
  scene.add(UniformGravity<2>{{0.0, -1.0}});
  const auto a = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}, .velocity = {0.0, t}}, "a");
  const auto b = scene.add_particle({.mass = 1.0, .position = {3.0, 0.0}, .velocity = {0.0, u}}, "b");
  scene.add(Distance{Fixed<2>{{0.0, 0.0}}, a, 1.0}, "crank");
  scene.add(Distance{a, b, 2.0}, "coupler");
  scene.add(Distance{Fixed<2>{{2.0, 0.0}}, b, 1.0}, "rocker");
  return scene;
}

TEST(Start, SingularPositionIsAnErrorThatSaysSo) {
  using Rates = std::array<double, 2>;
  for (const Rates& rates : {Rates{1.0, 1.0}, Rates{1.0, -3.0}, Rates{1.0, -1.0}, Rates{0.0, 0.0}}) {
    const Scene<2> scene = stretched_out(rates[0], rates[1]);
    for (const Stepper stepper : {Stepper::ida, Stepper::erk})
      EXPECT_THAT([&] { (void)simulate(scene, {.t_end = 1.0, .stepper = stepper}); },
                  ThrowsMessage<InconsistentStart>(AllOf(
                      HasSubstr("singular position"), HasSubstr("Distance"), HasSubstr("start beside it"))))
          << rates[0] << ' ' << rates[1];
  }
}

TEST(Start, RootThatIsZeroIsSaidToHavePerhapsNoDerivativeByTime) {
  Scene<2> scene;
  const auto bead = scene.add_particle({.mass = 1.0}, "bead");
  scene.add(holonomic(points(bead), [](auto t, auto r) { return r.x() - sqrt(t * t * t * t * t); }), "drive");
  EXPECT_THAT([&] { (void)simulate(scene, {.t_end = 1.0}); },
              ThrowsMessage<InconsistentStart>(HasSubstr("no derivative by time")));
}

TEST(Start, RedundantConstraintsAreNoSingularPosition) {
  // A parallelogram with a third crank, and a rod twice: they depend on the others wherever it is.
  Scene<2> scene("three cranks");
  scene.add(UniformGravity<2>{{0.0, -1.0}});
  const auto joint = [&](double x) {
    return scene.add_particle({.mass = 1.0, .position = {x + 0.6, 0.8}, .velocity = {0.8, -0.6}});
  };
  const auto a = joint(0.0), b = joint(2.0), c = joint(5.0);
  for (const double x : {0.0, 2.0, 5.0})
    scene.add(Distance{Fixed<2>{{x, 0.0}}, x == 0.0 ? a : x == 2.0 ? b : c, 1.0});
  scene.add(Distance{a, b, 2.0});
  scene.add(Distance{b, c, 3.0});
  scene.add(Distance{a, c, 5.0});
  scene.add(Distance{a, b, 2.0});
  EXPECT_EQ(simulate(scene, {.t_end = 1.0}).statistics().degrees_of_freedom, 1);
}

}  // namespace
}  // namespace dalembert::start_test
