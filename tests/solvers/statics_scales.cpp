#include <dalembert/dalembert.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace dalembert::statics_scales_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

/// Equilibria are sought to round-off; those here are conditioned like 1.
constexpr double rounding = 1e-12;

TEST(Equilibrium, BungeeIsFoundFromWhereItIsSlack) {
  // k (l - l0) = m g below the hook: l = 1 + 9.81/50. There gravity and the rope cancel to round-off.
  for (const double guess : {-0.3, -0.9, -1.5}) {
    Scene<2> scene("bungee");
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    const auto p = scene.add_particle({.mass = 1.0, .position = {0.0, guess}}, "jumper");
    scene.add(ElasticString{Fixed<2>{}, p, 50.0, 1.0}, "rope");
    const auto at = equilibrium(scene);
    EXPECT_NEAR(at.sample().position(p).y(), -1.0 - 9.81 / 50.0, rounding);
    EXPECT_EQ(normal_modes(scene, at).stability(), Stability::stable);
  }
}

TEST(Equilibrium, LargeForcesThatCancelDoNotHideTheRest) {
  // A thrust of 1e8 either way and a spring of 1e-3: round-off of the former, 1e-8, moves the latter by 1e-5.
  Scene<2> scene;
  const auto x = scene.add_rotor({.inertia = 1.0, .angle = 0.3});
  for (const double side : {1e8 / 3.0, -1e8 / 3.0})
    scene.add(force_law(points(x), [side](auto phi, auto) { return vec(side + 0.0 * phi[0]); }));
  scene.add(potential(points(x), [](auto phi) { return 0.5e-3 * phi[0] * phi[0]; }));
  const auto at = equilibrium(scene);
  EXPECT_NEAR(at.sample().angle(x), 0.0, 1e-4);
  EXPECT_NO_THROW((void)normal_modes(scene, at));
}

TEST(Equilibrium, StiffnessElsewhereDoesNotHoldWhatIsSoft) {
  for (const double ratio : {1e6, 1e9, 1e12, 1e15}) {
    Scene<2> scene("two");
    const auto a = scene.add_rotor({.inertia = 1.0, .angle = 0.3}, "soft"),
               b = scene.add_rotor({.inertia = 1.0, .angle = 0.3}, "stiff");
    scene.add(potential(points(a), [](auto x) { return 0.5e-6 * x[0] * x[0]; }));
    scene.add(potential(points(b), [ratio](auto x) { return 0.5e-6 * ratio * x[0] * x[0]; }));
    const auto at = equilibrium(scene);
    EXPECT_NEAR(at.sample().angle(a), 0.0, rounding) << ratio;
    EXPECT_NEAR(at.sample().angle(b), 0.0, rounding) << ratio;
    const auto modes = normal_modes(scene, at);
    EXPECT_NEAR(modes.frequency(0), 1e-3, 1e-9) << ratio;
  }
}

TEST(Equilibrium, ParticleMovesAlongItsSoftDirection) {
  // Along (c, s) a spring of 1e-6, across one of 1e5 and more that carries 1e3.
  for (const double stiff : {1e4, 1e5, 1e6}) {
    for (const double angle : {0.0, 0.6}) {
      const double c = std::cos(angle), s = std::sin(angle);
      Scene<2> scene;
      const auto p = scene.add_particle({.mass = 1.0, .position = {0.3, 0.2}});
      scene.add(potential(points(p, Fixed<2>{}), [c, s](auto r, auto) {
        const auto along = c * r.x() + s * r.y();
        return 0.5e-6 * along * along;
      }));
      scene.add(potential(points(p, Fixed<2>{}), [c, s, stiff](auto r, auto) {
        const auto across = c * r.y() - s * r.x();
        return 0.5 * stiff * across * across;
      }));
      const auto found = equilibrium(scene);
      const Vec<2> at = found.sample().position(p);
      // Round-off of the stiff force, some 1e-16 of stiff times 0.3, over the soft spring.
      const double known = 1e-12 + 1e2 * 1e-16 * stiff / 1e-6 * (angle == 0.0 ? 0.0 : 1e-6);
      EXPECT_NEAR(c * at.x() + s * at.y(), 0.0, std::max(known, 1e-7)) << stiff << ' ' << angle;
    }
  }
}

TEST(Equilibrium, HeavyParticleInAQuarticWellHasZeroFrequency) {
  for (const double mass : {1.0, 1e6}) {
    Scene<2> scene("well");
    const auto x = scene.add_rotor({.inertia = mass, .angle = 0.5});
    scene.add(potential(points(x), [](auto phi) { return phi[0] * phi[0] * phi[0] * phi[0]; }));
    const auto at = equilibrium(scene);
    EXPECT_NEAR(at.sample().angle(x), 0.0, 1e-5);
    const auto modes = normal_modes(scene, at);
    EXPECT_EQ(modes.stability(), Stability::undecided) << mass;
  }
}

/// A well of which one side is stiffer: at its bottom there is no frequency, whichever side is looked at.
TEST(NormalModes, AtAKinkAreRefused) {
  for (const bool compared : {false, true}) {
    Scene<2> scene;
    const auto p = scene.add_particle({.mass = 1.0, .position = {0.3, 0.0}}, "bead");
    scene.add(OnCurve{p, Plane<2>{}});
    scene.add(potential(points(p), [compared](auto r) {
      const auto x = r.x(), right = max(x, 0.0 * x);
      return compared ? (x > 0.0 ? 1.5 * x * x : 0.5 * x * x) : right * right + 0.5 * x * x;
    }));
    EXPECT_THAT([&] { (void)normal_modes(scene, equilibrium(scene)); },
                ThrowsMessage<InvalidScene>(HasSubstr("particle \"bead\" along x is held by forces that have "
                                                      "a kink at the equilibrium")));
  }
}

/// Nor is where the stiffness vanishes without a kink, or one that the motion cannot reach.
TEST(NormalModes, BesideAKinkOrAtAJumpOfHigherOrderAreFound) {
  Scene<2> scene;
  const auto p = scene.add_particle({.mass = 1.0, .position = {0.3, 0.0}}, "bead");
  scene.add(OnCurve{p, Plane<2>{}});
  scene.add(potential(points(p), [](auto r) {
    const auto x = r.x(), y = max(r.y(), 0.0 * x), right = max(x, 0.0 * x);
    return 0.5 * x * x + y * y + right * right * right * right;
  }));
  EXPECT_NEAR(normal_modes(scene, equilibrium(scene)).frequency(0), 1.0, rounding);
}

/// m g l (cos a - 1) + k a^2/2 with k = m g l: a^4 is left, and what it balances to round-off leaves a
/// position known to its cube root.
TEST(NormalModes, AtACriticalLoadAreNotDecided) {
  for (const double a : {0.01, 0.3, -0.7, 1.4}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -10.0}});
    const auto p = scene.add_particle({.mass = 1.0, .position = {std::sin(a), std::cos(a)}});
    scene.add(Distance{Fixed<2>{}, p, 1.0});
    scene.add(potential(points(p), [](auto r) {
      const auto angle = atan2(r.x(), r.y());
      return 5.0 * angle * angle;
    }));
    const auto at = equilibrium(scene);
    EXPECT_NEAR(at.sample().position(p).x(), 0.0, std::cbrt(rounding)) << a;
    const auto modes = normal_modes(scene, at);
    EXPECT_EQ(modes.frequency(0), 0.0) << a;
    EXPECT_EQ(modes.stability(), Stability::undecided) << a;
  }
}

/// A single particle has no length but that of its forces, which at the equilibrium are round-off.
TEST(NormalModes, OfALoneParticleAreThoseOfItsWell) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (const double k : {1e-2, 1e-6, 1e-10})
    for (const double at : {0.0, 1.1}) {
      Scene<2> scene;
      const auto p = scene.add_particle({.mass = 1.0, .position = {at + 0.1, at + 0.2}});
      scene.add(potential(points(p), [=](auto r) {
        const auto x = r.x() - at, y = r.y() - at, along = c * x + s * y, across = c * y - s * x;
        return 0.5 * (k * along * along + across * across);
      }));
      const auto modes = normal_modes(scene, equilibrium(scene));
      ASSERT_EQ(modes.size(), 2U) << k << ' ' << at;
      EXPECT_NEAR(modes.frequency(0), std::sqrt(k), 1e-4 * std::sqrt(k)) << k << ' ' << at;
      EXPECT_NEAR(modes.frequency(1), 1.0, rounding) << k << ' ' << at;
    }
}

TEST(Equilibrium, IsTheOneDownhill) {
  // V = cos x - 0.2 x: from 1.2 downhill to 3.343, a minimum where sin x = -0.2; a full Newton step leads to
  // -1.9 and on to the minimum of the next valley, uphill.
  Scene<2> scene;
  const auto x = scene.add_rotor({.inertia = 1.0, .angle = 1.2});
  scene.add(potential(points(x), [](auto phi) { return cos(phi[0]) - 0.2 * phi[0]; }));
  const auto found = equilibrium(scene);
  EXPECT_NEAR(found.sample().angle(x), std::acos(-1.0) + std::asin(0.2), rounding);
}

TEST(Equilibrium, SaysWhoseVelocitiesItLeavesOut) {
  Scene<2> scene("thrown");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {0.6, -0.8}, .velocity = {0.8, 0.6}}, "bob");
  scene.add(Distance{Fixed<2>{}, bob, 1.0});
  const auto at = equilibrium(scene);
  EXPECT_THAT(at.left_out(), HasSubstr("\"bob\""));
  EXPECT_THAT(normal_modes(scene, at).describe(), HasSubstr("left out"));
  // That of a turning which the scene states is not left out.
  Scene<2> carousel;
  const auto bead =
      carousel.add_particle({.mass = 1.0, .position = {10.0 / 6.0, 0.0}, .velocity = {0.0, 20.0 / 6.0}});
  carousel.add(Spring{Fixed<2>{}, bead, 10.0, 1.0});
  EXPECT_TRUE(equilibrium(carousel, {.turning = {.rate = 2.0}}).left_out().empty());
}

TEST(NormalModes, MayBeThoseOfACopyOfTheScene) {
  Scene<2> scene("one");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {0.0, -1.0}}, "bob");
  scene.add(Distance{Fixed<2>{}, bob, 1.0});
  const auto at = equilibrium(scene);
  const Scene<2> copy = scene;
  EXPECT_NEAR(normal_modes(copy, at).frequency(0), std::sqrt(9.81), rounding);
}

TEST(Equilibrium, SaysThatAConstraintIsReleased) {
  Scene<2> scene("let go");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {0.0, -1.0}}, "bob");
  const auto rod = scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");
  scene.release(rod);
  EXPECT_THAT([&] { (void)equilibrium(scene); },
              ThrowsMessage<InvalidScene>(AllOf(HasSubstr("released"), Not(HasSubstr("sign")))));
}

TEST(NormalModes, NameFreeMotionsByBody) {
  Scene<3> scene;
  const auto body = add_body(scene, BodyState<3>{.mass = 1.0, .inertia = {0.1, 0.12, 0.15}}, "boat");
  scene.add(potential(points(body.centre()), [](auto r) { return r.z() * r.z(); }));
  const auto modes = normal_modes(scene, equilibrium(scene));
  EXPECT_THAT(modes.describe(), AllOf(HasSubstr("free motion of \"boat\""), Not(HasSubstr("boat.p1"))));
}

}  // namespace
}  // namespace dalembert::statics_scales_test
