#include <dalembert/dalembert.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace dalembert::steady_units_test {
namespace {

/// Frequencies are roots of squares that are known to some thousand roundings of terms of size 1 to 100.
constexpr double rounding = 1e-9;

/// Units of a scene, and how many of its lengths it is away from the origin.
struct Place {
  double length, time, off;
};
const std::vector<Place> units{{1.0, 1.0, 0.0}, {1e-8, 1.0, 0.0}, {1e-3, 1e3, 0.0},
                               {1e5, 1.0, 0.0}, {1e8, 1e-6, 0.0}, {1e10, 1e7, 0.0}};

/// The positive frequencies of the vibrations that are not free, in radians per unit of time.
template <int D>
std::vector<double> frequencies(const NormalModes<D>& modes, double time) {
  std::vector<double> all;
  for (std::size_t k = 0; k < modes.size(); ++k)
    if (!modes.is_free(k)) all.push_back(modes.frequency(k) * time);
  return all;
}

TEST(Steady, EquilateralMotionHasRouthsEigenvaluesInAnyUnitOfLength) {
  // Routh: s^4 + s^2 + 27/4 (m1 m2 + m2 m3 + m3 m1)/M^2 = 0 in units of the rate; of the centre and of the
  // size +-i three times, and 0 of the angle. Those of the centre are a double one, known to a root.
  const std::array<double, 3> m{20.0, 0.5, 0.1};
  const double M = 20.6, product = 27.0 / 4.0 * (m[0] * m[1] + m[1] * m[2] + m[2] * m[0]) / (M * M);
  const double root = std::sqrt(1.0 - 4.0 * product);
  for (const auto& [L, T, off] : units) {
    const double a = 2.0 * L, G = L * L * L / (T * T), rate = std::sqrt(G * M / (a * a * a));
    const std::array<Vec<2>, 3> r{Vec<2>(0.0, 0.0), Vec<2>(a, 0.0), Vec<2>(0.5 * a, std::sqrt(0.75) * a)};
    const Vec<2> centre = (m[0] * r[0] + m[1] * r[1] + m[2] * r[2]) / M;
    Scene<2> scene("equilateral");
    std::vector<Particle<2>> p;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec<2> d = r[i] - centre;
      p.push_back(
          scene.add_particle({.mass = m[i], .position = d, .velocity = rate * Vec<2>(-d.y(), d.x())}));
    }
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < i; ++j)
        scene.add(potential(points(p[i], p[j]),
                            [k = G * m[i] * m[j]](auto x, auto y) { return -k / (x - y).norm(); }));
    const auto modes = normal_modes(scene, steady(scene));
    EXPECT_NE(modes.stability(), Stability::unstable) << L;
    const auto all = frequencies(modes, 1.0 / rate);
    ASSERT_EQ(all.size(), 5u) << L;
    EXPECT_NEAR(all[0], std::sqrt(0.5 * (1.0 - root)), rounding) << L;
    EXPECT_NEAR(all[1], std::sqrt(0.5 * (1.0 + root)), rounding) << L;
    for (std::size_t k = 2; k < 5; ++k) EXPECT_NEAR(all[k], 1.0, 1e-6) << L;
  }
}

/// A body at Lagrange's point below Routh's limit, of 1e-12 to 1e-6 of the sum: +-i three times, and beside
/// these only vibrations. The others turn about the centre of mass by as little as the light one weighs,
/// which is part of their displacement all the same.
TEST(Steady, LightBodyAtLagrangesPointMakesNothingGrow) {
  for (const double mu : {0.001, 0.01, 0.03, 0.038}) {
    for (const double light : {1e-12, 1e-11, 1e-10, 3e-10, 1e-9, 3e-9, 1e-8, 1e-6}) {
      const std::array<double, 3> m{1.0 - mu, mu, light};
      const std::array<Vec<2>, 3> r{Vec<2>(-mu, 0.0), Vec<2>(1.0 - mu, 0.0),
                                    Vec<2>(0.5 - mu, std::sqrt(0.75))};
      const Vec<2> centre = light / (1.0 + light) * r[2];
      const double rate = std::sqrt(1.0 + light);
      Scene<2> scene("Trojan");
      std::vector<Particle<2>> p;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec<2> d = r[i] - centre;
        p.push_back(
            scene.add_particle({.mass = m[i], .position = d, .velocity = rate * Vec<2>(-d.y(), d.x())}));
      }
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < i; ++j)
          scene.add(potential(points(p[i], p[j]),
                              [k = m[i] * m[j]](auto x, auto y) { return -k / (x - y).norm(); }));
      const auto modes = normal_modes(scene, steady(scene));
      EXPECT_NE(modes.stability(), Stability::unstable) << mu << ' ' << light << modes.describe();
    }
  }
}

const std::vector<Place> places{{1.0, 1.0, 0.0},  {1e-8, 1.0, 0.0}, {1e9, 1.0, 0.0}, {1e10, 1e7, 0.0},
                                {1.0, 1e-6, 0.0}, {1.0, 1e6, 0.0},  {1.0, 1.0, 1e3}, {1.0, 1.0, 1e4}};
/// Away from the origin the positions' own, some thousand of them in terms a hundred times as large as what
/// is left of them: those of the spin.
double rounding_at(double off) { return rounding + 1e5 * std::numeric_limits<double>::epsilon() * off; }

Mat<3, 3> matrix(const Vec<3>& x, const Vec<3>& y, const Vec<3>& z) {
  Mat<3, 3> axes;
  for (int i = 0; i < 3; ++i) {
    axes(i, 0) = x[i];
    axes(i, 1) = y[i];
    axes(i, 2) = z[i];
  }
  return axes;
}

TEST(Steady, PrecessionOfATopIsTheSameAnywhereInAnyUnits) {
  // J Omega^2 cos(theta) - C w3 Omega + m g l = 0 with J about the foot, and the nutation (see the heavy top
  // of the models) has J^2 Omega^2 f^2 = (m g l)^2 - 2 J m g l Omega^2 cos(theta) + J^2 Omega^4.
  const double theta = 0.8, m = 0.8;
  for (const auto& [L, T, off] : places) {
    const double l = 0.3 * L, A = 0.02 * L * L, C = 0.012 * L * L, g = 9.81 * L / (T * T), Omega = 2.0 / T;
    const double J = A + m * l * l, moment = m * g * l;
    const double spin = (J * Omega * Omega * std::cos(theta) + moment) / (C * Omega);
    const Vec<3> foot = off * L * Vec<3>(1.0, -0.5, 0.3), e(std::sin(theta), 0.0, std::cos(theta)),
                 across(std::cos(theta), 0.0, -std::sin(theta)), arm = l * e;
    const Vec<3> w = spin * e - Omega * std::sin(theta) * across;
    Scene<3> scene("top");
    scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
    const auto top = add_body(scene,
                              BodyState<3>{.mass = m,
                                           .inertia = {A, A, C},
                                           .centre = foot + arm,
                                           .axes = matrix(across, {0.0, 1.0, 0.0}, e),
                                           .velocity = w.cross(arm),
                                           .angular_velocity = w},
                              "top");
    scene.add(Coincident{Fixed<3>{foot}, top.point({0.0, 0.0, -l})});
    const auto modes = normal_modes(scene, steady(scene));
    EXPECT_EQ(modes.stability(), Stability::stable) << L << ' ' << T << ' ' << off << modes.describe();
    const auto all = frequencies(modes, T);
    ASSERT_EQ(all.size(), 1u) << L << ' ' << T << ' ' << off;
    const double square =
        moment * moment - 2.0 * J * moment * Omega * Omega * std::cos(theta) + J * J * std::pow(Omega, 4);
    EXPECT_NEAR(all[0], std::sqrt(square) / (J * Omega) * T, rounding_at(off)) << L << ' ' << T << ' ' << off;
  }
}

TEST(Steady, ADiskRollsAsFastAnywhereInAnyUnits) {
  // A thin disk that rolls upright and straight on: f^2 = (12 v^2 - 4 g a)/(5 a^2), stable above 0.
  for (const auto& [L, T, off] : places) {
    const double a = 0.5 * L, m = 2.0, g = 9.81 * L / (T * T), v = 1.5 * L / T, I = m * a * a / 4.0;
    const Vec<3> ground = off * L * Vec<3>(1.0, -0.5, 0.3);
    Scene<3> scene("disk");
    scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
    const auto disk = add_lamina(scene,
                                 LaminaState{.mass = m,
                                             .inertia = {I, I},
                                             .centre = ground + Vec<3>(0.0, 0.0, a),
                                             .axes = matrix({1, 0, 0}, {0, 0, 1}, {0, -1, 0}),
                                             .velocity = {v, 0.0, 0.0},
                                             .angular_velocity = {0.0, v / a, 0.0}},
                                 "disk");
    const Plane<3> plane{.point = ground};
    scene.add(DiskContact{disk.centre(), disk.point({a, 0.0}), disk.point({0.0, a}), a, plane});
    scene.add(DiskRolling{disk.centre(), disk.point({a, 0.0}), disk.point({0.0, a}), a, plane});
    const Kept<3> speed{"speed", [=](const Sample<3>& now) { return now.velocity(disk.centre()).x(); }};
    const auto modes = normal_modes(scene, steady(scene, {.keep = {speed}}));
    EXPECT_EQ(modes.stability(), Stability::stable) << L << ' ' << T << ' ' << off << modes.describe();
    const auto all = frequencies(modes, T);
    ASSERT_EQ(all.size(), 1u) << L << ' ' << T << ' ' << off;
    EXPECT_NEAR(all[0], std::sqrt((12.0 * v * v - 4.0 * g * a) / 5.0) / a * T, rounding_at(off))
        << L << ' ' << T << ' ' << off;
  }
}

/// Chaplygin's: (J + m a^2) w' = -m a v w. Nothing but its speed gives it a time.
Scene<2> sleigh(double v, const Vec<2>& at) {
  Scene<2> scene("sleigh");
  const auto body = add_body(
      scene, {.mass = 1.0, .inertia = 0.2, .centre = at + Vec<2>(0.3, 0.0), .velocity = Vec<2>(v, 0.0)},
      "sleigh");
  scene.add(nonholonomic(points(body.point({-0.3, 0.0}), body.point({0.7, 0.0})),
                         [](auto r, auto ahead, auto u, auto) {
                           const auto along = ahead - r;
                           return along.x() * u.y() - along.y() * u.x();
                         }));
  return scene;
}

TEST(Steady, ASleighIsAsUnstableHoweverSlow) {
  for (const double v : {-1e3, -1e-3, -1e-9, -1e-20}) {
    const auto scene = sleigh(v, {0.0, 0.0});
    const auto modes = normal_modes(scene, steady(scene));
    EXPECT_EQ(modes.stability(), Stability::unstable) << v;
    EXPECT_NEAR(modes.eigenvalue(modes.size() - 1).real() / v, -0.3 / 0.29, rounding) << v;
  }
}

TEST(Steady, ASleighLosesItsStabilityAtRestInAnyUnits) {
  for (const double off : {0.0, 1e3, 1e5}) {
    for (const double unit : {1e-6, 1.0, 1e6}) {
      const auto diagram =
          follow_steady<2>([=](double v) { return PosedSteady<2>{sleigh(v, off * Vec<2>(1.0, -0.6))}; },
                           {.from = -2.0 * unit, .to = 2.1 * unit});
      EXPECT_EQ(diagram.branches.at(0).why, "") << off << ' ' << unit;
      ASSERT_EQ(diagram.bifurcations.size(), 1U) << off << ' ' << unit;
      EXPECT_NEAR(diagram.bifurcations[0].parameter / unit, 0.0, rounding) << off << ' ' << unit;
    }
  }
}

TEST(NormalModes, ADoorInTwoHingesVibratesInAnyUnits) {
  // Beside a stiff spring, in number, the second hinge's rows were not known to be redundant.
  std::vector<double> found;
  for (const auto& [L, T, off] :
       std::vector<Place>{{1, 1, 0}, {1, 1e-6, 0}, {1, 1e6, 0}, {1e-6, 1, 0}, {1e6, 1e-6, 0}}) {
    const Vec<3> axis(0.0, 0.6, 0.8);
    Scene<3> scene("door");
    scene.add(UniformGravity<3>{L / (T * T) * Vec<3>(1.0, -2.0, -9.81)});
    const auto door = add_body(
        scene,
        BodyState<3>{
            .mass = 20.0, .inertia = L * L * Vec<3>(7.0, 5.4, 1.7), .centre = L * Vec<3>(0.5, -0.3, 0.1)},
        "door");
    const auto hinge = add_joint(scene, Revolute{Ground<3>{}, door, Vec<3>(0.0, 0.0, 0.0), axis});
    scene.add(Revolute{Ground<3>{}, door, Vec<3>(1.5 * L * axis), axis});
    scene.add(TorsionSpring{hinge, 50.0 * L * L / (T * T), 0.3});
    const auto modes = normal_modes(scene, equilibrium(scene));
    ASSERT_EQ(modes.size(), 1U) << L << ' ' << T;
    EXPECT_EQ(modes.stability(), Stability::stable);
    found.push_back(modes.frequency(0) * T);
    EXPECT_NEAR(found.back(), found.front(), rounding) << L << ' ' << T;
  }
}

TEST(NormalModes, AConicalPendulumFarAwayTurnsFreely) {
  // The height's frequency is Omega sqrt(1 + 3 cos^2(theta)), and the angle about the axis is free.
  for (const double off : {0.0, 1e3, 3e3, 1e5}) {
    const double l = 1.3, theta = 0.7, g = 9.81, rate = std::sqrt(g / (l * std::cos(theta)));
    const Vec<3> axis = Vec<3>(1.0, 2.0, -2.0) / 3.0, hook = off * Vec<3>(1.0, -2.0 / 3.0, 1.0 / 6.0),
                 out = axis.cross(Vec<3>(0.3, -0.2, 0.9)).normalized();
    Scene<3> scene("conical");
    scene.add(UniformGravity<3>{-g * axis});
    const Vec<3> arm = l * (std::sin(theta) * out - std::cos(theta) * axis);
    const auto bob =
        scene.add_particle({.mass = 0.3, .position = hook + arm, .velocity = rate * axis.cross(arm)}, "bob");
    scene.add(Distance{Fixed<3>{hook}, bob, l});
    const auto modes =
        normal_modes(scene, equilibrium(scene, {.turning = {.rate = rate * axis, .centre = hook}}));
    EXPECT_EQ(modes.stability(), Stability::stable) << off << modes.describe();
    ASSERT_EQ(modes.size(), 2u);
    EXPECT_TRUE(modes.is_free(0)) << off;
    EXPECT_NEAR(modes.frequency(1), rate * std::sqrt(1.0 + 3.0 * std::pow(std::cos(theta), 2)),
                rounding_at(off));
  }
}

}  // namespace
}  // namespace dalembert::steady_units_test
