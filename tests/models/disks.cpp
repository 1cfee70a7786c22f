#include "conserved.h"
#include <dalembert/models/disk_on_incline.h>
#include <dalembert/models/disk_on_rotating_track.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace dalembert::models::disks_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

TEST(DiskOnIncline, FrictionAndNormalForceAreWhatNewtonDemandsOfTheCentreAndOfTheTurning) {
  const DiskOnIncline disk{.mass = 1.3, .radius = 0.4, .inertia_ratio = 0.5, .slope = 0.7, .speed = -2.0};
  const Model<2> model = disk.model();
  const Vec<2> downhill(std::cos(0.7), -std::sin(0.7)), normal(std::sin(0.7), std::cos(0.7));
  for (const double t : {0.2, 0.9, 1.7}) {
    const Stencil<2> centre(model, t, 0.05, 0);  // a parabola: any step is exact but for rounding
    const auto [f, N] = std::array{disk.reference(t).forces[0], disk.reference(t).forces[1]};
    expect_newton<2>(centre, disk.mass, disk.gravity, f * downhill + N * normal, model.force);
    const auto a = centre.acceleration();
    // I phi'' = r f with phi'' = -s''/r
    EXPECT_NEAR(-disk.inertia_ratio * disk.mass * a.value.dot(downhill), f, disk.mass * a.error);
  }
}

TEST(DiskOnIncline, GoesTwoThirdsAsFastAsWithoutFrictionAndFeelsAThirdOfThePull) {
  const DiskOnIncline disk{.mass = 2.0, .slope = 0.5};
  const DiskOnTrack built = disk.scene();
  const Trajectory<2> run = simulate(built.scene, {.t_end = 1.0, .samples = 5, .tolerance = 1e-8});
  const double pull = 2.0 * 9.81 * std::sin(0.5), weight = 2.0 * 9.81;
  for (std::size_t i = 0; i < run.size(); ++i) {
    // Constant coefficients: only the rounding of a dozen operations.
    EXPECT_NEAR(run.multiplier(built.grip, i), -pull / 3, 20 * epsilon * weight);
    EXPECT_NEAR(run.multiplier(built.contact, i), weight * std::cos(0.5), 20 * epsilon * weight);
    EXPECT_NEAR(run.constraint_torque(built.grip, built.wheel, i), -disk.radius * pull / 3,
                20 * epsilon * weight);
    // It rolls: s + r phi stays what it was, on the velocity level to round-off, integrated to the tolerance.
    const double s = run.position(built.centre, i).dot(Vec<2>(std::cos(0.5), -std::sin(0.5)));
    EXPECT_NEAR(s + disk.radius * run.angle(built.wheel, i), 0.0,
                1e-8 * static_cast<double>(run.statistics().steps));
  }
  const double speed = run.velocity(built.centre, run.size() - 1).norm();
  const double expected = std::abs(disk.speed + 2.0 / 3.0 * 9.81 * std::sin(0.5));
  EXPECT_NEAR(speed, expected, 1e-8 * static_cast<double>(run.statistics().steps));
}

TEST(DiskOnIncline, AHoopRollsWithHalfTheFrictionlessAcceleration) {
  const DiskOnTrack built = DiskOnIncline{.inertia_ratio = 1.0, .slope = 0.5}.scene();
  const Trajectory<2> run = simulate(built.scene, {.t_end = 0.5, .samples = 2});
  EXPECT_NEAR(run.multiplier(built.grip, 1), -0.5 * 9.81 * std::sin(0.5), 20 * epsilon * 9.81);
}

TEST(DiskOnRotatingTrack, FrictionAndNormalForceAreWhatNewtonDemandsOfTheCentreAndOfTheTurning) {
  const DiskOnRotatingTrack disk{.mass = 1.3, .radius = 0.4, .inertia_ratio = 0.7, .spin = 1.2, .start = 0.9};
  const Model<2> model = disk.model();
  for (const double t : {0.3, 1.0, 2.2}) {
    const Stencil<2> centre(model, t, 1e-2, 0);
    const Vec<2> e(std::cos(disk.spin * t), std::sin(disk.spin * t)), n(-e.y(), e.x());
    const auto [f, N] = std::array{disk.reference(t).forces[0], disk.reference(t).forces[1]};
    expect_newton<2>(centre, disk.mass, 0.0, f * e + N * n, model.force);
    // I phi'' = r f with phi' = omega - q'/r, and q'' = e . a + omega^2 q.
    const double q = e.dot(centre.position());
    EXPECT_NEAR(n.dot(centre.position()), disk.radius, 4 * epsilon * q);
    const auto a = centre.acceleration();
    const double q_acceleration = e.dot(a.value) + disk.spin * disk.spin * q;
    EXPECT_NEAR(-disk.inertia_ratio * disk.mass * q_acceleration, f, disk.mass * a.error);
  }
}

TEST(DiskOnRotatingTrack, KeepsItsJacobiIntegral) {
  // T2 - T0 = (m/2)[(1 + c) q'^2 - omega^2 q^2] and a constant; by energy - omega times angular momentum,
  // with the disk's own turning c m r^2 phi', phi' = omega - q'/r.
  const DiskOnRotatingTrack disk;
  const Model<2> model = disk.model();
  const double inertia = disk.inertia_ratio * disk.mass * disk.radius * disk.radius;
  expect_constant(
      std::array{0.2, 0.9, 2.4},
      [&](double t) {
        const Stencil<2> centre(model, t, 1e-2, 0);
        const auto v = centre.velocity();
        const Vec<2> e(std::cos(disk.spin * t), std::sin(disk.spin * t));
        const double q_rate = e.dot(v.value) + disk.radius * disk.spin;
        const double turning = disk.spin - q_rate / disk.radius;
        const auto own = jacobi_integral(centre, disk.mass, 0.0, disk.spin);
        return Bounded<double>{own.value + inertia * (turning * turning / 2 - disk.spin * turning),
                               own.error + inertia * (std::abs(turning) + disk.spin) * v.error / disk.radius +
                                   inertia * v.error};
      },
      model.energy);
}

TEST(DiskOnRotatingTrack, IsHeldBackByTheTrackAtFirst) {
  // At rest relative to the track: friction -m omega^2 q0/3, normal force -m omega^2 r (mex116).
  const DiskOnRotatingTrack disk{.mass = 1.5, .radius = 0.3, .spin = 2.0, .start = 0.8};
  const DiskOnTrack built = disk.scene();
  const Trajectory<2> run = simulate(built.scene, {.t_end = 0.1, .samples = 2});
  EXPECT_NEAR(run.multiplier(built.grip, 0), -1.5 * 4.0 * 0.8 / 3, 20 * epsilon * 4.8);
  EXPECT_NEAR(run.multiplier(built.contact, 0), -1.5 * 4.0 * 0.3, 20 * epsilon * 4.8);
}

}  // namespace
}  // namespace dalembert::models::disks_test
