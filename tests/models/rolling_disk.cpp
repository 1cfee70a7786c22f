#include "dalembert/models/rolling_disk.h"

#include <dalembert/models/rolling_disk_on_slope.h>
#include <dalembert/tests/models/newton.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace dalembert::models::rolling_disk_test {
namespace {

constexpr double tolerance = 1e-8;
/// Errors of a run over a few turns: the local errors of some hundred steps, amplified at most in
/// proportion to time.
constexpr double run_error = 1e3 * tolerance;

// m a = F + Z with F in the plane of the table, Z along the heading (forces[0]) and to its left.
void expect_newton(const Model<2>& model, double mass, double turn_rate, const Vec<2>& applied) {
  for (const double t : {0.4, 1.7, 3.9}) {
    const double alpha = turn_rate * t;
    const Vec<2> e(std::cos(alpha), std::sin(alpha)), n(-e.y(), e.x());
    const Observation<2> seen = model.observations(std::array{t}).front();
    const Vec<2> Z = seen.forces[0] * e + seen.forces[1] * n;
    const auto a = Stencil(model, t, 1e-2, 0).acceleration();
    EXPECT_LT((mass * a.value - applied - Z).norm(), mass * a.error) << "t = " << t;
  }
}

TEST(RollingDiskReference, ForceIsMassTimesAcceleration) {
  const RollingDisk disk;
  expect_newton(disk.model(), disk.mass, disk.turn_rate, Vec<2>::Zero());
}

TEST(RollingDiskReference, ForceIsMassTimesAccelerationLessGravityOnASlope) {
  const RollingDiskOnSlope disk;
  expect_newton(disk.model(), disk.mass, disk.turn_rate,
                {disk.mass * disk.gravity * std::sin(disk.slope), 0.0});
}

TEST(RollingDisk, RunsOnACircleHeldByTheCentripetalForce) {
  const RollingDisk disk;
  const UprightDisk built = disk.scene();
  const auto run = simulate(built.scene, {.t_end = 10.0, .tolerance = tolerance});
  const double R = disk.radius * disk.spin_rate / disk.turn_rate;
  for (std::size_t i = 0; i < run.size(); ++i) {
    EXPECT_NEAR((run.position(built.centre, i) - Vec<2>(0.0, R)).norm(), R, run_error * R);
    const Vec<2> friction = run.multiplier(built.rolling, i);
    const double centripetal = disk.mass * disk.radius * disk.spin_rate * disk.turn_rate;
    EXPECT_NEAR(friction[0], 0.0, run_error * centripetal);
    EXPECT_NEAR(friction[1], centripetal, run_error * centripetal);
  }
}

TEST(RollingDisk, HeadingAndSpinGoOnEvenly) {
  const RollingDisk disk;
  const UprightDisk built = disk.scene();
  const auto run = simulate(built.scene, {.t_end = 10.0, .samples = 2, .tolerance = tolerance});
  EXPECT_NEAR(run.angle(built.heading, 1), disk.turn_rate * 10.0, run_error * disk.turn_rate * 10.0);
  EXPECT_NEAR(run.angle(built.spin, 1), disk.spin_rate * 10.0, run_error * disk.spin_rate * 10.0);
}

TEST(RollingDiskOnSlope, DoesNotGoDownTheSlopeOnTheAverage) {
  const RollingDiskOnSlope disk;
  const UprightDisk built = disk.scene();
  const double turn = 2.0 * std::numbers::pi / disk.turn_rate;
  const auto run = simulate(built.scene, {.t_end = 5.0 * turn, .samples = 6, .tolerance = tolerance});
  const double A = 2.0 / 3.0 * disk.gravity * std::sin(disk.slope) / disk.radius;
  const double along = disk.radius * A / (2.0 * disk.turn_rate) * turn;
  for (std::size_t i = 1; i < run.size(); ++i) {
    const Vec<2> r = run.position(built.centre, i);
    const double n = static_cast<double>(i);
    EXPECT_NEAR(r.x(), 0.0, run_error * n * along);
    EXPECT_NEAR(r.y(), n * along, run_error * n * along);
  }
}

}  // namespace
}  // namespace dalembert::models::rolling_disk_test
