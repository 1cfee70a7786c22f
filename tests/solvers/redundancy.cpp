#include <dalembert/dalembert.h>

#include <gmock/gmock.h>

#include <cmath>

namespace dalembert::redundancy_test {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Two equal rods hold one bob at rest: each may carry any share of the weight m g = 20, the least-norm
/// forces share it equally.
class TwinRods : public testing::Test {
 protected:
  Scene<2> scene;
  Particle<2> bob;
  TwinRods() {
    scene.add(UniformGravity<2>{{0.0, -10.0}});
    bob = scene.add_particle({.mass = 2.0, .position = {0.0, -1.0}});
  }
};

TEST_F(TwinRods, ShareTheWeightAndSayThatTheirSharesAreNotUnique) {
  const auto one = scene.add(Distance{Fixed<2>{}, bob, 1.0}, "one");
  const auto two = scene.add(Distance{Fixed<2>{}, bob, 1.0}, "two");
  const auto run = simulate(scene, {.t_end = 1.0, .samples = 3});
  EXPECT_EQ(run.statistics().degrees_of_freedom, 1);
  EXPECT_EQ(run.statistics().redundant_equations, 1);
  for (std::size_t i = 0; i < run.size(); ++i) {
    EXPECT_NEAR(-run.multiplier(one, i), 10.0, 1e-13);  // a few roundings of 20
    EXPECT_NEAR(-run.multiplier(two, i), 10.0, 1e-13);
    EXPECT_FALSE(run.is_unique(one, i));
    EXPECT_FALSE(run.is_unique(two, i));
  }
}

// Equation two is 1000 g: the same force is the least, its multiplier is a thousandth.
TEST_F(TwinRods, ShareTheWeightHoweverTheirEquationsAreScaled) {
  const auto one = scene.add(Distance{Fixed<2>{}, bob, 1.0});
  const auto two = scene.add(holonomic(points(bob), [](auto r) { return 1000.0 * (r.norm() - 1.0); }));
  const Simulation<2> at(scene, {.t_end = 1.0});
  EXPECT_NEAR(at.constraint_force(one, bob).y(), 10.0, 1e-13);
  EXPECT_NEAR(at.constraint_force(two, bob).y(), 10.0, 1e-13);
}

TEST_F(TwinRods, LeaveAnotherConstraintsForceUnique) {
  const auto one = scene.add(Distance{Fixed<2>{}, bob, 1.0});
  scene.add(Distance{Fixed<2>{}, bob, 1.0});
  const auto other = scene.add_particle({.mass = 1.0, .position = {0.0, -2.0}});
  const auto below = scene.add(Distance{bob, other, 1.0});
  const Simulation<2> at(scene, {.t_end = 1.0});
  EXPECT_FALSE(at.sample().is_unique(one));
  EXPECT_TRUE(at.sample().is_unique(below));
  EXPECT_NEAR(-at.multiplier(below), 10.0, 1e-13);
}

TEST_F(TwinRods, RefuseFrictionThatReadsAShareOfTheirsNamingBoth) {
  const auto one = scene.add(Distance{Fixed<2>{}, bob, 1.0}, "one");
  const auto two = scene.add(Distance{Fixed<2>{}, bob, 1.0}, "two");
  scene.add(friction_law(one, points(bob), [](auto lambda, auto, auto v) { return (lambda * v).eval(); }),
            "rust");
  for (const auto stepper : {Stepper::ida, Stepper::erk}) {
    EXPECT_THAT([&] { (void)simulate(scene, {.t_end = 1.0, .stepper = stepper}); },
                ThrowsMessage<InconsistentStart>(AllOf(HasSubstr("FrictionLaw \"rust\""),
                                                       HasSubstr("Distance \"one\""),
                                                       HasSubstr("does not determine"))));
  }
  (void)two;
}

// Below the twin rods hangs a rod whose tension, 10, is unique: friction may read that.
TEST_F(TwinRods, LetFrictionReadAUniqueMultiplierElsewhere) {
  scene.add(Distance{Fixed<2>{}, bob, 1.0});
  scene.add(Distance{Fixed<2>{}, bob, 1.0});
  const auto other = scene.add_particle({.mass = 1.0, .position = {0.0, -2.0}});
  const auto below = scene.add(Distance{bob, other, 1.0});
  scene.add(friction_law(below, points(other),
                         [](auto lambda, auto, auto v) { return (-0.1 * abs(lambda) * v).eval(); }));
  EXPECT_NEAR(-Simulation<2>(scene, {.t_end = 1.0}).multiplier(below), 10.0, 1e-13);
}

// Rods of length 1 from (0, 0) and from (0, 0.5) cannot both hold the bob at (0, -1).
TEST_F(TwinRods, ContradictoryLengthsAreRefusedByName) {
  scene.add(Distance{Fixed<2>{}, bob, 1.0}, "one");
  scene.add(Distance{Fixed<2>{{0.0, 0.5}}, bob, 1.4}, "two");
  EXPECT_THAT([&] { (void)simulate(scene, {.t_end = 1.0}); },
              ThrowsMessage<InconsistentStart>(HasSubstr("Distance \"two\"")));
}

// The pivots coincide at t = 0 and move alike at first; in acceleration, 0 against 2, they do not.
TEST_F(TwinRods, ContradictoryAccelerationsAreRefusedByName) {
  scene.add(Distance{Fixed<2>{}, bob, 1.0}, "one");
  scene.add(Distance{driven([](auto t) { return vec(0.0, t * t); }), bob, 1.0}, "two");
  EXPECT_THAT([&] { (void)simulate(scene, {.t_end = 1.0}); },
              ThrowsMessage<InconsistentStart>(
                  AllOf(AnyOf(HasSubstr("\"one\""), HasSubstr("\"two\"")), HasSubstr("accelerations"))));
}

// The same with one of the equations in other units.
TEST_F(TwinRods, ContradictionIsRefusedWhateverTheScaleOfAnEquation) {
  for (const double scale : {1e-8, 1e8}) {
    Scene<2> scaled;
    scaled.add(UniformGravity<2>{{0.0, -10.0}});
    const auto end = scaled.add_particle({.mass = 1.0, .position = {0.0, -1.0}});
    scaled.add(Distance{Fixed<2>{}, end, 1.0}, "one");
    scaled.add(holonomic(points(driven([](auto t) { return vec(0.0, 0.5 * t * t); }), end),
                         [scale](auto pivot, auto r) { return scale * ((r - pivot).norm() - 1.0); }),
               "two");
    EXPECT_THAT([&] { (void)simulate(scaled, {.t_end = 1.0}); },
                ThrowsMessage<InconsistentStart>(HasSubstr("accelerations")))
        << scale;
  }
}

TEST(Blades, StraightAheadWithoutForcesAgreeToRoundOff) {
  // Three blades along one line let a sleigh glide straight on. No force gives their accelerations a size:
  // what they disagree by is the round-off of the speeds over the distance of the blades, far below the size
  // of the scene. A motion without forces is exact up to the tolerance.
  constexpr double speed = 1.7;
  for (const double apart : {0.3, 0.03}) {
    for (int i = 0; i < 40; ++i) {
      const double angle = 0.155 * i + 0.01;
      const Vec<2> ahead(std::cos(angle), std::sin(angle));
      Scene<2> scene;
      const auto sleigh = add_body(
          scene, BodyState<2>{.mass = 2.0, .inertia = 0.5, .angle = angle, .velocity = speed * ahead},
          "sleigh");
      const auto rear = sleigh.point({-apart, 0.0}), front = sleigh.point({apart, 0.0});
      scene.add(KnifeEdge{rear, rear, sleigh.centre()});
      scene.add(KnifeEdge{front, rear, sleigh.centre()});
      scene.add(KnifeEdge{sleigh.centre(), rear, front});
      const Options options{.t_end = 0.5, .samples = 2};
      const auto run = simulate(scene, options);
      EXPECT_NEAR((run.position(sleigh.centre(), 1) - 0.5 * speed * ahead).norm(), 0.0, options.tolerance)
          << apart << ' ' << angle;
    }
  }
}

// Alike up to t = 0.5 including all derivatives that matter, apart later: found in mid-run.
TEST_F(TwinRods, ContradictionOnTheWayStopsTheRunByName) {
  scene.add(Distance{Fixed<2>{}, bob, 1.0}, "one");
  scene.add(Distance{driven([](auto t) {
                       const auto late = t > 0.5 ? t - 0.5 : 0.0 * t;
                       return vec(0.0, late * late * late);
                     }),
                     bob, 1.0},
            "two");
  try {
    (void)simulate(scene, {.t_end = 1.0, .samples = 11});
    FAIL() << "the rods cannot both keep their length";
  } catch (const IntegrationFailure& failure) {
    EXPECT_THAT(failure.what(),
                AllOf(AnyOf(HasSubstr("\"one\""), HasSubstr("\"two\"")), HasSubstr("contradicts")));
    EXPECT_GE(failure.trajectory<2>().size(), 6U);  // t = 0, 0.1, ..., 0.5
  }
}

}  // namespace
}  // namespace dalembert::redundancy_test
