#include <dalembert/dalembert.h>
#include <dalembert/models/heavy_top.h>
#include <dalembert/models/whipple_bicycle.h>

#include <Eigen/Eigenvalues>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace dalembert::steady_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double g = 9.81;
/// Newton's iteration ends at round-off of terms of size 1 to 100, over some dozens of equations.
constexpr double rounding = 1e-11;

TEST(Steady, ConicalPendulumTurnsAtTheRateOfItsHeight) {
  // mex: cos theta = g/(l Omega^2), tension m l Omega^2; the height is kept, the speed is a rough guess.
  Scene<3> scene("conical");
  scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
  const auto bob =
      scene.add_particle({.mass = 2.0, .position = {0.6, 0.0, -0.8}, .velocity = {0.0, 2.0, 0.0}}, "bob");
  const auto rod = scene.add(Distance{Fixed<3>{}, bob, 1.0});
  const auto at =
      steady(scene, {.keep = {{"height", [=](const auto& now) { return now.position(bob).z(); }}}});
  const double Omega2 = g / 0.8;
  EXPECT_NEAR(at.sample().velocity(bob).norm(), 0.6 * std::sqrt(Omega2), rounding);
  EXPECT_NEAR(-at.sample().multiplier(rod), 2.0 * Omega2, 10 * rounding);
  const auto modes = normal_modes(scene, at);  // omega^2 = Omega^2 (1 + 3 cos^2 theta)
  EXPECT_EQ(modes.stability(), Stability::stable) << modes.describe();
  ASSERT_EQ(modes.size(), 2U);
  EXPECT_TRUE(modes.is_free(0));
  EXPECT_NEAR(modes.frequency(1), std::sqrt(Omega2 * (1.0 + 3.0 * 0.64)), 10 * rounding);
}

TEST(Steady, OfAConicalPendulumIsTheSameInAnyUnitOfLength) {
  // Nothing is kept: which of its states is found is up to the least correction, and that to no unit.
  const auto height = [](double unit) {
    Scene<3> scene("conical");
    scene.add(UniformGravity<3>{{0.0, 0.0, -g * unit}});
    const auto bob = scene.add_particle(
        {.mass = 2.0, .position = {0.6 * unit, 0.0, -0.8 * unit}, .velocity = {0.0, 2.0 * unit, 0.0}});
    scene.add(Distance{Fixed<3>{}, bob, unit});
    const auto found = steady(scene);
    return found.sample().position(bob).z() / unit;
  };
  for (const double unit : {1e-9, 1e-3, 1e6}) EXPECT_NEAR(height(unit), height(1.0), rounding) << unit;
}

/// A top that hangs and spins is stated exactly, beside a bob on a spring that must still sag, on its own:
/// what the bob takes for its way is no correction of the top. Nutation: A w^2 + C n w - m g l = 0, twice.
TEST(Steady, StaysWhereItIsBesideWhatStillSettles) {
  const double m = 1.1, l = 0.5, A = 0.05 + m * l * l, C = 0.08, n = 30.0;
  const double root = std::sqrt(C * n * C * n + 4.0 * A * m * g * l);
  for (const double k : {2e3, 2e4, 2e5}) {
    Scene<3> scene("hanging top");
    scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
    const auto top = add_body(scene,
                              BodyState<3>{.mass = m,
                                           .inertia = {0.05, 0.05, C},
                                           .centre = {0.0, 0.0, -l},
                                           .angular_velocity = {0.0, 0.0, n}},
                              "top");
    scene.add(Coincident{Fixed<3>{}, top.point({0.0, 0.0, l})});
    const auto bob = scene.add_particle({.mass = 2.0, .position = {3.0, 0.0, 0.0}}, "bob");
    scene.add(Spring{Fixed<3>{{3.0, 0.0, 0.0}}, bob, k, 0.0});
    const auto found = steady(scene);
    EXPECT_NEAR(angular_velocity(found.sample(), top).z(), n, rounding) << k;
    EXPECT_NEAR(found.sample().position(bob).z(), -2.0 * g / k, rounding) << k;
    const auto modes = normal_modes(scene, found);
    std::vector<double> nutations;
    for (std::size_t i = 0; i < modes.size(); ++i)
      if (!modes.is_free(i) && modes.frequency(i) < 20.0) nutations.push_back(modes.frequency(i));
    EXPECT_NEAR(nutations.front(), (root - C * n) / (2.0 * A), 1e-8) << k;
    EXPECT_NEAR(nutations.back(), (root + C * n) / (2.0 * A), 1e-8) << k;
  }
}

/// Of two conical pendulums, of 1 and 1.3, the moments of momentum together are kept, as they were, and the
/// height of the second: what that one has too much of its own the first must take, though it is stated
/// exactly.
TEST(Steady, WhatIsKeptOfTwoPartsMovesBoth) {
  Scene<3> scene("cones");
  scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
  const auto cone = [&](double x, double length, double angle, double faster) {
    const double rate = faster * std::sqrt(g / (length * std::cos(angle)));
    const auto bob =
        scene.add_particle({.mass = 2.0,
                            .position = {x + length * std::sin(angle), 0.0, -length * std::cos(angle)},
                            .velocity = {0.0, rate * length * std::sin(angle), 0.0}});
    scene.add(Distance{Fixed<3>{{x, 0.0, 0.0}}, bob, length});
    return bob;
  };
  const auto a = cone(0.0, 1.0, 0.6, 1.0), b = cone(5.0, 1.3, 0.9, 1.1);
  const auto momentum = [](double length, double cosine, double faster) {
    return 2.0 * faster * std::sqrt(g / (length * cosine)) * length * length * (1.0 - cosine * cosine);
  };
  const auto both = [=](const auto& now) {
    double L = 0.0;
    for (const auto& [bob, x] : {std::pair{a, 0.0}, std::pair{b, 5.0}}) {
      const auto r = now.position(bob), v = now.velocity(bob);
      L += 2.0 * ((r.x() - x) * v.y() - r.y() * v.x());
    }
    return L;
  };
  const auto found = steady(
      scene, {.keep = {{"moment", both}, {"height", [=](const auto& now) { return now.position(b).z(); }}}});
  const double left = momentum(1.0, std::cos(0.6), 1.0) + momentum(1.3, std::cos(0.9), 1.1) -
                      momentum(1.3, std::cos(0.9), 1.0);
  EXPECT_NEAR(momentum(1.0, -found.sample().position(a).z(), 1.0), left, 100.0 * rounding);
}

TEST(Steady, PrecessionOfATopIsARootOfItsQuadratic) {
  models::HeavyTop top{.lean = 0.5, .spin = 300.0};
  for (const double p : top.steady_precessions()) {
    top.precession = 1.03 * p;  // a guess
    const auto built = top.scene();
    const RigidBody<3> body = built.top;
    const auto at =
        steady(built.scene, {.keep = {{"lean", [=](const auto& now) { return body.axes(now).col(2).z(); }},
                                      {"spin", [=](const auto& now) {
                                         return angular_velocity(now, body).dot(body.axes(now).col(2));
                                       }}}});
    const Vec<3> rate = angular_velocity(at.sample(), body), axis = body.axes(at.sample()).col(2);
    EXPECT_NEAR(axis.z(), std::cos(top.lean), rounding);
    EXPECT_NEAR(rate.dot(axis), top.spin, top.spin * rounding);
    // What turns the axis is the precession: across it.
    const double across = (rate - rate.dot(axis) * axis).norm() / std::sqrt(1.0 - axis.z() * axis.z());
    EXPECT_NEAR(across, std::abs(p), 1e3 * rounding * std::abs(p));
  }
}

/// The distance of the nearest eigenvalue.
template <int D>
double off(const NormalModes<D>& modes, std::complex<double> s) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < modes.size(); ++k)
    nearest = std::min(nearest, std::abs(modes.eigenvalue(k) - s));
  return nearest;
}

TEST(Steady, TopAsleepIsStableAboveItsCriticalSpin) {
  // K is known to round-off of n^2, of which K keeps nothing. Critical: n = sqrt(4 A m g l)/C = 121.3.
  for (const double n : {20.0, 100.0, 120.0, 122.0, 150.0, 300.0, 3000.0}) {
    const models::HeavyTop top{.spin = n};
    const Scene<3> scene = top.scene().scene;
    const auto modes = normal_modes(scene, steady(scene));
    ASSERT_EQ(modes.size(), 3U) << n;
    EXPECT_TRUE(modes.is_free(0));
    EXPECT_EQ(modes.eigenvalue(0), 0.0);
    for (const auto s : top.asleep()) EXPECT_LT(off(modes, s), 1e2 * rounding) << n << ' ' << s;
    EXPECT_EQ(modes.stability(), n < 121.3 ? Stability::unstable : Stability::stable) << modes.describe();
  }
}

TEST(Steady, TopAsleepIsJudgedBesideAPendulum) {
  for (const double n : {100.0, 150.0, 300.0}) {
    const models::HeavyTop top{.spin = n};
    Scene<3> scene = top.scene().scene;
    const auto bob = scene.add_particle({.mass = 2.0, .position = {5.0, 0.0, -1.0}}, "bob");
    scene.add(Distance{Fixed<3>{{5.0, 0.0, 0.0}}, bob, 1.0});
    const auto modes = normal_modes(scene, steady(scene));
    ASSERT_EQ(modes.size(), 5U);
    for (const auto s : top.asleep()) EXPECT_LT(off(modes, s), 1e2 * rounding) << n;
    EXPECT_LT(off(modes, {0.0, std::sqrt(g)}), rounding);
    EXPECT_EQ(modes.stability(), n < 121.3 ? Stability::unstable : Stability::stable) << modes.describe();
  }
}

TEST(Steady, PrecessionNutatesAboutItsLean) {
  for (const double n : {150.0, 300.0}) {
    models::HeavyTop top{.lean = 0.5, .spin = n};
    top.precession = top.steady_precessions()[0];
    const auto built = top.scene();
    const RigidBody<3> body = built.top;
    const auto at =
        steady(built.scene, {.keep = {{"lean", [=](const auto& now) { return body.axes(now).col(2).z(); }}}});
    const auto modes = normal_modes(built.scene, at);
    ASSERT_EQ(modes.size(), 3U);
    EXPECT_TRUE(modes.is_free(0));
    EXPECT_TRUE(modes.is_free(1));
    EXPECT_NEAR(modes.frequency(2), top.nutation(), 1e2 * rounding) << n;
    EXPECT_EQ(modes.stability(), Stability::stable) << modes.describe();
  }
}

TEST(Steady, BicycleHasItsPublishedEigenvalues) {
  for (int v = 0; v <= 10; ++v) {
    const models::WhippleBicycle bicycle{.speed = static_cast<double>(v)};
    const Scene<3> scene = bicycle.scene().scene;
    const auto modes = normal_modes(scene, steady(scene));
    const Eigen::Vector4cd expected = bicycle.published().eigenvalues();
    std::size_t zeros = 0;
    for (std::size_t k = 0; k < modes.size(); ++k) zeros += modes.eigenvalue(k) == 0.0 ? 1U : 0U;
    EXPECT_GE(zeros, 3U);
    for (const std::complex<double>& s : expected) {
      if (s.imag() < 0.0) continue;
      double nearest = 1e9;
      for (std::size_t k = 0; k < modes.size(); ++k)
        nearest = std::min(nearest, std::abs(modes.eigenvalue(k) - s));
      EXPECT_LT(nearest, 1e-10 * std::abs(s)) << v << ' ' << s;  // what is printed in 14 digits
    }
    // Weave 4.292, capsize 6.024 m/s.
    EXPECT_EQ(modes.stability(), v == 5 || v == 6 ? Stability::stable : Stability::unstable)
        << v << ' ' << modes.describe();
  }
}

TEST(Steady, IsRefusedByNameWhereNoSymmetryCarriesItOn) {
  // A body with three different moments in a bearing that is not one of its axes.
  Scene<3> scene("shaft");
  scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
  const auto body = add_body(scene,
                             {.mass = 1.0,
                              .inertia = {0.1, 0.12, 0.15},
                              .centre = {0.0, 0.0, 1.0},
                              .angular_velocity = {0.0, 3.0, 0.0}},
                             "crooked");
  add_joint(scene, Revolute{Ground<3>{}, body, {0.1, 0.0, 1.0}, {0.0, 1.0, 0.0}}, "bearing");
  EXPECT_THAT([&] { (void)steady(scene); },
              ThrowsMessage<NoEquilibrium>(testing::AllOf(HasSubstr("crooked"), HasSubstr("floquet"))));
}

TEST(Steady, RefusesWhatChangesWithTime) {
  Scene<2> scene("driven");
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  scene.add(Distance{driven([](auto t) { return vec(0.0 * t, sin(t)); }), bob, 1.0});
  EXPECT_THAT([&] { (void)steady(scene); }, ThrowsMessage<InvalidScene>(HasSubstr("changes with time")));
}

/// A remedy is one of what is refused: of a contact, a released constraint, friction.
TEST(Steady, RefusesWhatDoesNotAlwaysHoldWithARemedy) {
  Scene<2> scene;
  const auto block = scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.0}});
  const auto refused = [](const Scene<2>& one, const std::string& why) {
    EXPECT_THAT([&] { (void)steady(one); }, ThrowsMessage<InvalidScene>(HasSubstr(why)));
  };
  Scene<2> touching = scene;
  touching.add(unilateral(OnCurve{block, Plane<2>{}}));
  refused(touching, "state it as a bilateral one");
  const auto floor = scene.add(OnCurve{block, Plane<2>{}}, "floor");
  Scene<2> released = scene;
  released.release(floor);
  refused(released, "\"floor\" has been released and is not in force; put it back");
  scene.add(coulomb(floor, Slip{block, Plane<2>{}}, 0.3), "rough");
  refused(scene, "\"rough\": where friction sticks");
  refused(scene, "leave it out to find the one without friction");
}

/// A sleigh on a circle, its blade through the centre of mass: m v' = thrust(v), J w' = 1 - 2 w. A shift of
/// the circle is seen from the frame that turns with it at w = 1/2 as a vibration that never decays.
template <class Thrust>
NormalModes<2> modes_of_driven_sleigh(const Thrust& thrust) {
  Scene<2> scene("sleigh");
  const auto body = scene.add_particle({.mass = 2.0, .velocity = {1.5, 0.0}}, "body");
  const auto heading = scene.add_rotor({.inertia = 0.5, .angular_velocity = 0.5}, "heading");
  scene.add(
      nonholonomic(points(body, heading), [](auto, auto theta, auto v,
                                             auto) { return cos(theta[0]) * v.y() - sin(theta[0]) * v.x(); }),
      "blade");
  scene.add(force_law(points(body, heading),
                      [thrust](auto, auto theta, auto v, auto w) {
                        const auto along = cos(theta[0]) * v.x() + sin(theta[0]) * v.y();
                        const auto F = thrust(along);
                        return std::tuple{vec(F * cos(theta[0]), F * sin(theta[0])), vec(1.0 - 2.0 * w[0])};
                      }),
            "thrust");
  return normal_modes(scene, steady(scene));
}

TEST(Steady, IsStableWhereAllDecaysButShiftsOfTheWholeMotion) {
  // thrust = 3 - 2 v: eigenvalues -2/m and -2/J.
  const auto modes = modes_of_driven_sleigh([](auto v) { return 3.0 - 2.0 * v; });
  EXPECT_LT(off(modes, {-1.0, 0.0}), rounding);
  EXPECT_LT(off(modes, {-4.0, 0.0}), rounding);
  EXPECT_LT(off(modes, {0.0, 0.5}), rounding);
  EXPECT_EQ(modes.stability(), Stability::stable) << modes.describe();
  EXPECT_THAT(modes.describe(), HasSubstr("carries the motion"));
}

TEST(Steady, IsNotProvedStableByShiftsWhereTheSpeedDoesNotDecay) {
  // Nothing of (v - 3/2)^2 is linear, and from above the speed runs away.
  const auto creeping = modes_of_driven_sleigh([](auto v) { return (v - 1.5) * (v - 1.5); });
  EXPECT_EQ(creeping.stability(), Stability::undecided) << creeping.describe();
  const auto growing = modes_of_driven_sleigh([](auto v) { return v - 1.5; });
  EXPECT_EQ(growing.stability(), Stability::unstable) << growing.describe();
}

/// What is kept has its value before forces are known.
TEST(Steady, NamesTheKeptQuantityThatIsNotOfPositionsAndVelocities) {
  Scene<2> scene("ring");
  const auto bead = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}, .velocity = {0.0, 2.0}}, "bead");
  const auto ring = scene.add(Distance{Fixed<2>{}, bead, 1.0}, "ring");
  using Value = std::function<double(const Sample<2>&)>;
  const auto refused = [&](const Value& value, const std::string& why) {
    EXPECT_THAT(
        [&] {
          (void)steady(scene, {.keep = {{"speed", value}}});
        },
        ThrowsMessage<NoEquilibrium>(testing::AllOf(HasSubstr("\"speed\""), HasSubstr(why))));
  };
  for (const Value& of_forces :
       {Value([=](const auto& now) { return now.acceleration(bead).norm(); }),
        Value([=](const auto& now) { return now.multiplier(ring); }),
        Value([=](const auto& now) { return now.constraint_force(ring, bead).norm(); }),
        Value([=](const auto& now) { return now.constraint_force(bead).norm(); }),
        Value([=](const auto& now) { return now.ground_force(ring).norm(); }),
        Value([](const auto& now) { return now.energy(); }), Value([](const auto&) { return std::nan(""); })})
    refused(of_forces, "positions and velocities, which are all that it may read");
  refused([](const auto&) -> double { throw std::runtime_error("mine"); }, "threw \"mine\"");
  refused([](const auto&) -> double { throw 3; }, "no std::exception");
  refused({}, "threw");
}

}  // namespace
}  // namespace dalembert::steady_test
