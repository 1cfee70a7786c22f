#include <dalembert/dalembert.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace dalembert::floquet_periods_test {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// x'' + (1 + e f(t)) x = 0.
Scene<2> with_stiffness(auto f) {
  Scene<2> scene("sine");
  const auto x = scene.add_rotor({.inertia = 1.0});
  scene.add(potential(points(x), [f](auto t, auto phi) { return 0.5 * (1.0 + f(t)) * phi[0] * phi[0]; }));
  return scene;
}

TEST(Floquet, PartOfAPeriodIsRefused) {
  // At both ends of each of these times the stiffness is 1, and so is its slope at some.
  const auto sine = with_stiffness([](auto t) { return 0.5 * sin(2.0 * t); });
  EXPECT_THAT([&] { (void)floquet(sine, pi / 2.0); },
              ThrowsMessage<NoEquilibrium>(HasSubstr("whole period")));
  const auto harmonics = with_stiffness([](auto t) { return 0.3 * sin(2.0 * t) * sin(6.0 * t); });
  EXPECT_THROW((void)floquet(harmonics, pi / 4.0), NoEquilibrium);
  const auto cubed = with_stiffness([](auto t) { return 0.3 * sin(t) * sin(t) * sin(t); });
  EXPECT_THROW((void)floquet(cubed, pi), NoEquilibrium);
  EXPECT_NO_THROW((void)floquet(cubed, 2.0 * pi));
  // Over the whole period the trace of the map is -2.1539354435348, by Runge and Kutta's method in 8000 steps
  // outside of this library; the multipliers m are those of m^2 - trace m + 1 = 0.
  EXPECT_NEAR(floquet(sine, pi).growth(), 1.4767920253419, 1e-9);
}

TEST(Floquet, DriveOfAnotherPeriodIsRefused) {
  // The bob hangs still while its pivot does, for half of the drive's period.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {0.0, -1.0}});
  scene.add(Distance{driven([](auto t) {
                       const auto s = sin(t);
                       return vec(0.0, 1e-2 * s * s * s * (1.0 + cos(t)));
                     }),
                     bob, 1.0});
  EXPECT_THROW((void)floquet(scene, pi), NoEquilibrium);
}

TEST(Floquet, FastDecayLeavesTheOtherMultipliers) {
  // x'' + c x' + x = 0 with c = 1e4: exp(s T) with s = -1e-4 and -1e4.
  Scene<2> scene;
  const auto x = scene.add_rotor({.inertia = 1.0});
  scene.add(force_law(points(x), [](auto phi, auto v) { return vec(-phi[0] - 1e4 * v[0]); }));
  const auto found = floquet(scene, 1.0);
  const double slow = -5e3 + std::sqrt(25e6 - 1.0);
  EXPECT_NEAR(found.multipliers[0].real(), std::exp(slow), 1e-8);
  EXPECT_LE(std::abs(found.multipliers[1]), 1e-8);
}

TEST(Floquet, StiffVibrationsKeepToTheirErrors) {
  // x'' + c x' + k x = 0, twice in the plane: |exp(s T)| = exp(-c T/2). Each map errs by 1e-11 |A| h, |A|
  // being 2 omega for four numbers in the norm of the energy, and each of the three norms around it is at
  // most 2.
  constexpr double c = 0.4, T = pi;
  for (const double k : {1.0, 1e2, 1e4, 1e6}) {
    Scene<2> scene;
    const auto x = scene.add_particle({.mass = 1.0});
    scene.add(Spring{Fixed<2>{}, x, k});
    scene.add(LinearDrag{x, c});
    const auto found = floquet(scene, T);
    ASSERT_EQ(found.multipliers.size(), 4U);
    EXPECT_EQ(found.stability(), Stability::stable) << k;
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(std::abs(found.multipliers[i]), std::exp(-0.5 * c * T), found.errors[i]) << k;
      EXPECT_LE(found.errors[i], 4.0 * 1e-11 * 2.0 * std::sqrt(k) * T * 8.0) << k;
    }
  }
}

TEST(Floquet, FiftyCoordinatesConserveVolume) {
  // 25 masses in the plane on a ring of springs, held weakly, with a stiffness that vibrates: the product of
  // all multipliers is 1 (Liouville).
  Scene<2> scene;
  std::vector<Particle<2>> beads;
  for (int k = 0; k < 25; ++k) {
    const double angle = 2.0 * pi * k / 25.0;
    beads.push_back(
        scene.add_particle({.mass = 1.0, .position = {4.0 * std::cos(angle), 4.0 * std::sin(angle)}}));
  }
  for (std::size_t k = 0; k < 25; ++k) {
    const Vec<2> place(4.0 * std::cos(2.0 * pi * static_cast<double>(k) / 25.0),
                       4.0 * std::sin(2.0 * pi * static_cast<double>(k) / 25.0));
    scene.add(Spring{beads[k], beads[(k + 1) % 25], 20.0, 8.0 * std::sin(pi / 25.0)});
    scene.add(potential(points(beads[k], Fixed<2>{place}), [](auto t, auto r, auto p) {
      return 0.5 * (2.0 + 0.5 * cos(2.0 * pi * t)) * (r - p).squaredNorm();
    }));
  }
  const auto found = floquet(scene, 1.0);
  ASSERT_EQ(found.multipliers.size(), 100U);
  std::complex<double> product = 1.0;
  for (const auto& m : found.multipliers) product *= m;
  EXPECT_NEAR(std::abs(product - 1.0), 0.0, 1e-8);  // 100 factors known to 1e-10
}

/// Of a pendulum of length l that begins at rest: 2 pi over the arithmetic-geometric mean of 1 and
/// cos(angle/2), of the root of g/l.
double period_of(double amplitude, double omega) {
  double a = 1.0, b = std::cos(0.5 * amplitude);
  for (int k = 0; k < 30; ++k) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return 2.0 * pi / (omega * a);
}

TEST(Floquet, LargeVibrationIsNotUnstable) {
  // As in any natural vibration the multipliers are 1 and 1, in a Jordan block: what the map errs by moves
  // them apart by its root, and by the more the more the period changes with the amplitude.
  for (const double amplitude : {0.3, 1.0, 2.0, 2.5, 2.8, 3.0, 3.1}) {
    for (const double length : {1e-6, 1.0, 1e6}) {
      for (const double omega : {1e-3, 3.0, 1e5}) {
        Scene<2> scene("pendulum");
        scene.add(UniformGravity<2>{{0.0, -omega * omega * length}});
        const auto bob = scene.add_particle(
            {.mass = 1.0, .position = {length * std::sin(amplitude), -length * std::cos(amplitude)}});
        scene.add(Distance{Fixed<2>{}, bob, length});
        const auto found = floquet(scene, period_of(amplitude, omega));
        EXPECT_EQ(found.stability(), Stability::undecided) << amplitude << ' ' << length << ' ' << omega;
        ASSERT_EQ(found.errors.size(), 2U);
        for (std::size_t k = 0; k < 2; ++k) {
          EXPECT_LE(std::abs(found.multipliers[k] - 1.0), found.errors[k]) << amplitude;
        }
      }
    }
  }
}

TEST(Floquet, WhatFallsSlowlyInAPeriodIsUnstable) {
  // Upside down at rest: exp(+-omega T), far beyond the root of what the map is known to.
  for (const double part : {1e-3, 1e-4, 1.0}) {
    for (const double omega : {1e-3, 3.0, 1e5}) {
      Scene<2> scene("pendulum");
      scene.add(UniformGravity<2>{{0.0, -omega * omega}});
      const auto bob = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}});
      scene.add(Distance{Fixed<2>{}, bob, 1.0});
      const auto found = floquet(scene, part / omega);
      EXPECT_EQ(found.stability(), Stability::unstable) << part << ' ' << omega;
      EXPECT_NEAR(found.growth(), std::exp(part), found.errors[0]) << part << ' ' << omega;
    }
  }
}

TEST(Floquet, MotorThatTurnsRoundHasThePeriodOfATurn) {
  // A pendulum l on a crank r that a motor turns at a uniform rate, without gravity: it vibrates about the
  // radius with the rate times the root of r/l.
  constexpr double r = 0.3, l = 0.5;
  for (const double rate : {4.0, -4.0, 1e5}) {
    for (const int turns : {1, 2}) {
      Scene<2> scene("crank");
      const auto crank = add_body(scene, {.mass = 1.0, .inertia = 0.1, .angular_velocity = rate}, "crank");
      const auto hinge = add_joint(scene, Revolute{Ground<2>{}, crank, Vec<2>(0.0, 0.0)});
      const auto armature = scene.add_rotor({.inertia = 0.01, .angular_velocity = rate}, "armature");
      scene.add(AngleDrive{hinge, armature, [rate](auto t) { return rate * t; }});
      const auto bob =
          scene.add_particle({.mass = 1.0, .position = {r + l, 0.0}, .velocity = {0.0, rate * (r + l)}});
      scene.add(Distance{crank.point({r, 0.0}), bob, l});
      const double turn = 2.0 * pi / std::abs(rate);
      const auto found = floquet(scene, turns * turn);
      ASSERT_EQ(found.multipliers.size(), 2U);
      EXPECT_NEAR(found.multipliers[0].real(), std::cos(2.0 * pi * turns * std::sqrt(r / l)),
                  found.errors[0]);
      EXPECT_EQ(found.stability(), Stability::undecided);
      EXPECT_THROW((void)floquet(scene, 0.5 * turn), NoEquilibrium);
    }
  }
}

}  // namespace
}  // namespace dalembert::floquet_periods_test
