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

}  // namespace
}  // namespace dalembert::floquet_periods_test
