#include <dalembert/dalembert.h>

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace dalembert::branches_stability_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Singular points are where an eigenvalue that crosses 0 with a slope of order 1 is round-off.
constexpr double located = 1e-12;

/// Two rotors of unit inertia under the forces -K x, and a softening or hardening spring of each.
Diagram<Equilibrium<2>> follow_linear(const auto& stiffness, const BranchOptions& options,
                                      double damping = 0.0, double cubic = 1.0) {
  return follow_branches<2>(
      [&](double p) {
        Scene<2> scene("linear");
        const auto a = scene.add_rotor({.inertia = 1.0}, "a"), b = scene.add_rotor({.inertia = 1.0}, "b");
        const Eigen::Matrix2d K = stiffness(p);
        scene.add(force_law(points(a, b), [K, damping, cubic](auto x, auto y, auto v, auto w) {
          return std::make_tuple(
              vec(-K(0, 0) * x[0] - K(0, 1) * y[0] - cubic * x[0] * x[0] * x[0] - damping * v[0]),
              vec(-K(1, 0) * x[0] - K(1, 1) * y[0] - cubic * y[0] * y[0] * y[0] - damping * w[0]));
        }));
        return Posed<2>{std::move(scene)};
      },
      options);
}

TEST(Branches, FollowerLoadsForkWhereTheDeterminantIsZeroAndNowhereElse) {
  // det = 1 for every P, though the symmetric part is singular at P = 2.
  const auto column = follow_linear(
      [](double P) {
        return Eigen::Matrix2d{{2.0 - P, P - 1.0}, {-1.0, 1.0}};
      },
      {.from = 0.5, .to = 3.0});
  EXPECT_TRUE(column.bifurcations.empty());
  EXPECT_TRUE(column.folds.empty());
  // det = 2 p + 8, trace 2 + p: eigenvalues 0 and -2 at p = -4; the symmetric part is singular at p = 0.5.
  const auto other = follow_linear(
      [](double p) {
        return Eigen::Matrix2d{{2.0, 4.0}, {-2.0, p}};
      },
      {.from = -6.0, .to = 2.0, .step = 0.05});
  ASSERT_EQ(other.bifurcations.size(), 1U);
  EXPECT_NEAR(other.bifurcations[0].parameter, -4.0, 10 * located);
  std::size_t emanating = 0;
  for (const auto& branch : other.branches) emanating += branch.origin == 0;
  EXPECT_EQ(emanating, 2U);
}

// The same with masses 1 : m in the metric of the masses: det = (2 p + 8)/m, trace = 2 + p/m. Where m = 2
// both eigenvalues are 0 at p = -4, complex behind it; beside that one passes 0 just before they meet.
TEST(Branches, AForkIsFoundWhereTwoEigenvaluesMeetAtZero) {
  for (const double m : {1.99, 2.0, 2.01}) {
    const double s = std::sqrt(m);
    const auto diagram = follow_linear(
        [s](double p) {
          return Eigen::Matrix2d{{2.0, 4.0 / s}, {-2.0 / s, p / (s * s)}};
        },
        {.from = -6.0, .to = 1.0});
    ASSERT_EQ(diagram.bifurcations.size(), 1U) << m;
    EXPECT_NEAR(diagram.bifurcations[0].parameter, -4.0, 7.0 * located) << m;
    EXPECT_EQ(diagram.branches.size(), 3U) << m;
  }
}

TEST(Branches, FollowerLoadsTellWhereFlutterBegins) {
  // s^2 = -mu, mu^2 - (3 - P) mu + 1 = 0: a complex pair where |3 - P| < 2, with omega = 1 at P = 1. At P = 5
  // it turns into two real mu < 0, which grow as it does: no limit of stability.
  const auto column = [](double P) { return Eigen::Matrix2d{{2.0 - P, P - 1.0}, {-1.0, 1.0}}; };
  const auto found = follow_linear(column, {.from = 0.0, .to = 6.0});
  ASSERT_EQ(found.flutters.size(), 1U);
  EXPECT_NEAR(found.flutters[0].parameter, 1.0, 10 * located);
  EXPECT_NEAR(found.flutters[0].frequency, 1.0, 1e-6);  // a double eigenvalue, to the square root
  // The same damping c of both: (s^2 + c s)^2 + (3 - P)(s^2 + c s) + 1 = 0 with s = i w where
  // w^2 = (3 - P)/2 and c^2 w^2 = 1 - w^4.
  const double c = 0.3, w2 = (-c * c + std::sqrt(c * c * c * c + 4.0)) / 2.0;
  const auto damped = follow_linear(column, {.from = 0.0, .to = 4.0}, c);
  ASSERT_EQ(damped.flutters.size(), 1U);
  EXPECT_NEAR(damped.flutters[0].parameter, 3.0 - 2.0 * w2, 10 * located);
  EXPECT_NEAR(damped.flutters[0].frequency, std::sqrt(w2), located);
  EXPECT_TRUE(damped.bifurcations.empty());
}

TEST(Branches, ZieglersColumnTellsItsFlutterLoad) {
  // Two links of 1 with springs of 1, masses 2 at the knee and 1 at the tip, P along the last link: with
  // w = omega^2, 2 w^2 + (2 P - 7) w + 1 = 0, a double root at P = 7/2 - sqrt(2), omega^4 = 1/2.
  const auto found = follow_branches<2>(
      [](double P) {
        Scene<2> scene("Ziegler");
        const auto knee = scene.add_particle({.mass = 2.0, .position = {0.0, 1.0}}, "knee"),
                   tip = scene.add_particle({.mass = 1.0, .position = {0.0, 2.0}}, "tip");
        scene.add(Distance{Fixed<2>{}, knee, 1.0});
        scene.add(Distance{knee, tip, 1.0});
        scene.add(potential(points(knee, tip), [](auto a, auto b) {
          const auto first = atan2(a.x(), a.y()), second = atan2(b.x() - a.x(), b.y() - a.y());
          return 0.5 * (first * first + (second - first) * (second - first));
        }));
        scene.add(force_law(points(knee, tip), [P](auto a, auto b, auto, auto) {
          const auto along = ((b - a) / (b - a).norm()).eval();
          return std::make_tuple((0.0 * along).eval(), (-P * along).eval());
        }));
        return Posed<2>{std::move(scene)};
      },
      {.from = 0.5, .to = 3.0});
  EXPECT_TRUE(found.bifurcations.empty());
  ASSERT_EQ(found.flutters.size(), 1U);
  EXPECT_NEAR(found.flutters[0].parameter, 3.5 - std::sqrt(2.0), 10 * located);
  EXPECT_NEAR(found.flutters[0].frequency, std::pow(0.5, 0.25), 1e-6);
}

TEST(Branches, TellWhereNegativeDampingSetsIn) {
  // x'' + (0.5 - p) x' + 4 x = 0.
  const auto found = follow_branches<2>(
      [](double p) {
        Scene<2> scene;
        const auto x = scene.add_rotor({.inertia = 1.0});
        scene.add(
            force_law(points(x), [p](auto phi, auto v) { return vec(-4.0 * phi[0] - (0.5 - p) * v[0]); }));
        return Posed<2>{std::move(scene)};
      },
      {.from = 0.0, .to = 2.0});
  ASSERT_EQ(found.flutters.size(), 1U);
  EXPECT_NEAR(found.flutters[0].parameter, 0.5, located);
  EXPECT_NEAR(found.flutters[0].frequency, 2.0, located);
}

TEST(Branches, SimultaneousLossAndGainOfStabilityIsAFork) {
  // V = (p - 1) x^2/2 + (1 - p) y^2/2 + (x^4 + y^4)/4: as many eigenvalues < 0 before as after; x^2 = 1 - p
  // before and y^2 = p - 1 after.
  const auto exchange = follow_linear(
      [](double p) {
        return Eigen::Matrix2d{{p - 1.0, 0.0}, {0.0, 1.0 - p}};
      },
      {.from = 0.0, .to = 2.2});
  ASSERT_EQ(exchange.bifurcations.size(), 1U);
  EXPECT_NEAR(exchange.bifurcations[0].parameter, 1.0, located);
  EXPECT_EQ(exchange.branches.size(), 5U);
  // One after the other within a step: the first at 1, the second at 1.003.
  const auto two = follow_linear(
      [](double p) {
        return Eigen::Matrix2d{{p - 1.0, 0.0}, {0.0, 1.003 - p}};
      },
      {.from = 0.0, .to = 2.2});
  ASSERT_EQ(two.bifurcations.size(), 2U);
  EXPECT_NEAR(two.bifurcations[0].parameter + two.bifurcations[1].parameter, 2.003, 2 * located);
}

TEST(Branches, EigenvalueBelowZeroBetweenTwoPointsIsAFork) {
  // K = (p - 1) (p - 1.004) along x: both ends of a step of 0.044 are above 0.
  const auto found = follow_linear(
      [](double p) {
        return Eigen::Matrix2d{{(p - 1.0) * (p - 1.004), 0.0}, {0.0, 1.0}};
      },
      {.from = 0.0, .to = 2.2});
  ASSERT_EQ(found.bifurcations.size(), 2U);
  EXPECT_NEAR(found.bifurcations[0].parameter, 1.0, 1e2 * located);  // a slope of 0.004
  EXPECT_NEAR(found.bifurcations[1].parameter, 1.004, 1e2 * located);
}

/// A mass on two bars of stiffness EA/l, engineering strain, from (+-b, 0) with b = 1 to (0, h) at rest.
Diagram<Equilibrium<2>> follow_truss(double h, const BranchOptions& options) {
  const double l0 = std::sqrt(1.0 + h * h);
  return follow_branches<2>(
      [&](double load) {
        Scene<2> scene("truss");
        scene.add(UniformGravity<2>{{0.0, -load}});
        const auto top = scene.add_particle({.mass = 1.0, .position = {0.0, h}});
        for (const double side : {1.0, -1.0}) scene.add(Spring{Fixed<2>{{side, 0.0}}, top, 100.0, l0});
        return Posed<2>{std::move(scene)};
      },
      options);
}

TEST(Branches, SteepTrussForksSidewaysAtOnePlaceWhateverTheStep) {
  // k_xx = 2 k (1 - l0/l + l0 b^2/l^3) = 0 with l^2 = b^2 + y^2: l^3 - l0 l^2 + l0 b^2 = 0, l < l0, which has
  // a solution where l0^2 >= 27/4; the load there is 2 k y (l0/l - 1).
  for (const double h : {3.0, 2.6}) {
    const double l0 = std::sqrt(1.0 + h * h);
    double l = l0;
    for (int i = 0; i < 60; ++i) l -= (l * l * l - l0 * l * l + l0) / (3.0 * l * l - 2.0 * l0 * l);
    const double expected = 200.0 * std::sqrt(l * l - 1.0) * (l0 / l - 1.0);
    for (const double step : {0.005, 0.02, 0.07, 0.2}) {
      const auto found = follow_truss(h, {.from = 0.0, .to = 1.3 * expected, .step = step});
      ASSERT_FALSE(found.bifurcations.empty()) << h << ' ' << step;
      EXPECT_NEAR(found.bifurcations[0].parameter / expected, 1.0, located) << h << ' ' << step;
    }
  }
}

/// The load on two rods of stiffness k from (-+a, 0) to a guided apex, relaxed where it is h high, at height
/// y.
double truss_load(double k, double a, double h, double y) {
  const double relaxed = std::hypot(a, h), length = std::hypot(a, y);
  return 2.0 * k * y * (h * h - y * y) / (length * (relaxed + length));
}

TEST(Branches, ASmallTrussBesideALargeOneIsBalancedAtEachPoint) {
  struct Truss {
    double a, h, at, share;
    Particle<2> apex{};
  };
  // The small one snaps at its largest load, at y = h/sqrt 3 as it is shallow: of 0.8 of the load of the
  // other.
  const double k = 1000.0, least = truss_load(k, 0.01, 3e-5, 3e-5 / std::sqrt(3.0)),
               most = truss_load(k, 1.0, 0.5, 0.5 / std::sqrt(3.0));
  std::array<Truss, 2> trusses{Truss{1.0, 0.5, 0.0, 1.0}, Truss{0.01, 3e-5, 2.0, 1.25 * least / most}};
  const auto diagram = follow_branches<2>(
      [&](double p) {
        Scene<2> scene("trusses");
        for (Truss& t : trusses) {
          t.apex = scene.add_particle({.mass = 1.0, .position = {t.at, t.h}});
          for (const double side : {-t.a, t.a})
            scene.add(
                compliant(Distance{Fixed<2>{{t.at + side, 0.0}}, t.apex, std::hypot(t.a, t.h)}, 1.0 / k));
          scene.add(holonomic(points(t.apex), [x = t.at](auto r) { return r.x() - x; }));
          scene.add(potential(points(t.apex), [f = p * t.share](auto r) { return f * r.y(); }));
        }
        return Posed<2>{std::move(scene)};
      },
      {.from = 0.0, .to = 1.05 * most});
  EXPECT_THAT(diagram.branches[0].why, Not(HasSubstr("change with time")));
  // The first point is one to the accuracy asked of an equilibrium.
  const Truss& small = trusses[1];
  for (const auto& point : diagram.branches[0].points) {
    const double y = point.state.sample().position(small.apex).y();
    EXPECT_NEAR(truss_load(k, small.a, small.h, y), point.parameter * small.share, 1e-8 * least)
        << point.parameter;
  }
}

TEST(Branches, SayWhyTheyAreLost) {
  // A potential that is no number beyond p = 0.5.
  const auto found = follow_branches<2>(
      [](double p) {
        Scene<2> scene("ends");
        const auto x = scene.add_rotor({.inertia = 1.0});
        scene.add(
            potential(points(x), [p](auto phi) { return phi[0] * phi[0] * sqrt(0.5 - p + 0.0 * phi[0]); }));
        return Posed<2>{std::move(scene)};
      },
      {.from = 0.0, .to = 1.0});
  ASSERT_EQ(found.branches.size(), 1U);
  EXPECT_EQ(found.branches[0].end, BranchEnd::lost);
  EXPECT_THAT(found.branches[0].why, HasSubstr("no point was found"));
  EXPECT_THAT(found.branches[0].why, HasSubstr("finite"));
}

}  // namespace
}  // namespace dalembert::branches_stability_test
