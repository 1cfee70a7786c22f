#include <dalembert/dalembert.h>
#include <dalembert/models/spinning_disk.h>
#include <dalembert/models/whipple_bicycle.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace dalembert::reversible_test {
namespace {

using models::SpinningDisk;
using testing::HasSubstr;
constexpr double g = 9.81, upright = std::numbers::pi / 2.0;

template <int D>
NormalModes<D> modes_of(const Scene<D>& scene) {
  return normal_modes(scene, steady(scene));
}

SpinningDisk straight(double times_critical) {
  SpinningDisk disk{.lean = upright, .precession = 0.0};
  disk.spin = times_critical * std::sqrt(disk.gravity / (3.0 * disk.radius));
  return disk;
}

TEST(Reversible, DiskIsStableAboveItsCriticalSpin) {
  for (const double times : {-10.0, -1.01, -0.5, 0.3, 0.99, 1.01, 2.0, 10.0}) {
    const auto modes = modes_of(straight(times).scene().scene);
    EXPECT_EQ(modes.stability(), std::abs(times) > 1.0 ? Stability::stable : Stability::unstable)
        << times << ": " << modes.describe();
    if (modes.stability() == Stability::stable) {
      EXPECT_THAT(modes.describe(), HasSubstr("its own mirror image run backwards"));
    }
  }
}

TEST(Reversible, DiskOnACircleIsStableWhereItVibrates) {
  int stable = 0, unstable = 0;
  for (const double lean : {0.3, 1.0, 1.4, 1.7, 2.2}) {
    for (const double precession : {-4.0, 0.5, 2.0, 6.0}) {
      SpinningDisk disk{.lean = lean, .precession = precession};
      disk.spin = disk.steady_spin();
      const bool vibrates = disk.frequency_squared() > 0.0;
      const auto modes = modes_of(disk.scene().scene);
      EXPECT_EQ(modes.stability(), vibrates ? Stability::stable : Stability::unstable)
          << lean << ' ' << precession << ": " << modes.describe();
      ++(vibrates ? stable : unstable);
    }
  }
  EXPECT_GT(std::min(stable, unstable), 0);
}

TEST(Reversible, DiskSpinningInPlaceIsStableAboveAnotherSpin) {
  // 5 omega^2 = 5 p^2 - 4 g/r, as frequency_squared with w3 = 0. No velocity of a centre tells the mirror.
  for (const double precession : {1.0, 3.0, 5.0, 8.0}) {
    const SpinningDisk disk{.lean = upright, .precession = precession, .spin = 0.0};
    EXPECT_EQ(modes_of(disk.scene().scene).stability(),
              disk.frequency_squared() > 0.0 ? Stability::stable : Stability::unstable)
        << precession;
  }
}

TEST(Reversible, StableDiskStaysNearInTime) {
  // Motions about it are closed up to symmetries: the largest lean is the same in the first and the last of
  // some 20 vibrations, to the error of the run, which grows by no more than the time.
  auto disk = straight(1.2);
  disk.lean += 0.02;
  disk.lean_rate = 0.05;
  const auto built = disk.scene();
  constexpr double tolerance = 1e-9;
  const auto run = simulate(
      built.scene, {.t_end = 60.0, .samples = 12001, .tolerance = tolerance, .stepper = Stepper::erk});
  std::vector<double> most(4, 0.0);
  for (std::size_t i = 0; i < 12000; ++i) {
    const Vec<3> centre = run.position(built.disk.centre(), i);
    const Vec<3> axis =
        (run.position(built.marks[0], i) - centre).cross(run.position(built.marks[1], i) - centre);
    most[i / 3000] = std::max(most[i / 3000], std::abs(axis.z()) / axis.norm());
  }
  EXPECT_GT(most[0], 0.02);
  EXPECT_LT(most[0], 0.2);
  // A sample misses the turn of the lean by half an interval: omega^2 dt^2/8 of it.
  for (const double later : most) EXPECT_NEAR(later, most[0], most[0] * 25.0 * 0.005 * 0.005 / 8.0 + 1e-6);
}

/// The centre of a disk, with points of its rim, and the force on it by the height of its axis over the
/// horizontal n (0 where it is upright) and by its velocity.
template <class Law>
Scene<3> pushed(double times_critical, Law law) {
  auto built = straight(times_critical).scene();
  const auto centre = built.disk.centre();
  built.scene.add(force_law(points(centre, built.marks[0], built.marks[1]),
                            [law](auto r, auto a, auto b, auto v, auto, auto) {
                              const auto n = (a - r).cross(b - r).eval();
                              const auto force = law(n.z(), v);
                              return std::make_tuple(force, (0.0 * force).eval(), (0.0 * force).eval());
                            }));
  return std::move(built.scene);
}

TEST(Reversible, DiskWhoseMirrorIsBrokenIsNotCalledStable) {
  // Drag that grows with the cube of the vertical speed, or the reverse: the linear terms are the same.
  for (const double c : {1.0, -1.0, 1e-4, -1e-4}) {
    const auto modes = modes_of(pushed(2.0, [c](const auto&, const auto& v) {
      return vec(0.0 * v.x(), 0.0 * v.y(), -c * v.z() * v.z() * v.z());
    }));
    EXPECT_EQ(modes.stability(), Stability::undecided) << c << ": " << modes.describe();
  }
  // A force along the velocity, by the lean: mirrored it keeps its sign, with time reversed it should not.
  for (const double c : {0.1, 1e-5}) {
    const auto modes =
        modes_of(pushed(2.0, [c](const auto& lean, const auto& v) { return (c * lean * v).eval(); }));
    EXPECT_NE(modes.stability(), Stability::stable) << c << ": " << modes.describe();
  }
  // A potential breaks nothing.
  const auto modes = modes_of(pushed(
      2.0, [](const auto& lean, const auto& v) { return vec(0.0 * v.x(), 0.0 * v.y(), 0.5 * lean * lean); }));
  EXPECT_EQ(modes.stability(), Stability::stable) << modes.describe();
}

void add_disk(Scene<3>& scene, double y, double spin) {
  constexpr double r = 0.5;
  const auto body = add_body(scene,
                             {.mass = 2.0,
                              .inertia = {0.2, 0.3, 0.2},
                              .centre = {0.0, y, r},
                              .velocity = {spin * r, 0.0, 0.0},
                              .angular_velocity = {0.0, spin, 0.0}},
                             "disk at " + std::to_string(y));
  const auto a = body.point({r, 0.0, 0.0}), b = body.point({0.0, 0.0, r});
  scene.add(DiskContact{body.centre(), a, b, r});
  scene.add(DiskRolling{body.centre(), a, b, r});
}

TEST(Reversible, PartsOfASceneAreJudgedSeparately) {
  // A/(C (C + m r^2)) m g r = 8.175 = 2.86^2 is critical.
  for (const double other : {6.0, 2.0}) {
    Scene<3> scene("two disks");
    scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
    add_disk(scene, 0.0, 4.0);
    add_disk(scene, 5.0, other);
    const auto bob = scene.add_particle({.mass = 1.0, .position = {0.0, 20.0, -1.0}}, "bob");
    scene.add(Distance{Fixed<3>{{0.0, 20.0, 0.0}}, bob, 1.0}, "rod");
    scene.add(force_law(points(bob), [](auto, auto v) { return vec(-v.x(), -v.y(), -v.z()); }));
    const auto modes = modes_of(scene);
    EXPECT_EQ(modes.stability(), other > 3.0 ? Stability::stable : Stability::unstable) << modes.describe();
  }
}

TEST(Reversible, BicycleIsDecidedByItsEigenvalues) {
  for (const double speed : {4.0, 5.0, 7.0}) {
    const auto modes = modes_of(models::WhippleBicycle{.speed = speed}.scene().scene);
    EXPECT_EQ(modes.stability(), speed == 5.0 ? Stability::stable : Stability::unstable);
    EXPECT_THAT(modes.describe(), testing::Not(HasSubstr("mirror")));
  }
}

/// Chaplygin's sleigh: a knife edge a behind the centre of mass, along the body.
Scene<2> sleigh(double speed, double arm, double turning, double direction) {
  const Vec<2> e(std::cos(direction), std::sin(direction)), across(-e.y(), e.x());
  Scene<2> scene("sleigh");
  const auto body = add_body(scene,
                             {.mass = 1.0,
                              .inertia = 0.2,
                              .centre = arm * e,
                              .angle = direction,
                              .velocity = speed * e + arm * turning * across,
                              .angular_velocity = turning},
                             "sleigh");
  scene.add(nonholonomic(points(body.point({-arm, 0.0}), body.point({1.0 - arm, 0.0})),
                         [](auto r, auto ahead, auto v, auto) {
                           const auto along = (ahead - r).eval();
                           return along.x() * v.y() - along.y() * v.x();
                         }),
            "edge");
  return scene;
}

TEST(Reversible, SleighGoesOnStraightWithItsEdgeBehindOnly) {
  // With v along and w its turning, (J + m a^2) w' = -m a v w: the rest of the eigenvalues are 0.
  for (const double direction : {0.0, 0.7}) {
    for (const double v : {2.0, -2.0}) {
      const auto modes = modes_of(sleigh(v, 0.3, 0.0, direction));
      EXPECT_EQ(modes.stability(), v > 0.0 ? Stability::stable : Stability::unstable) << modes.describe();
      const double s = -0.3 * v / (0.2 + 0.09);
      EXPECT_NEAR(modes.eigenvalue(modes.size() - 1).real(), s, 1e-12);
    }
    // With the edge below the centre both are constant: each state near is one of a steady motion.
    for (const double turning : {0.0, 1.5})
      EXPECT_EQ(modes_of(sleigh(2.0, 0.0, turning, direction)).stability(), Stability::stable);
  }
}

TEST(Reversible, SleighLosesItsStabilityWhereItStandsStill) {
  const auto diagram = follow_steady<2>(
      [](double speed) { return PosedSteady<2>{sleigh(speed, 0.3, 0.0, 0.0)}; }, {.from = -2.0, .to = 2.1});
  ASSERT_EQ(diagram.bifurcations.size(), 1U);
  EXPECT_NEAR(diagram.bifurcations[0].parameter, 0.0, 1e-12);
  EXPECT_EQ(diagram.branches.at(0).why, "");
}

TEST(Reversible, WhatHasNoForceAtRestIsSteadyAsItMoves) {
  // A thrust along the way that balances the drag: m' u' = -0.1 u of the speed, m' = m + C/r^2 = 1.5.
  const auto modes = modes_of(pushed(2.0, [](const auto&, const auto& v) {
    const auto speed = sqrt(v.x() * v.x() + v.y() * v.y() + v.z() * v.z());
    return ((0.1 * 0.5 * 2.0 * std::sqrt(g / 1.5) / speed - 0.1) * v).eval();
  }));
  double nearest = 1.0;
  for (std::size_t k = 0; k < modes.size(); ++k)
    nearest = std::min(nearest, std::abs(modes.eigenvalue(k) + 0.1 / 1.5));
  EXPECT_LT(nearest, 1e-10);
}

TEST(Reversible, WhatNoForceBendsIsSteady) {
  // Its stiffness, and what would have to balance, are round-off of nothing.
  for (const double turning : {0.0, 2.0}) {
    for (const double v : {0.0, 1.0}) {
      Scene<2> plane("plane");
      add_body(plane,
               BodyState<2>{.mass = 1.0, .inertia = 0.2, .velocity = {v, 0.0}, .angular_velocity = turning},
               "body");
      EXPECT_EQ(modes_of(plane).stability(), Stability::stable) << turning << ' ' << v;
      Scene<3> space("space");
      add_body(space,
               BodyState<3>{.mass = 1.0,
                            .inertia = {0.2, 0.2, 0.1},
                            .velocity = {v, 0.0, 0.0},
                            .angular_velocity = {0.0, 0.0, turning}},
               "body");
      EXPECT_EQ(modes_of(space).stability(), Stability::stable) << turning << ' ' << v;
    }
  }
}

}  // namespace
}  // namespace dalembert::reversible_test
