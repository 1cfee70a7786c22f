#include <dalembert/dalembert.h>
#include <dalembert/models/governor.h>
#include <dalembert/models/hoop_about_diameter.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace dalembert::branches_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Bifurcations are where an eigenvalue that crosses 0 with a slope of order 10 is round-off of order 1e-13.
constexpr double located = 1e-12;
/// Points of a branch are in balance to 1e-10 of the forces, and by Newton's iteration its square root
/// better.
constexpr double on_branch = 1e-10;

TEST(Branches, BeadOnATurningHoopForksWhereItIsThrownOut) {
  // mex39: Omega^2 = g/R, beyond which cos phi0 = g/(R Omega^2).
  Particle<3> bead;
  const auto diagram = follow_branches<3>(
      [&bead](double Omega) {
        auto built = models::HoopAboutDiameter{.spin = Omega, .angle = 0.0}.scene();
        bead = built.bead;
        return Posed<3>{std::move(built.scene), {.turning = {.rate = {0.0, 0.0, Omega}}}};
      },
      {.from = 2.0, .to = 6.0});
  ASSERT_EQ(diagram.bifurcations.size(), 1U);
  EXPECT_NEAR(diagram.bifurcations[0].parameter, std::sqrt(9.81), located);
  EXPECT_TRUE(diagram.folds.empty());
  ASSERT_EQ(diagram.branches.size(), 3U);
  double side = 0.0;
  for (const auto& branch : diagram.branches) {
    const bool at_bottom = branch.origin == no_bifurcation;
    EXPECT_NEAR(branch.points.back().parameter, 6.0, on_branch);
    for (const auto& point : branch.points) {
      const double Omega2 = point.parameter * point.parameter;
      const double cosine = at_bottom ? 1.0 : 9.81 / Omega2;
      EXPECT_NEAR(-point.state.sample().position(bead).z(), cosine, on_branch);
      // The stiffness is omega^2: g/R - Omega^2 at the bottom, else Omega^2 sin^2 phi0.
      EXPECT_NEAR(point.softest, at_bottom ? 9.81 - Omega2 : Omega2 * (1.0 - cosine * cosine),
                  1e2 * on_branch);
    }
    if (!at_bottom) side += branch.points.back().state.sample().position(bead).x();
  }
  EXPECT_NEAR(side, 0.0, on_branch);  // one to either side
}

TEST(Branches, GovernorLeavesTheAxisAtItsThreshold) {
  // mex23: Omega^2 = (m1 + m2) g/(m1 L). On the axis the four rods are dependent on each other, and each of
  // the masses may go to either side: four branches.
  models::GovernorParts parts;
  const auto diagram = follow_branches<3>(
      [&parts](double Omega) {
        auto built = models::Governor{.spin = Omega, .angle = 0.0}.scene();
        parts = built.parts;
        return Posed<3>{std::move(built.scene), {.turning = {.rate = {0.0, 0.0, Omega}}}};
      },
      {.from = 2.0, .to = 9.0});
  ASSERT_EQ(diagram.bifurcations.size(), 1U);
  EXPECT_NEAR(diagram.bifurcations[0].parameter, std::sqrt(3.0 * 9.81), located);
  ASSERT_EQ(diagram.branches.size(), 5U);
  for (std::size_t b = 1; b < 5; ++b) {
    EXPECT_EQ(diagram.branches[b].origin, 0U);
    for (const auto& point : diagram.branches[b].points) {
      const double cosine = 3.0 * 9.81 / (point.parameter * point.parameter);
      EXPECT_NEAR(-point.state.sample().position(parts.masses[0]).z(), cosine, on_branch);
      EXPECT_NEAR(-point.state.sample().multiplier(parts.upper[1]), 2.0 * 9.81 / cosine, 1e3 * on_branch);
      EXPECT_GT(point.softest, 0.0);
    }
  }
}

TEST(Branches, ShallowArchTurnsBackWhereItSnaps) {
  // A point on two springs from (+-1, 0), of stiffness k and relaxed length l0 = sqrt(1 + h^2), under the
  // load p: p = 2 k y (l0/l - 1), l^2 = 1 + y^2; dp/dy = 0 at l^3 = l0, where p = 2 k (l0^(2/3) - 1)^(3/2).
  const double k = 10.0, h = 0.5, l0 = std::sqrt(1.0 + h * h);
  const double snap = 2.0 * k * std::pow(std::cbrt(l0 * l0) - 1.0, 1.5);
  Particle<2> top;
  const auto diagram = follow_branches<2>(
      [&](double load) {
        Scene<2> scene("arch");
        scene.add(UniformGravity<2>{{0.0, -load}});
        top = scene.add_particle({.mass = 1.0, .position = {0.0, h}});
        scene.add(OnCurve{top, Plane<2>{.normal = {1.0, 0.0}}});
        for (const double side : {1.0, -1.0}) scene.add(Spring{Fixed<2>{{side, 0.0}}, top, k, l0});
        return Posed<2>{std::move(scene)};
      },
      {.from = -0.5 * snap, .to = 2.0 * snap});
  ASSERT_EQ(diagram.folds.size(), 1U);
  // At a fold the load is flat: the place is known to round-off, its load to the square of that.
  EXPECT_NEAR(diagram.folds[0].parameter, snap, located);
  EXPECT_TRUE(diagram.bifurcations.empty());
  ASSERT_EQ(diagram.branches.size(), 1U);
  const auto& points = diagram.branches[0].points;
  EXPECT_NEAR(points.back().parameter, -0.5 * snap, on_branch);  // it has come back
  EXPECT_GT(points.front().softest, 0.0);
  EXPECT_LT(points.back().softest, 0.0);
  for (const auto& point : points) {
    const double y = point.state.sample().position(top).y(), l = std::sqrt(1.0 + y * y);
    EXPECT_NEAR(point.parameter, 2.0 * k * y * (l0 / l - 1.0), 1e2 * on_branch);
  }
}

/// A bead of mass 1 on a line, on a spring of 1 under a load, which it follows: x = load.
struct Loaded {
  Particle<2> bead{};
  Force spring{};

  Diagram<Equilibrium<2>> follow(const auto& load, const BranchOptions& options) {
    return follow_branches<2>(
        [this, &load](double p) {
          Scene<2> scene("loaded");
          bead = scene.add_particle({.mass = 1.0 + p, .position = {0.0, 1.0}});
          scene.add(OnCurve{bead, [](auto r) { return r.y() - 1.0; }});
          const double f = load(p);
          spring = scene.add(
              potential(points(bead, Fixed<2>{}), [](auto r, auto) { return 0.5 * r.x() * r.x(); }));
          scene.add(potential(points(bead), [f](auto r) { return -f * r.x(); }));
          return Posed<2>{std::move(scene)};
        },
        options);
  }
};

/// x + x^3 = P has no fold, x^3 - x = P two, where |P| = 2/(3 sqrt 3) and x^2 = 1/3.
TEST(Branches, OfALoneParticleHaveTheFoldsOfItsForce) {
  for (const double x : {-1.5, -1.0, 1.2})
    for (const double from : {-2.0, -1.0, -0.7, 0.6}) {
      for (const double sign : {1.0, -1.0}) {
        const auto diagram = follow_branches<2>(
            [&](double P) {
              Scene<2> scene;
              const auto p = scene.add_particle({.mass = 1.0, .position = {x, 0.0}}, "p");
              scene.add(OnCurve{p, Plane<2>{}});
              scene.add(potential(points(p), [=](auto r) {
                const auto square = r.x() * r.x();
                return 0.25 * square * square + 0.5 * sign * square - P * r.x();
              }));
              return Posed<2>{std::move(scene)};
            },
            {.from = from, .to = -from});
        ASSERT_EQ(diagram.folds.size(), sign > 0.0 ? 0U : 2U) << x << ' ' << from;
        for (const auto& fold : diagram.folds)
          EXPECT_NEAR(std::abs(fold.parameter), 2.0 / (3.0 * std::sqrt(3.0)), located) << x << ' ' << from;
      }
    }
}

TEST(Branches, BeginAlongThemselvesHoweverSteep) {
  // dx/dp = 10 ranges: far from the axis of the parameter.
  Loaded loaded;
  const auto diagram = loaded.follow([](double p) { return p; }, {.from = 0.0, .to = 10.0});
  ASSERT_EQ(diagram.branches.size(), 1U);
  const auto& branch = diagram.branches[0];
  EXPECT_EQ(branch.end, BranchEnd::range);
  EXPECT_NEAR(branch.points.back().parameter, 10.0, located);
  for (const auto& point : branch.points)
    EXPECT_NEAR(point.state.sample().position(loaded.bead).x(), point.parameter, 10.0 * on_branch);
}

TEST(Branches, ShortFirstStepsDoNotCloseThem) {
  // x = 20 p^2 begins flat and bends at once, so that the first steps are halved.
  Loaded loaded;
  const auto diagram = loaded.follow([](double p) { return 20.0 * p * p; }, {.from = 0.0, .to = 1.0});
  ASSERT_EQ(diagram.branches.size(), 1U);
  EXPECT_EQ(diagram.branches[0].end, BranchEnd::range);
  EXPECT_NEAR(diagram.branches[0].points.back().parameter, 1.0, located);
  // 5,000 points of a step of 0.02 do not reach x = 1000.
  const auto steep = loaded.follow([](double p) { return 1000.0 * p * p; }, {.from = 0.0, .to = 1.0});
  EXPECT_EQ(steep.branches[0].end, BranchEnd::most_points);
}

TEST(Branches, HaveTheForcesAndMassesOfTheirOwnValueOfTheParameter) {
  Loaded loaded;
  const auto diagram = loaded.follow([](double p) { return p; }, {.from = 1.0, .to = 2.0, .step = 0.2});
  for (const auto& point : diagram.branches[0].points) {
    const auto sample = point.state.sample();
    EXPECT_NEAR(sample.force(loaded.spring, loaded.bead).x(), -point.parameter, 10.0 * on_branch);
    EXPECT_EQ(point.state.layout().particles[0].mass, 1.0 + point.parameter);
  }
}

TEST(Branches, AskForNoSceneOutsideOfTheirRange) {
  double least = 2.0, most = 1.0;
  Loaded loaded;
  const auto diagram = loaded.follow(
      [&](double p) {
        least = std::min(least, p);
        most = std::max(most, p);
        return p;
      },
      {.from = 1.0, .to = 2.0});
  EXPECT_NEAR(diagram.branches[0].points.back().parameter, 2.0, located);
  EXPECT_EQ(least, 1.0);
  EXPECT_EQ(most, 2.0);
}

/// V = (P0 + 1/2 - P) x^2/2 + x^4/4 forks at P0 + 1/2 into x = 0 and x^2 = P - P0 - 1/2. In its stiffness
/// P0 cancels: what is left of it has the roundings of P0.
TEST(Branches, ForkWhereverTheRangeOfTheParameterLies) {
  for (const double first : {0.0, 3.0, 30.0, -100.0, 1e4}) {
    Rotor rotor;
    const auto diagram = follow_branches<2>(
        [&](double P) {
          Scene<2> scene("quartic");
          rotor = scene.add_rotor({.inertia = 1.0});
          const double k = first + 0.5 - P;
          scene.add(potential(points(rotor), [k](auto x) {
            const auto square = x[0] * x[0];
            return 0.5 * k * square + 0.25 * square * square;
          }));
          return Posed<2>{std::move(scene)};
        },
        {.from = first, .to = first + 1.0});
    ASSERT_EQ(diagram.branches.size(), 3U) << first;
    const double known = 1e-10 + 10.0 * std::abs(first) * std::numeric_limits<double>::epsilon();
    for (std::size_t b = 1; b < 3; ++b) {
      for (const auto& point : diagram.branches[b].points) {
        const double x = point.state.sample().angle(rotor);
        EXPECT_NEAR(x * x, point.parameter - first - 0.5, known) << first;
      }
      EXPECT_EQ(diagram.branches[b].end, BranchEnd::range);
    }
  }
}

TEST(Branches, RefuseOptionsAndScenesThatMakeNoSense) {
  const auto pendulum = [](double) {
    Scene<2> scene("pendulum");
    const auto bob = scene.add_particle({.mass = 1.0, .position = {0.0, -1.0}});
    scene.add(Distance{Fixed<2>{}, bob, 1.0});
    return Posed<2>{std::move(scene)};
  };
  EXPECT_THAT([&] { (void)follow_branches<2>(pendulum, {.from = 1.0, .to = 1.0}); },
              ThrowsMessage<InvalidArgument>(HasSubstr("different")));
  EXPECT_THAT([&] { (void)follow_branches<2>(pendulum, {.from = 0.0, .to = 1.0, .step = 2.0}); },
              ThrowsMessage<InvalidArgument>(HasSubstr("step")));
  const auto changing = [](double parameter) {
    Scene<2> scene("changing");
    scene.add_particle({.mass = 1.0});
    if (parameter > 0.5) scene.add_particle({.mass = 1.0});
    return Posed<2>{std::move(scene)};
  };
  EXPECT_THAT([&] { (void)follow_branches<2>(changing, {.from = 0.0, .to = 1.0}); },
              ThrowsMessage<InvalidScene>(HasSubstr("other points")));
  const auto thrown = [&](const std::function<Posed<2>(double)>& build, const std::string& what) {
    EXPECT_THAT([&] { (void)follow_branches<2>(build, {.from = 0.0, .to = 1.0}); },
                ThrowsMessage<InvalidScene>(
                    testing::AllOf(HasSubstr("function that builds the scene"), HasSubstr(what))));
  };
  thrown([](double) -> Posed<2> { throw std::runtime_error("mine"); }, "\"mine\" at parameter = 0");
  thrown([](double) -> Posed<2> { throw 3; }, "no std::exception");
  thrown({}, "threw");
  const auto skate = [](double) {
    Scene<2> scene("skate");
    const auto blade = scene.add_particle({.mass = 1.0});
    scene.add(nonholonomic(points(blade), [](auto, auto v) { return v.y(); }), "edge");
    return Posed<2>{std::move(scene), {.turning = {.rate = 1.0}}};
  };
  EXPECT_THAT([&] { (void)follow_branches<2>(skate, {.from = 0.0, .to = 1.0}); },
              ThrowsMessage<InvalidScene>(HasSubstr("follow_steady")));
}

TEST(Branches, SkateForksWhereTheSpringAlongItsBladeSoftens) {
  // The blade at (x, y) points along x, held there by a spring that turns it. Along it p x + x^3 = 0: x = 0,
  // and from p = 0 on x^2 = -p; across it the spring of y is taken up, at any y.
  constexpr double arm = 0.4;
  BodyPoint<2> blade;
  Constraint<1> edge;
  const auto diagram = follow_branches<2>(
      [&](double p) {
        Scene<2> scene("skate");
        const auto body = add_body(scene, {.mass = 2.0, .inertia = 0.1, .centre = {arm, 0.3}}, "skate");
        blade = body.point({-arm, 0.0});
        edge = scene.add(KnifeEdge{blade, blade, body.centre()}, "blade");
        scene.add(potential(points(blade, body.centre()), [p](auto b, auto c) {
          const auto turned = c.y() - b.y(), square = b.x() * b.x();
          return 0.5 * p * square + 0.25 * square * square + 0.5 * b.y() * b.y() + 20.0 * turned * turned;
        }));
        return Posed<2>{std::move(scene)};
      },
      {.from = 0.5, .to = -0.5});
  ASSERT_EQ(diagram.bifurcations.size(), 1U);
  EXPECT_NEAR(diagram.bifurcations[0].parameter, 0.0, 1e2 * located);
  EXPECT_TRUE(diagram.folds.empty());
  EXPECT_TRUE(diagram.flutters.empty());
  ASSERT_EQ(diagram.branches.size(), 3U);
  double sides = 0.0;
  for (const auto& branch : diagram.branches) {
    EXPECT_EQ(branch.end, BranchEnd::range) << branch.why;
    for (const auto& point : branch.points) {
      const auto at = point.state.sample();
      const Vec<2> b = at.position(blade);
      EXPECT_NEAR(b.x() * b.x(), branch.origin == no_bifurcation ? 0.0 : -point.parameter, 1e2 * on_branch);
      EXPECT_NEAR(std::abs(at.multiplier(edge)), std::abs(b.y()), 1e2 * on_branch);
    }
    sides += branch.points.back().state.sample().position(blade).x();
  }
  EXPECT_NEAR(sides, 0.0, 1e2 * on_branch);
}

/// A pendulum upside down on a torsion spring of stiffness 5: 5 theta = g sin theta, two branches from g = 5.
Posed<2> propped(double g, Particle<2>& bob, double stiffness_beside, bool repeats_the_rod) {
  Scene<2> scene("propped");
  bob = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}}, "bob");
  scene.add(PointGravity{bob, 1.0, Vec<2>(0.0, -g)}, "weight");
  scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");
  scene.add(potential(points(bob),
                      [](auto r) {
                        const auto theta = atan2(r.x(), r.y());
                        return 2.5 * theta * theta;
                      }),
            "torsion spring");
  if (repeats_the_rod)
    scene.add(nonholonomic(points(bob), [](auto r, auto v) { return r.dot(v); }), "rod of velocities");
  if (stiffness_beside > 0.0) {
    const auto hub = scene.add_particle({.mass = 1.0, .position = {5.0, 0.0}}, "hub");
    const auto wheel = scene.add_rotor({.inertia = 1.0}, "wheel");
    scene.add(OnCurve{hub, Plane<2>{}}, "floor");
    scene.add(Spring{Fixed<2>{{5.0, 0.0}}, hub, stiffness_beside}, "spring");
    scene.add(nonholonomic(points(hub, wheel), [](auto, auto, auto v, auto w) { return v.x() - 0.5 * w[0]; }),
              "rolls");
  }
  return {std::move(scene)};
}

TEST(Branches, ForkWhereStiffnessCancelsBesideNonholonomicConstraints) {
  // At g = 5 nothing is left of the stiffness, and what is across it is round-off of its terms.
  struct Beside {
    double stiffness;
    bool repeats_the_rod;
  };
  for (const Beside beside : {Beside{0.0, true}, {1e-6, false}, {1.0, false}, {1e6, false}}) {
    for (const double from : {0.7, 1.0, 2.0}) {
      Particle<2> bob;
      const auto diagram = follow_branches<2>(
          [&](double g) { return propped(g, bob, beside.stiffness, beside.repeats_the_rod); },
          {.from = from, .to = 8.0});
      ASSERT_EQ(diagram.bifurcations.size(), 1U) << beside.stiffness << ' ' << from;
      EXPECT_NEAR(diagram.bifurcations[0].parameter, 5.0, 10 * located);
      EXPECT_TRUE(diagram.flutters.empty());
      ASSERT_EQ(diagram.branches.size(), 3U);
      double sides = 0.0;
      for (const auto& branch : diagram.branches) {
        for (const auto& point : branch.points) {
          const Vec<2> r = point.state.sample().position(bob);
          EXPECT_NEAR(5.0 * std::atan2(r.x(), r.y()), point.parameter * r.x(), 10 * on_branch);
        }
        sides += branch.points.back().state.sample().position(bob).x();
      }
      EXPECT_NEAR(sides, 0.0, on_branch);  // one to either side
      EXPECT_GT(std::abs(diagram.branches[1].points.back().state.sample().position(bob).x()), 0.5);
    }
  }
}

/// A top on two bars of stiffness 1 from (-1, 0) and (1, 0), of length L0 without a load, which is dead: the
/// stiffness does not depend on it. Beside it a sledge, which nothing couples.
Posed<2> truss_beside_a_sledge(double load, double height, bool rail) {
  Scene<2> scene("truss");
  const auto top = scene.add_particle({.mass = 1.0, .position = {0.0, height}}, "top");
  scene.add(potential(points(top), [=](auto r) {
    const double L0 = std::hypot(1.0, height);
    const auto right = sqrt((r.x() - 1.0) * (r.x() - 1.0) + r.y() * r.y()) - L0,
               left = sqrt((r.x() + 1.0) * (r.x() + 1.0) + r.y() * r.y()) - L0;
    return 0.5 * right * right + 0.5 * left * left + load * r.y();
  }));
  const auto sledge = scene.add_particle({.mass = 1.0, .position = {5.0, 0.0}}, "sledge");
  scene.add(nonholonomic(points(sledge), [](auto, auto v) { return v.y(); }), "edge");
  if (rail) scene.add(OnCurve{sledge, Plane<2>{}}, "rail");
  return {std::move(scene)};
}

/// Where bars of length L no longer hold the top sideways, 1 - L0/L + L0/L^3 = 0, by bisection from below.
double not_held_sideways(double L0, double low, double high) {
  const auto stiffness = [L0](double L) { return 1.0 - L0 / L + L0 / (L * L * L); };
  const bool held = stiffness(low) > 0.0;
  while (std::midpoint(low, high) != low && std::midpoint(low, high) != high)
    ((stiffness(std::midpoint(low, high)) > 0.0) == held ? low : high) = std::midpoint(low, high);
  return low;
}

TEST(Branches, FoldUnderADeadLoadBesideNonholonomicConstraints) {
  // von Mises: in the middle P = 2 y (L0/L - 1), L^2 = 1 + y^2, which is greatest at L = L0^(1/3).
  // Eigenvalues cross 0 with slopes of order 1, a tenth of those that `located` is of.
  for (const double height : {0.5, 3.0}) {
    const double L0 = std::hypot(1.0, height);
    const auto load = [L0](double L) { return 2.0 * std::sqrt(L * L - 1.0) * (L0 / L - 1.0); };
    for (const bool rail : {false, true}) {
      const auto diagram =
          follow_branches<2>([=](double P) { return truss_beside_a_sledge(P, height, rail); },
                             {.from = 0.0, .to = height > 1.0 ? 2.6 : 0.2});
      ASSERT_EQ(diagram.folds.size(), 1U) << height << ' ' << rail;
      EXPECT_NEAR(diagram.folds[0].parameter, load(std::cbrt(L0)), 10 * located);
      EXPECT_TRUE(diagram.flutters.empty());
      std::vector<double> forks;
      for (const auto& fork : diagram.bifurcations) forks.push_back(fork.parameter);
      if (height < 1.0) {
        EXPECT_THAT(forks, testing::IsEmpty());
      } else {
        EXPECT_THAT(forks, testing::UnorderedElementsAre(
                               testing::DoubleNear(load(not_held_sideways(L0, 1.0, 1.5)), 10 * located),
                               testing::DoubleNear(load(not_held_sideways(L0, 2.0, 4.0)), 10 * located)));
      }
    }
  }
}

TEST(Branches, OfABladeForkOnlyWhereTheyAreNotCoupledToMotionsAcrossIt) {
  // Along the blade, x, p x + x^3 = -c y: with c = 0 forks at p = 0; else y balances any x, and only what
  // moves is not stiff there. Something stiff in the same part says nothing of that.
  for (const double stiff : {1.0, 1e7}) {
    for (const double c : {0.0, 1.0}) {
      const auto diagram = follow_branches<2>(
          [=](double p) {
            Scene<2> scene("blade");
            const auto blade = scene.add_particle({.mass = 1.0}, "blade");
            const auto beside = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "beside");
            scene.add(OnCurve{beside, Plane<2>{}});
            scene.add(potential(points(blade, beside), [=](auto r, auto b) {
              const auto square = r.x() * r.x(), off = b.x() - 1.0;
              return 0.5 * p * square + 0.25 * square * square + c * r.x() * r.y() + 0.5 * r.y() * r.y() +
                     0.5 * stiff * off * off;
            }));
            scene.add(nonholonomic(points(blade), [](auto, auto v) { return v.y(); }), "edge");
            return Posed<2>{std::move(scene)};
          },
          {.from = 0.5, .to = -0.5});
      EXPECT_EQ(diagram.bifurcations.size(), c == 0.0 ? 1U : 0U) << stiff;
      EXPECT_EQ(diagram.branches.size(), c == 0.0 ? 3U : 1U) << stiff;
      EXPECT_EQ(diagram.flutters.size(), c == 0.0 ? 0U : 1U) << stiff;
    }
  }
}

/// A bead on a hoop of radius 1 about its vertical diameter, driven at one rate, in a frame of another.
Diagram<Equilibrium<3>> follow_hoop(Particle<3>& bead, const BranchOptions& options, double frame = 0.0) {
  return follow_branches<3>(
      [&](double Omega) {
        auto built = models::HoopAboutDiameter{.spin = Omega, .angle = std::acos(9.81 / 16.0)}.scene();
        bead = built.bead;
        return Posed<3>{std::move(built.scene),
                        {.turning = {.rate = {0.0, 0.0, frame > 0.0 ? frame : Omega}}}};
      },
      options);
}

/// A step is given up below 2e-5 of the range: what lasts to 1e-8 of its speeds and forces ends within.
constexpr double ended = 1e-4;

TEST(Branches, EndWhereTheDriveLeavesTheFrame) {
  // At rest in a frame that turns at 4 is the bead of a hoop that is driven at 4 only.
  Particle<3> bead;
  const auto diagram = follow_hoop(bead, {.from = 4.0, .to = 6.0}, 4.0);
  ASSERT_EQ(diagram.branches.size(), 1U);
  EXPECT_EQ(diagram.branches[0].end, BranchEnd::lost);
  EXPECT_THAT(diagram.branches[0].why, HasSubstr("turning must be that of its drive"));
  for (const auto& point : diagram.branches[0].points) EXPECT_NEAR(point.parameter, 4.0, ended);
}

TEST(Branches, EndWhereAForceOfTimeSetsIn) {
  const auto diagram = follow_branches<2>(
      [](double p) {
        Scene<2> scene("shaken");
        const auto mass = scene.add_particle({.mass = 1.0}, "mass");
        scene.add(Spring{Fixed<2>{}, mass, 1.0, 0.0}, "spring");
        scene.add(force_law(points(mass),
                            [p](auto t, auto r, auto) { return vec(0.3 + p * sin(t) + 0.0 * r.x(), 0.0); }),
                  "push");
        return Posed<2>{std::move(scene)};
      },
      {.from = 0.0, .to = 1.0});
  EXPECT_EQ(diagram.branches[0].end, BranchEnd::lost);
  EXPECT_THAT(diagram.branches[0].why, HasSubstr("change with time"));
  EXPECT_NEAR(diagram.branches[0].points.back().parameter, 0.0, ended);
}

TEST(Branches, ForkFromTheSideOfTheOneThatTurnsBackThere) {
  // cos phi = g/Omega^2 beyond Omega^2 = g, on both sides of the hoop: one branch that turns back at the
  // bottom, where the one of the bottom passes.
  for (const double from : {6.0, 4.0, 3.3}) {
    for (const double step : {0.02, 0.05}) {
      Particle<3> bead;
      const auto diagram = follow_hoop(bead, {.from = from, .to = 2.0, .step = step});
      ASSERT_EQ(diagram.bifurcations.size(), 1U) << from << ' ' << step;
      // Omega is flat there along the branch, see ShallowArchTurnsBackWhereItSnaps.
      EXPECT_NEAR(diagram.bifurcations[0].parameter, std::sqrt(9.81), located);
      EXPECT_TRUE(diagram.folds.empty());
      ASSERT_EQ(diagram.branches.size(), 3U) << from << ' ' << step;
      EXPECT_NEAR(diagram.branches[0].points.back().parameter, from, on_branch);
      double ends = 0.0;
      for (const std::size_t b : {1U, 2U}) {
        EXPECT_EQ(diagram.branches[b].origin, 0U);
        ends += diagram.branches[b].points.back().parameter;
        for (const auto& point : diagram.branches[b].points)
          EXPECT_NEAR(point.state.sample().position(bead).z(), -1.0, on_branch);
      }
      EXPECT_NEAR(ends, 2.0 + from, on_branch);  // one to either end
    }
  }
}

TEST(Branches, ForkHoweverFlatTheOtherOneIs) {
  // (1 - p) x + c x^2 = 0: x = 0, and x = (p - 1)/c to both ends of the range.
  for (const double c : {0.3, 1.0, 3.0, 10.0}) {
    Particle<2> bead;
    const auto diagram = follow_branches<2>(
        [&](double p) {
          Scene<2> scene("crossing");
          bead = scene.add_particle({.mass = 1.0});
          scene.add(OnCurve{bead, Plane<2>{}});
          scene.add(potential(points(bead), [=](auto r) {
            return 0.5 * (1.0 - p) * r.x() * r.x() + c * r.x() * r.x() * r.x() / 3.0;
          }));
          const auto unit = scene.add_particle({.mass = 1.0, .position = {3.0, 0.0}});
          scene.add(Spring{Fixed<2>{{3.0, 0.0}}, unit, 1.0});
          return Posed<2>{std::move(scene)};
        },
        {.from = 0.5, .to = 1.5});
    ASSERT_EQ(diagram.bifurcations.size(), 1U) << c;
    ASSERT_EQ(diagram.branches.size(), 3U) << c;
    double ends = 0.0;
    for (const std::size_t b : {1U, 2U}) {
      ends += diagram.branches[b].points.back().parameter;
      for (const auto& point : diagram.branches[b].points)
        EXPECT_NEAR(point.state.sample().position(bead).x(), (point.parameter - 1.0) / c, on_branch) << c;
    }
    EXPECT_NEAR(ends, 2.0, on_branch) << c;
  }
}

TEST(Branches, AllForksWithinOneStepAreFollowed) {
  // Two rigid columns side by side, V = k x^2/2 + p y with k = 10 and 10.1: each buckles at p = k, within the
  // same step of the load, into k cos theta = p to either side.
  const auto diagram = follow_branches<2>(
      [](double p) {
        Scene<2> scene;
        for (const double k : {10.0, 10.1}) {
          const auto tip = scene.add_particle({.mass = 1.0, .position = {100.0 * k, 1.0}});
          scene.add(Distance{Fixed<2>{{100.0 * k, 0.0}}, tip, 1.0});
          scene.add(potential(points(tip), [k, p](auto r) {
            const auto x = r.x() - 100.0 * k;
            return 0.5 * k * x * x + p * r.y();
          }));
        }
        return Posed<2>{std::move(scene), {}};
      },
      {.from = 8.0, .to = 12.0, .step = 0.1});
  ASSERT_GE(diagram.bifurcations.size(), 2U);
  EXPECT_NEAR(diagram.bifurcations[0].parameter, 10.0, 10 * located);
  EXPECT_NEAR(diagram.bifurcations[1].parameter, 10.1, 10 * located);
  EXPECT_TRUE(diagram.folds.empty());
  std::size_t of_first = 0, of_second = 0;
  for (const auto& branch : diagram.branches) {
    of_first += branch.origin == 0;
    of_second += branch.origin == 1;
  }
  EXPECT_EQ(of_first, 2U);
  EXPECT_EQ(of_second, 2U);
}

}  // namespace
}  // namespace dalembert::branches_test
