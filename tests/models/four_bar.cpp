#include "dalembert/models/four_bar.h"

#include <dalembert/models/error.h>
#include <dalembert/tests/models/newton.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dalembert::models::four_bar_test {
namespace {

// The published benchmark, recomputed in extended precision (IFToMM A02, N = 2).
TEST(FourBarReference, IsThePublishedEndOfTheParallelogramBranch) {
  const FourBar bars;
  const Vec<2> B0(0.3284581115408154, 0.944518538178601), v(1.423051470206944, -0.494868845487043);
  EXPECT_LT((bars.reference(10.0).positions[0] - B0).norm(), 1e-13);  // digits
  const auto velocity = Stencil(bars.model(), 10.0, 2e-3, 0).velocity();
  EXPECT_LT((velocity.value - v).norm(), velocity.error);
}

// Each upright has its centre half way up, each crossbar moves with its ends.
TEST(FourBarReference, GroundForceIsMassTimesAccelerationLessGravityOfAllRods) {
  const FourBar bars;
  for (const double t : {0.5, 1.7, 4.2}) {
    const auto a = Stencil(bars.model(), t, 2e-3, 0).acceleration();
    const int N = bars.loops;
    const double moving = 0.5 * (N + 1) + N;
    const Vec<2> ground = bars.mass * (moving * a.value + (2 * N + 1) * bars.gravity * Vec<2>::UnitY());
    const Observation<2> seen = bars.reference(t);
    EXPECT_LT((ground - Vec<2>(seen.forces[0], seen.forces[1])).norm(), bars.mass * moving * a.error);
  }
}

TEST(FourBar, HasOneDegreeOfFreedom) {
  for (const int loops : {1, 2, 10}) {
    FourBar bars;
    bars.loops = loops;
    const auto run = simulate(bars.scene().scene, {.t_end = 0.1, .samples = 2});
    EXPECT_EQ(run.statistics().degrees_of_freedom, 1);
  }
}

// Before the rods first lie in line, all pins follow from Newton's and Euler's laws for single rods: a
// crossbar does not turn, so either end carries half its m (g + a_y); the torque about A_i on upright i, m
// L^2 p''/3 = m g (L/2) sin p + L (X_i cos p - Y_i sin p), gives the force X_i along the crossbars, and m a/2
// = (X_i, Y_i) - m g + ground_i that of the ground.
TEST(FourBar, PinsOnTheGroundCarryWhatNewtonSays) {
  const FourBar bars;
  const FourBarScene built = bars.scene();
  const auto run = simulate(built.scene, {.t_end = 0.35, .samples = 8, .tolerance = 1e-10});
  const double m = bars.mass, L = bars.length, g = bars.gravity, weight = m * g;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Vec<2> B = run.position(built.uprights[0].end(), i), v = run.velocity(built.uprights[0].end(), i);
    const double sine = B.x() / L, cosine = B.y() / L, rate = v.x() / (L * cosine);
    ASSERT_GT(cosine, 0.5);
    const double W2 = g / L * 7.0 / 6.0, p2 = W2 * sine;  // N = 2
    const Vec<2> a = L * (p2 * Vec<2>(cosine, -sine) - rate * rate * Vec<2>(sine, cosine));
    for (std::size_t k = 0; k < 3; ++k) {
      const double crossbars = k == 1 ? 2.0 : 1.0;
      const double Y = -crossbars * m / 2.0 * (g + a.y());
      const double X = (m * L * p2 / 3.0 - m * g * sine / 2.0 + Y * sine) / cosine;
      const Vec<2> ground = 0.5 * m * a - Vec<2>(X, Y) + Vec<2>(0.0, weight);
      EXPECT_LT((run.multiplier(built.ground_pins[k], i) - ground).norm(), 1e-6 * weight) << k << ' ' << i;
    }
  }
}

// It passes positions with all rods in line, where the constraints are dependent, about ten times. Leaving
// the branch there would be an error of order 1; staying on it, the passages magnify what the steps leave.
TEST(FourBar, StaysOnItsBranchThroughSingularPositions) {
  const Model<2> model = FourBar{}.model();
  const Measurement run = measure(model, {.t_end = model.t_end, .tolerance = 1e-8});
  EXPECT_LT(run.error_position, 1e-3);
}

// Where the rods first lie in line, at 0.714354568311 s, only the energy tells the rate of the joints, W2 as
// above. The passage begins at a sine of about 0.003, where round-off leaves accelerations to eps/sin^3 and
// so velocities to eps/sin^2; ten times that is allowed between its ends. Extrapolated there, they were off
// by 1.3e-9, and the audit stopped the run.
TEST(FourBar, VelocitiesWithinAPassageAreInterpolated) {
  const FourBar bars;
  const FourBarScene built = bars.scene();
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    const auto run = simulate(built.scene, {.t_end = 0.716,
                                            .times = {0.71335, 0.7142, 0.71435, 0.7145, 0.71535},
                                            .tolerance = 1e-12,
                                            .stepper = stepper});
    for (std::size_t i = 0; i < run.size(); ++i) {
      const Vec<2> p = run.position(built.uprights[0].end(), i), v = run.velocity(built.uprights[0].end(), i);
      const double rate = std::sqrt(bars.speed * bars.speed +
                                    2.0 * bars.gravity / bars.length * 7.0 / 6.0 * (bars.length - p.y()));
      EXPECT_LT((v - rate * Vec<2>(p.y(), -p.x())).norm() / rate, 10.0 * 2.2e-16 / (0.003 * 0.003));
    }
  }
}

// A lamp that hangs still on a spring beside it must not notice that crossings restart the scene: its force
// is good to 1000 tolerances of that which moves 1 kg by the scene's length, 4, in its time, (4/g)^(1/2).
TEST(FourBar, CrossingsLeaveSpringsAlone) {
  constexpr double tolerance = 1e-10, stiffness = 1e4, g = 9.81;
  FourBarScene built = FourBar{}.scene();
  const auto lamp = built.scene.add_particle({.mass = 1.0, .position = {-1.0, -1.0 - g / stiffness}});
  const auto spring = built.scene.add(compliant(Distance{Fixed<2>{{-1.0, 0.0}}, lamp, 1.0}, 1.0 / stiffness));
  const Trajectory<2> run = simulate(built.scene, {.t_end = 5.0, .tolerance = tolerance});
  EXPECT_GT(run.statistics().singular_positions, 0);
  EXPECT_EQ(run.statistics().advice, "");
  for (std::size_t i = 0; i < run.size(); ++i)
    EXPECT_NEAR(-run.multiplier(spring, i), g, 1000.0 * tolerance * g) << run.times()[i];
}

// The bound that the requirements set (issue "Every system of the notes", 1).
TEST(FourBar, IsAsAccurateAsRequiredAtATightTolerance) {
  const Model<2> model = FourBar{}.model();
  const Measurement run = measure(model, {.t_end = model.t_end, .tolerance = 1e-10});
  EXPECT_LT(run.error_position, 1e-5);
}

}  // namespace
}  // namespace dalembert::models::four_bar_test
