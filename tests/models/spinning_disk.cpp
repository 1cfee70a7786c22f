#include "dalembert/models/spinning_disk.h"

#include <dalembert/tests/models/newton.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dalembert::models::spinning_disk_test {
namespace {

constexpr double tolerance = 1e-8;
constexpr double upright = std::numbers::pi / 2;

/// A disk that precesses steadily.
SpinningDisk steady() {
  SpinningDisk disk;
  disk.lean = 1.2;
  disk.precession = 1.0;
  disk.spin = disk.steady_spin();
  return disk;
}

/// Cosine of the lean: height of the axis (mark - c) x (further mark - c)/r^2.
double axis_height(const SpinningDiskScene& built, const SpinningDisk& disk, const Sample<3>& sample) {
  const Vec<3> c = sample.position(built.disk.centre());
  const Vec<3> a = sample.position(built.marks[0]), b = sample.position(built.marks[1]);
  return (a - c).cross(b - c).z() / (disk.radius * disk.radius);
}

TEST(SpinningDiskReference, ForceIsMassTimesAccelerationLessGravity) {
  const SpinningDisk disk;
  for (const double t : {0.3, 1.1, 2.6}) {
    const Stencil<3> centre(disk.model(), t, 3e-3, 0);
    const Bounded<Vec<3>> Z = force_by_newton(centre, disk.mass, disk.gravity);
    const Observation<3> seen = disk.reference(t);
    // The components in the plane have directions that only the derivation knows; their sum of squares has
    // not.
    EXPECT_NEAR(Z.value.z(), seen.forces[0], Z.error);
    EXPECT_NEAR(Z.value.head<2>().norm(), std::hypot(seen.forces[1], seen.forces[2]), Z.error);
  }
}

// With e, f the directions of the two marks, T = m v^2/2 + (e'^2 + f'^2)/2 times the second moment m r^2/4.
TEST(SpinningDiskReference, ConservesEnergy) {
  const SpinningDisk d;
  const auto energy = [&d](double t) {
    const Stencil<3> centre(d.model(), t, 3e-3, 0);
    const auto v = centre.velocity();
    Bounded<double> E = models::energy(centre, d.mass, d.gravity);
    for (const std::size_t mark : {1U, 2U}) {
      const auto v_mark = Stencil<3>(d.model(), t, 3e-3, mark).velocity();
      const double speed = (v_mark.value - v.value).norm(), error = v.error + v_mark.error;
      E.value += d.mass / 8.0 * speed * speed;
      E.error += d.mass / 4.0 * error * (speed + error);
    }
    return E;
  };
  const Bounded<double> first = energy(0.1);
  for (const double t : {1.3, 2.9, 4.7}) {
    const Bounded<double> later = energy(t);
    EXPECT_NEAR(later.value, first.value, later.error + first.error) << "t = " << t;
  }
}

// The contact, a radius down the disk from the centre, is at rest; n from the two marks.
TEST(SpinningDiskReference, Rolls) {
  const SpinningDisk d;
  for (const double t : {0.3, 1.1, 2.6}) {
    const Stencil<3> centre(d.model(), t, 3e-3, 0), first(d.model(), t, 3e-3, 1),
        second(d.model(), t, 3e-3, 2);
    const Vec<3> e = (first.position() - centre.position()) / d.radius;
    const Vec<3> f = (second.position() - centre.position()) / d.radius;
    const double sine = std::hypot(e.z(), f.z());  // of the lean: z = e.z e + f.z f + n.z n
    const auto v = centre.velocity(), v_e = first.velocity(), v_f = second.velocity();
    const Vec<3> contact = v.value - (e.z() * (v_e.value - v.value) + f.z() * (v_f.value - v.value)) / sine;
    EXPECT_LT(contact.norm(), 3.0 * v.error + v_e.error + v_f.error);
  }
}

TEST(SpinningDisk, SteadyPrecessionKeepsItsLeanOnACircle) {
  const SpinningDisk disk = steady();
  const SpinningDiskScene built = disk.scene();
  const auto run = simulate(built.scene, {.t_end = 5.0, .tolerance = tolerance});
  const double path = disk.radius * std::abs(disk.spin / disk.precession);
  // r'' = Omega z x r' for a motion on a circle at the rate Omega: its middle is r + (z x r')/Omega.
  const Vec<3> middle = run.position(built.disk.centre(), 0) +
                        Vec<3>::UnitZ().cross(run.velocity(built.disk.centre(), 0)) / disk.precession;
  for (std::size_t i = 0; i < run.size(); ++i) {
    EXPECT_NEAR(run.position(built.disk.centre(), i).z(), disk.radius * std::sin(disk.lean),
                1e-5 * disk.radius);
    EXPECT_NEAR((run.position(built.disk.centre(), i) - middle).norm(), path, 1e-5 * disk.radius);
    const double weight = disk.mass * disk.gravity;
    EXPECT_NEAR(run.multiplier(built.contact, i), weight, 1e-4 * weight);
    const Vec<2> friction = run.multiplier(built.rolling, i);
    EXPECT_NEAR(friction[0], 0.0, 1e-4 * weight);
    EXPECT_NEAR(friction[1], disk.mass * disk.radius * disk.spin * disk.precession, 1e-4 * weight);
  }
}

/// Straight on at a speed of v^2 = `ratio` g r/3, tilting at the rate `push`. Linearised, with C = 2 A and
/// A + m r^2 = 5/4 m r^2, theta = pi/2 + x obeys x'' = -k x,
///
///   k = [(C + m r^2)(C/A) w3^2 - m g r]/(A + m r^2) = (4 g/(5 r)) (ratio - 1).
struct StraightOn {
  SpinningDisk disk;
  double k;
  StraightOn(double ratio, double push) {
    disk.lean = upright;
    disk.lean_rate = push;
    disk.precession = 0.0;
    disk.spin = -std::sqrt(ratio * disk.gravity / (3.0 * disk.radius));
    k = 0.8 * disk.gravity / disk.radius * (ratio - 1.0);
  }
};

/// Compares the tilt of a run with the linear solution x(t). What is left out is of third order in the tilt.
template <class Solution>
void expect_tilt(const StraightOn& s, double push, const Solution& x, double t_end, double largest) {
  const SpinningDiskScene built = s.disk.scene();
  const auto run = simulate(built.scene, {.t_end = t_end, .samples = 21, .tolerance = 1e-10});
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double tilt = -axis_height(built, s.disk, run.sample(i));  // cos(pi/2 + x) = -x + ...
    EXPECT_NEAR(tilt, push * x(run.times()[i]), 100.0 * std::pow(largest, 3) + 1e-7) << run.times()[i];
  }
}

TEST(SpinningDisk, SwaysAndRunsStraightAboveTheCriticalSpeed) {
  const double push = 1e-3;
  const StraightOn s(1.2, push);
  const double w = std::sqrt(s.k);
  expect_tilt(
      s, push, [w](double t) { return std::sin(w * t) / w; }, 10.0, push / w);
}

TEST(SpinningDisk, FallsOverBelowTheCriticalSpeed) {
  const double push = 1e-5;
  const StraightOn s(0.8, push);
  const double w = std::sqrt(-s.k);
  const double t_end = 3.0;
  expect_tilt(
      s, push, [w](double t) { return std::sinh(w * t) / w; }, t_end, push / w * std::sinh(w * t_end));
}

}  // namespace
}  // namespace dalembert::models::spinning_disk_test
