#include <dalembert/dalembert.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace dalembert::branches_symmetric_test {
namespace {

using testing::HasSubstr;

/// Bifurcations, over their parameter, are where an eigenvalue with a slope of order 1 is round-off.
constexpr double located = 1e-12;
/// Points of a branch are in balance to 1e-10 of the forces.
constexpr double on_branch = 1e-10;

/// Two links of l with torsion springs k at the ground and between them, upright under the dead load P:
/// V = k (a^2 + (b - a)^2)/2 + P l (cos a + cos b) with the angles a, b from upright,
///
///   k (2 a - b) = P l sin a,   k (b - a) = P l sin b                                                  (1)
///
/// which buckles at P l/k = (3 -+ sqrt 5)/2.
struct Column {
  double k, l;
  BodyPoint<2> hinge{}, tip{};

  Diagram<Equilibrium<2>> follow(const BranchOptions& options) {
    return follow_branches<2>(
        [this](double P) {
          const double upright = std::numbers::pi / 2.0;
          Scene<2> scene("column");
          const auto a = add_body(
              scene,
              BodyState<2>{.mass = 1.0, .inertia = 0.1 * l * l, .centre = {0.0, l / 2.0}, .angle = upright},
              "a");
          const auto b = add_body(
              scene, {.mass = 1.0, .inertia = 0.1 * l * l, .centre = {0.0, 1.5 * l}, .angle = upright}, "b");
          const auto ground = add_joint(scene, Revolute{Ground<2>{}, a, Vec<2>(0.0, 0.0)});
          const auto knee = add_joint(scene, Revolute{a, b, Vec<2>(0.0, l)});
          scene.add(TorsionSpring{ground, k});
          scene.add(TorsionSpring{knee, k});
          hinge = a.point_at({0.0, l});
          tip = b.point_at({0.0, 2.0 * l});
          scene.add(potential(points(tip), [P](auto r) { return P * r.y(); }));
          return Posed<2>{std::move(scene)};
        },
        options);
  }
};

TEST(Branches, OfAColumnOfTwoLinksForkAtBothOfItsBucklingLoads) {
  const double lower = (3.0 - std::sqrt(5.0)) / 2.0, upper = (3.0 + std::sqrt(5.0)) / 2.0;
  for (const double unit : {1.0, 1e3}) {  // m and mm
    for (const double step : {0.01, 0.02, 0.05, 0.1}) {
      Column column{.k = 5.0 * unit * unit, .l = 0.4 * unit};
      const double load = column.k / column.l;
      const auto found = column.follow({.from = 0.1 * load, .to = 4.0 * load, .step = step});
      EXPECT_TRUE(found.folds.empty()) << unit << ' ' << step;
      ASSERT_EQ(found.bifurcations.size(), 2U) << unit << ' ' << step;
      EXPECT_NEAR(found.bifurcations[0].parameter / load, lower, 10.0 * located);
      EXPECT_NEAR(found.bifurcations[1].parameter / load, upper, 10.0 * located);
      ASSERT_EQ(found.branches.size(), 5U);
      for (const auto& branch : found.branches) {
        EXPECT_EQ(branch.end, BranchEnd::range) << branch.why;
        double sideways = 0.0;
        for (const auto& point : branch.points) {
          const auto at = point.state.sample();
          const Vec<2> r = at.position(column.hinge), along = at.position(column.tip) - r;
          const double a = std::atan2(r.x(), r.y()), turned = std::atan2(along.x(), along.y()),
                       b = turned +
                           2.0 * std::numbers::pi * std::round((a - turned) / (2.0 * std::numbers::pi)),
                       P = point.parameter / load;
          sideways = std::max(sideways, std::abs(a));
          EXPECT_NEAR(2.0 * a - b, P * std::sin(a), 1e2 * on_branch);
          EXPECT_NEAR(b - a, P * std::sin(b), 1e2 * on_branch);
        }
        EXPECT_EQ(sideways > 0.1, branch.origin != no_bifurcation);
      }
    }
  }
}

/// A mass on a rod of l upon a spherical joint, upright along an axis, under the load P along it and a spring
/// k across: V = P z + k (x^2 + y^2)/2. Beyond P = k l it is stable upright; there a family leaves, tilted by
/// cos = P/(k l) in any direction.
struct Sphere {
  double k, l;
  Vec<3> axis{0.0, 0.0, 1.0};
  std::vector<Particle<3>> tips{};

  Posed<3> scene(double P, int count = 1) {
    Scene<3> scene("columns");
    tips.clear();
    for (int i = 0; i < count; ++i) {
      const Vec<3> foot{10.0 * l * i, 0.0, 0.0}, up = axis;
      tips.push_back(scene.add_particle({.mass = 2.0, .position = foot + l * up}));
      scene.add(Distance{Fixed<3>{foot}, tips.back(), l});
      scene.add(potential(points(tips.back()), [P, foot, up, k = k](auto r) {
        const auto from = r - foot;
        const auto z = from.dot(up);
        return P * z + 0.5 * k * (from.squaredNorm() - z * z);
      }));
    }
    return {std::move(scene)};
  }
};

TEST(Branches, UpToASymmetryAreOneInAnyUnitOfLength) {
  for (const Vec<3>& axis : {Vec<3>(0.0, 0.0, 1.0), Vec<3>(Vec<3>(1.0, 2.0, 2.0) / 3.0)}) {
    for (const double unit : {1.0, 1e3, 1e-6, 1e-9, 1e5}) {
      Sphere column{.k = 3.0, .l = 0.7 * unit, .axis = axis};
      const double load = column.k * column.l;
      const auto found = follow_branches<3>([&](double P) { return column.scene(P); },
                                            {.from = 0.5 * load, .to = 1.5 * load});
      ASSERT_EQ(found.bifurcations.size(), 1U) << unit;
      EXPECT_NEAR(found.bifurcations[0].parameter / load, 1.0, located);
      EXPECT_TRUE(found.folds.empty());
      ASSERT_EQ(found.branches.size(), 2U) << unit;
      for (const auto& branch : found.branches) {
        EXPECT_EQ(branch.end, BranchEnd::range) << branch.why;
        EXPECT_TRUE(branch.why.empty()) << branch.why;
        const bool upright = branch.origin == no_bifurcation;
        for (const auto& point : branch.points) {
          const double P = point.parameter / load;
          const auto r = point.state.sample().position(column.tips[0]);
          EXPECT_NEAR(r.dot(axis) / column.l, upright ? 1.0 : P, on_branch);
          // Over the mass: k (1 - P/(k l)) upright, else -k sin^2, of the tilt.
          EXPECT_NEAR(point.softest / column.k * 2.0, upright ? 1.0 - P : P * P - 1.0, 1e2 * on_branch);
        }
      }
    }
  }
}

TEST(Branches, OfTwoSymmetricPartsAreOneOfEachAndOneOfBoth) {
  Sphere columns{.k = 3.0, .l = 0.7};
  const double load = columns.k * columns.l;
  const auto found = follow_branches<3>([&](double P) { return columns.scene(P, 2); },
                                        {.from = 0.5 * load, .to = 1.5 * load, .step = 0.05});
  ASSERT_EQ(found.bifurcations.size(), 1U);
  EXPECT_EQ(found.branches.size(), 4U);
}

TEST(Branches, OfACentralPotentialAreOneOfEveryDirection) {
  // p r^2/2 + r^4/4: r^2 = -p, on a sphere.
  Particle<3> mass;
  const auto found = follow_branches<3>(
      [&](double p) {
        Scene<3> scene("central");
        mass = scene.add_particle({.mass = 1.0});
        scene.add(potential(points(mass), [p](auto r) {
          const auto square = r.squaredNorm();
          return 0.5 * p * square + 0.25 * square * square;
        }));
        return Posed<3>{std::move(scene)};
      },
      {.from = 1.0, .to = -1.0});
  ASSERT_EQ(found.bifurcations.size(), 1U);
  ASSERT_EQ(found.branches.size(), 2U);
  for (const auto& point : found.branches[1].points)
    EXPECT_NEAR(point.state.sample().position(mass).squaredNorm(), -point.parameter, on_branch);
}

TEST(Branches, OfADoublePendulumThatTurnsFreelyAreThoseInAPlane) {
  // Omega^2 = g (2 -+ sqrt 2)/l; relative equilibria carried around the vertical are the same branch.
  const double g = 9.81;
  for (const double step : {0.02, 0.05}) {
    const auto found = follow_branches<3>(
        [g](double Omega) {
          Scene<3> scene("double pendulum");
          scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
          const auto a = scene.add_particle({.mass = 1.0, .position = {0.0, 0.0, -1.0}}),
                     b = scene.add_particle({.mass = 1.0, .position = {0.0, 0.0, -2.0}});
          scene.add(Distance{Fixed<3>{}, a, 1.0});
          scene.add(Distance{a, b, 1.0});
          return Posed<3>{std::move(scene), {.turning = {.rate = {0.0, 0.0, Omega}}}};
        },
        {.from = 1.0, .to = 8.0, .step = step});
    ASSERT_EQ(found.bifurcations.size(), 2U) << step;
    EXPECT_NEAR(found.bifurcations[0].parameter, std::sqrt(g * (2.0 - std::sqrt(2.0))), 10.0 * located);
    EXPECT_NEAR(found.bifurcations[1].parameter, std::sqrt(g * (2.0 + std::sqrt(2.0))), 10.0 * located);
    EXPECT_EQ(found.branches.size(), 3U) << step;
  }
}

/// Rotors that nothing couples, with the potentials V_i(x, p).
Diagram<Equilibrium<2>> follow_rotors(int count, const auto& V, const BranchOptions& options) {
  return follow_branches<2>(
      [&](double p) {
        Scene<2> scene("rotors");
        for (int i = 0; i < count; ++i) {
          const auto rotor = scene.add_rotor({.inertia = 1.0});
          scene.add(potential(points(rotor), [p, i, &V](auto x) { return V(i, x[0], p); }));
        }
        return Posed<2>{std::move(scene)};
      },
      options);
}

TEST(Branches, TurnBackWhereTheForcesOfOneLawCancel) {
  // p = x^3 - x, folds where x^2 = 1/3.
  const auto found =
      follow_rotors(1, [](int, auto x, double p) { return 0.25 * x * x * x * x - 0.5 * x * x - p * x; },
                    {.from = -1.0, .to = 1.0});
  EXPECT_TRUE(found.bifurcations.empty());
  ASSERT_EQ(found.folds.size(), 2U);
  const double limit = 2.0 / (3.0 * std::sqrt(3.0));
  EXPECT_NEAR(found.folds[0].parameter, limit, located);
  EXPECT_NEAR(found.folds[1].parameter, -limit, located);
}

TEST(Branches, SayThatOthersMayEmanateWhereTwoShapesFork) {
  // Which are found hangs on the axes of the null space. One shape with all that a symmetry makes of it is
  // none of that, see UpToASymmetryAreOneInAnyUnitOfLength.
  const auto found =
      follow_rotors(2, [](int, auto x, double p) { return -0.5 * (p - 1.0) * x * x + 0.25 * x * x * x * x; },
                    {.from = 0.5, .to = 1.5});
  ASSERT_EQ(found.bifurcations.size(), 1U);
  EXPECT_THAT(found.branches[0].why, HasSubstr("2 eigenvalues are 0 at once: more branches may emanate"));
}

TEST(Branches, ThatAreNotFollowedAreListed) {
  // Five pitchforks one after the other: 3^5 branches at the end.
  const auto found = follow_rotors(
      5, [](int i, auto x, double p) { return -0.5 * (p - 0.1 * (i + 1)) * x * x + 0.25 * x * x * x * x; },
      {.from = 0.0, .to = 1.0, .step = 0.05});
  ASSERT_GT(found.branches.size(), 50U);
  EXPECT_EQ(found.branches[0].end, BranchEnd::range);
  EXPECT_EQ(found.branches.back().end, BranchEnd::lost);
  EXPECT_THAT(found.branches.back().why, HasSubstr("not followed"));
}

TEST(Branches, ThatJumpToAnotherSaySo) {
  // (p - 1) x - x^3 + 1e-9 = 0: a step leads past the point where the stable branch bends aside.
  const auto found = follow_rotors(
      1, [](int, auto x, double p) { return -0.5 * (p - 1.0) * x * x + 0.25 * x * x * x * x - 1e-9 * x; },
      {.from = 0.0, .to = 2.0});
  EXPECT_TRUE(found.bifurcations.empty());
  EXPECT_TRUE(found.folds.empty());
  EXPECT_THAT(found.branches[0].why, HasSubstr("not located"));
}

TEST(Branches, OfAGovernorOnBallJointsForkOnce) {
  // Two balls m on rods of l from a point, with rods of l to a sleeve M on the axis: they leave the axis at
  // Omega^2 = (m + M) g/(m l). Their azimuths are free against each other.
  constexpr double m = 1.0, M = 2.0, l = 1.0, g = 9.81;
  const auto found = follow_branches<3>(
      [](double Omega) {
        Scene<3> scene("governor");
        scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
        const double x = l * std::sin(0.5), z = -l * std::cos(0.5);
        const auto sleeve = scene.add_particle({.mass = M, .position = {0.0, 0.0, 2.0 * z}}, "sleeve");
        for (const double side : {1.0, -1.0}) {
          const auto ball = scene.add_particle({.mass = m, .position = {side * x, 0.0, z}});
          scene.add(Distance{Fixed<3>{}, ball, l});
          scene.add(Distance{ball, sleeve, l});
        }
        scene.add(OnSurface{sleeve, Plane<3>{.normal = {1.0, 0.0, 0.0}}});
        scene.add(OnSurface{sleeve, Plane<3>{.normal = {0.0, 1.0, 0.0}}});
        return Posed<3>{std::move(scene), {.turning = {.rate = {0.0, 0.0, Omega}}}};
      },
      {.from = 7.0, .to = 2.0});
  ASSERT_EQ(found.bifurcations.size(), 1U);
  EXPECT_NEAR(found.bifurcations[0].parameter / std::sqrt((m + M) * g / (m * l)), 1.0, 10.0 * located);
  EXPECT_EQ(found.branches.size(), 3U);
}

}  // namespace
}  // namespace dalembert::branches_symmetric_test
