#include "dalembert/models/pursuit.h"

#include <dalembert/tests/models/newton.h>

#include <gtest/gtest.h>

#include <cmath>

namespace dalembert::models::pursuit_test {
namespace {

constexpr double tolerance = 1e-8;

TEST(PursuitReference, VelocityPointsAtThePreyAndKeepsItsSize) {
  const PursuitCurve chase;
  for (const double t : {0.05, 0.15, 0.25}) {
    const Stencil<2> pursuer(chase.model(), t, 2e-3, 0);
    const auto v = pursuer.velocity();
    const Vec<2> sight = Vec<2>(chase.prey_speed * t, 0.0) - pursuer.position();
    EXPECT_NEAR(v.value.norm(), chase.pursuer_speed, v.error);
    EXPECT_NEAR(v.value.x() * sight.y() - v.value.y() * sight.x(), 0.0, v.error * sight.norm());
  }
}

TEST(PursuitReference, ForceIsMassTimesAccelerationToTheLeft) {
  const PursuitCurve chase;
  for (const double t : {0.05, 0.15, 0.25}) {
    const Stencil<2> pursuer(chase.model(), t, 2e-3, 0);
    const auto a = pursuer.acceleration();
    const Vec<2> v = pursuer.velocity().value, left = Vec<2>(-v.y(), v.x()).normalized();
    EXPECT_NEAR(chase.mass * a.value.dot(left), chase.reference(t).forces[0], chase.mass * a.error);
  }
}

TEST(Pursuit, SpeedStaysAndTheForceIsThatOfTheTurningLineOfSight) {
  const PursuitCurve chase;
  const Chase built = chase.scene();
  const auto run = simulate(built.scene, {.t_end = 0.9 * chase.capture_time(), .tolerance = tolerance});
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Vec<2> sight = Vec<2>(chase.prey_speed * run.times()[i], 0.0) - run.position(built.pursuer, i);
    const double rho = sight.norm(), sin_theta = -sight.y() / rho;
    const double expected = chase.mass * chase.pursuer_speed * chase.prey_speed * sin_theta / rho;
    EXPECT_NEAR(run.velocity(built.pursuer, i).norm(), chase.pursuer_speed,
                1e3 * tolerance * chase.pursuer_speed);
    EXPECT_NEAR(run.multiplier(built.aim, i), expected, 1e4 * tolerance * expected) << run.times()[i];
  }
}

TEST(Pursuit, EndsAtCaptureWithAClearStop) {
  const PursuitCurve chase;
  const Chase built = chase.scene();
  const double capture = chase.capture_time();
  try {
    (void)simulate(built.scene, {.t_end = 2.0 * capture, .samples = 2001, .tolerance = tolerance});
    FAIL() << "ran on through the prey";
  } catch (const IntegrationFailure& stop) {
    EXPECT_NEAR(stop.time(), capture, 1e-6 * capture) << stop.what();
    EXPECT_NE(std::string(stop.what()).find("caught its prey"), std::string::npos) << stop.what();
    const Trajectory<2> kept = stop.trajectory<2>();
    ASSERT_EQ(kept.size(), 1001U);  // all samples at t <= capture, but that at capture itself
    for (std::size_t i = 0; i < kept.size(); ++i) {
      EXPECT_TRUE(kept.position(built.pursuer, i).allFinite());
      EXPECT_TRUE(kept.velocity(built.pursuer, i).allFinite());
      EXPECT_TRUE(std::isfinite(kept.multiplier(built.aim, i)));
    }
  }
}

}  // namespace
}  // namespace dalembert::models::pursuit_test
