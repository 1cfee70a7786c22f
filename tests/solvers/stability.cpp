#include <dalembert/dalembert.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

/// Verdicts on scenes in which what grows is small beside something else: each was once called stable.

namespace dalembert::stability_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double epsilon = std::numeric_limits<double>::epsilon();
/// Eigenvalues of matrices of a few rows, in units of the largest number of their own part of the scene.
constexpr double rounding = 1e3 * epsilon;

/// A bead of mass 1 that slides along the horizontal line at some height.
Particle<2> bead(Scene<2>& scene, double height) {
  const auto added = scene.add_particle({.mass = 1.0, .position = {0.0, height}});
  scene.add(OnCurve{added, [height](auto r) { return r.y() - height; }});
  return added;
}

/// V = k x^2/2.
void hold(Scene<2>& scene, Particle<2> particle, double k) {
  scene.add(potential(points(particle), [k](auto r) { return 0.5 * k * r.x() * r.x(); }));
}

NormalModes<2> modes_of(const Scene<2>& scene, const ModesOptions& options = {}) {
  return normal_modes(scene, equilibrium(scene), options);
}

double fastest_growth(const NormalModes<2>& modes) {
  double growth = 0.0;
  for (std::size_t k = 0; k < modes.size(); ++k) growth = std::max(growth, -modes.damping(k));
  return growth;
}

TEST(Stability, FallingBeadIsUnstableBesideAStiffSpringAndASlider) {
  // s^2 + d s - k = 0, in units of time from fast to slow.
  for (const double unit : {1.0, 1e-8}) {
    for (const double stiff : {1e2, 1e8, 1e10, 1e14}) {
      Scene<2> scene;
      scene.add(LinearDrag{bead(scene, 0.0), 5.0 * unit});
      const auto falling = bead(scene, 1.0);
      hold(scene, falling, -9.0 * unit * unit);
      scene.add(LinearDrag{falling, 1.0 * unit});
      hold(scene, bead(scene, 2.0), stiff * unit * unit);
      const auto modes = modes_of(scene);
      EXPECT_EQ(modes.stability(), Stability::unstable) << stiff;
      const double root = unit * (-0.5 + std::sqrt(9.25));
      EXPECT_NEAR(fastest_growth(modes), root, 10 * rounding * root) << stiff;
    }
  }
}

TEST(Stability, FallingBeadIsUnstableCoupledToAStiffSpring) {
  // The same tied by a spring of 1 to one of 1e8: to a millionth the bead alone with a stiffness more by 1.
  Scene<2> scene;
  scene.add(LinearDrag{bead(scene, 0.0), 5.0});
  const auto falling = bead(scene, 1.0), stiff = bead(scene, 2.0);
  hold(scene, falling, -9.0);
  scene.add(LinearDrag{falling, 1.0});
  hold(scene, stiff, 1e8);
  scene.add(potential(points(falling, stiff), [](auto a, auto b) {
    const auto x = b.x() - a.x();
    return 0.5 * x * x;
  }));
  const auto modes = modes_of(scene);
  EXPECT_EQ(modes.stability(), Stability::unstable);
  EXPECT_NEAR(fastest_growth(modes), -0.5 + std::sqrt(8.25), 1e-6);
}

TEST(Stability, GrowthAlongANonholonomicConstraintIsUnstable) {
  // v_x = 0.3 (x - 1) grows by itself, whatever holds y.
  for (const double k : {1.0, 1e8}) {
    Scene<2> scene;
    const auto skate = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
    scene.add(nonholonomic(points(skate), [](auto r, auto v) { return v.x() - 0.3 * (r.x() - 1.0); }));
    scene.add(potential(points(skate), [k](auto r) { return 0.5 * k * r.y() * r.y(); }));
    const auto modes = modes_of(scene);
    EXPECT_EQ(modes.stability(), Stability::unstable);
    EXPECT_NEAR(fastest_growth(modes), 0.3, rounding * std::sqrt(k));
  }
}

/// F = (-x - a y, -y + a x): s^2 = -1 +- i a, so that one mode grows as Re sqrt(-1 + i a).
void follow(Scene<2>& scene, double a) {
  const auto particle = scene.add_particle({.mass = 1.0});
  scene.add(force_law(points(particle), [a](auto r, auto) {
    auto f = r;
    f.x() = -r.x() - a * r.y();
    f.y() = -r.y() + a * r.x();
    return f.eval();
  }));
}

TEST(Stability, WeakFollowerForceIsUnstableBesideAStiffSpring) {
  const double a = 1e-3;
  for (const double stiff : {10.0, 1e10, 1e14}) {
    Scene<2> scene;
    follow(scene, a);
    hold(scene, bead(scene, 2.0), stiff);
    const auto modes = modes_of(scene);
    EXPECT_EQ(modes.stability(), Stability::unstable) << stiff;
    EXPECT_NEAR(fastest_growth(modes), std::sqrt(std::complex<double>(-1.0, a)).real(), rounding) << stiff;
  }
}

TEST(Stability, WeakPushIsUnstableBesideAStrongDamper) {
  // s^2 - d s + 1 = 0.
  const double d = 1e-3;
  Scene<2> scene;
  const auto pushed = bead(scene, 1.0), damped = bead(scene, 2.0);
  for (const auto particle : {pushed, damped}) hold(scene, particle, 1.0);
  scene.add(force_law(points(pushed), [d](auto, auto v) { return (d * v).eval(); }));
  scene.add(LinearDrag{damped, 1e10});
  const auto modes = modes_of(scene);
  EXPECT_EQ(modes.stability(), Stability::unstable);
  EXPECT_NEAR(fastest_growth(modes), 0.5 * d, rounding);
}

TEST(Stability, FollowerForceIsUnstableAmongManyCoordinates) {
  for (const int others : {10, 301}) {
    Scene<2> scene;
    follow(scene, 0.5);
    for (int i = 0; i < others; ++i) hold(scene, bead(scene, 2.0 + i), 4.0 + i);
    const auto modes = modes_of(scene, {.lowest = 3});
    EXPECT_EQ(modes.stability(), Stability::unstable) << others << modes.describe();
    EXPECT_NEAR(fastest_growth(modes), std::sqrt(std::complex<double>(-1.0, 0.5)).real(), 400 * rounding)
        << others;
  }
}

TEST(Stability, BeadOnAFlatTopIsUndecidedBesideAStiffSpring) {
  for (const double stiff : {1e6, 1e10, 1e14}) {
    Scene<2> scene;
    const auto top = bead(scene, 1.0);
    scene.add(potential(points(top), [](auto r) {
      const auto x2 = r.x() * r.x();
      return -1.0 * x2 * x2;
    }));
    hold(scene, bead(scene, 2.0), stiff);
    const auto modes = modes_of(scene);
    EXPECT_EQ(modes.stability(), Stability::undecided) << stiff;
    EXPECT_FALSE(modes.is_free(0)) << stiff;
  }
}

TEST(Stability, SlowGrowthIsNoFreeMotionBesideAStiffSpring) {
  for (const double stiff : {1e6, 1e10, 1e14}) {
    Scene<2> scene;
    hold(scene, bead(scene, 1.0), -1e-3);
    hold(scene, bead(scene, 2.0), stiff);
    const auto modes = modes_of(scene);
    EXPECT_EQ(modes.stability(), Stability::unstable) << stiff;
    EXPECT_NEAR(fastest_growth(modes), std::sqrt(1e-3), rounding) << stiff;
  }
}

TEST(Stability, DoorInTwoHingesIsNotJudgedByRoundOff) {
  // It turns freely: its only stiffness is the round-off of what hinges and weight sum to 0. With a drag of
  // 0.4 at 1 m in x and 0.1 m in y off the hinges, s = -0.4 (1 + 0.01)/(4 + 10 (0.25 + 0.01)), to
  // the roundings of a sum, 1e3, of terms of size 1.
  for (const bool drags : {false, true}) {
    for (const double height : {0.2, 0.3, 0.53, 0.7, 1.9}) {
      Scene<3> scene("door");
      scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
      const auto door =
          add_body(scene, {.mass = 10.0, .inertia = {3.0, 1.5, 4.0}, .centre = {0.5, 0.1, 1.0}}, "door");
      add_joint(scene, Revolute{Ground<3>{}, door, {0.0, 0.0, height}, {0.0, 0.0, 1.0}}, "lower");
      add_joint(scene, Revolute{Ground<3>{}, door, {0.0, 0.0, 1.8}, {0.0, 0.0, 1.0}}, "upper");
      if (drags)
        scene.add(force_law(points(door.point({0.5, 0.0, 0.0})),
                            [](auto, auto v) { return vec(-0.4 * v.x(), -0.4 * v.y(), -0.4 * v.z()); }));
      const auto modes = normal_modes(scene, equilibrium(scene));
      EXPECT_EQ(modes.stability(), Stability::stable) << height << modes.describe();
      ASSERT_EQ(modes.size(), drags ? 2U : 1U);
      EXPECT_TRUE(modes.is_free(0)) << height;
      if (drags) {
        EXPECT_NEAR(modes.eigenvalue(1).real(), -0.4 * 1.01 / 6.6, 1e-12) << height;
      }
    }
  }
}

TEST(Stability, IsThatOfAllModesHoweverFewAreWanted) {
  for (const bool top_first : {true, false}) {
    Scene<2> scene;
    const auto one = bead(scene, 0.0), other = bead(scene, 1.0);
    scene.add(potential(points(top_first ? one : other), [](auto r) {
      const auto x2 = r.x() * r.x();
      return -1.0 * x2 * x2;
    }));
    const auto modes = modes_of(scene, {.lowest = 1});
    EXPECT_EQ(modes.size(), 1U);
    EXPECT_EQ(modes.stability(), Stability::undecided);
  }
}

TEST(Stability, IsUndecidedWhereOnlyFreeMotionsWereComputed) {
  Scene<2> scene;
  for (int i = 0; i < 301; ++i) {
    const auto added = bead(scene, i);
    if (i > 1) hold(scene, added, 1.0 + i);
  }
  EXPECT_EQ(modes_of(scene, {.lowest = 1}).stability(), Stability::undecided);
  EXPECT_EQ(modes_of(scene, {.lowest = 3}).stability(), Stability::stable);
}

TEST(Stability, IsRefusedAtAnEquilibriumOfAnOlderScene) {
  Scene<2> scene("pendulum");
  const auto bob = scene.add_particle({.mass = 1.0, .position = {0.0, -1.0}});
  const auto gravity = scene.add(UniformGravity<2>{{0.0, -9.81}});
  scene.add(Distance{Fixed<2>{}, bob, 1.0});
  const auto old = equilibrium(scene);
  EXPECT_EQ(normal_modes(scene, old).size(), 1U);
  scene.replace(gravity, UniformGravity<2>{{9.81, 0.0}});
  EXPECT_THAT([&] { (void)normal_modes(scene, old); },
              ThrowsMessage<InvalidArgument>(HasSubstr("changed since")));
  scene.replace(gravity, UniformGravity<2>{{0.0, -9.81}});
  const auto lower = scene.add_particle({.mass = 1.0, .position = {0.0, -2.0}});
  EXPECT_THAT([&] { (void)normal_modes(scene, old); },
              ThrowsMessage<InvalidArgument>(HasSubstr("2 coordinates, the scene 4")));
  scene.add(Distance{bob, lower, 1.0});
  EXPECT_THAT([&] { (void)normal_modes(scene, old); }, testing::Throws<InvalidArgument>());
}

TEST(NormalModes, LeaveDrivenPointsWhereTheyAre) {
  // u is the difference from the equilibrium, in which a path has no part, whatever its velocity.
  Scene<2> scene;
  (void)bead(scene, 0.0);
  const auto path = driven([](auto t) { return vec(3.0 * t, 0.0 * t); });
  EXPECT_EQ(modes_of(scene).shape(0, path).norm(), 0.0);
}

TEST(Stability, IsNotAskedWhereSomethingFallsBesideAStiffSpring) {
  // A grain that nothing holds, beside a spring whose round-off, 10 eps k l = 2e-9 N, exceeds its weight. And
  // the same grain on a soft spring from the stiff one's mass: that stretches by m g/k = 1.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -10.0}});
  const auto held = scene.add_particle({.mass = 1.0, .position = {0.0, -1.0}});
  scene.add(Spring{Fixed<2>{}, held, 1e6, 1.0});
  const auto grain = scene.add_particle({.mass = 1e-12, .position = {0.0, -2.0}}, "grain");
  EXPECT_THAT([&] { (void)equilibrium(scene); }, ThrowsMessage<NoEquilibrium>(HasSubstr("grain")));
  scene.add(Spring{held, grain, 1e-11, 1.0});
  // To 1e-10 of its weight, and so of the stretch; the mass above hangs 1e-5 lower.
  const auto hanging = equilibrium(scene);
  EXPECT_NEAR(hanging.sample().position(grain).y(), -3.00001, 1e-9);
}

template <class E>
concept ReadAsTemporary = requires(E e) {
  std::forward<E>(e).sample().energy();
};
static_assert(ReadAsTemporary<const Equilibrium<2>&> && !ReadAsTemporary<Equilibrium<2>>,
              "what is read does not outlive its owner");

}  // namespace
}  // namespace dalembert::stability_test
