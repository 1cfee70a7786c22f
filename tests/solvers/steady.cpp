#include "whipple.h"
#include <dalembert/dalembert.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

namespace dalembert::steady_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double g = 9.81;
/// Newton's iteration ends at round-off of terms of size 1 to 100, over some dozens of equations.
constexpr double rounding = 1e-11;

TEST(Steady, OfAConicalPendulumIsThatOfItsHeight) {
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

/// A top of mass 1 whose centre is 0.5 above its point: about that A = 0.3, C = 0.02.
struct Top {
  Scene<3> scene{"top"};
  RigidBody<3> body;

  Top(double lean, double precession, double spin) {
    scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
    const Vec<3> axis(std::sin(lean), 0.0, std::cos(lean)), y(0.0, 1.0, 0.0);
    Eigen::Matrix3d axes;
    axes << y.cross(axis), y, axis;
    const Vec<3> rate = precession * Vec<3>::UnitZ() + spin * axis, centre = 0.5 * axis;
    body = add_body(scene,
                    {.mass = 1.0,
                     .inertia = {0.05, 0.05, 0.02},
                     .centre = centre,
                     .axes = axes,
                     .velocity = rate.cross(centre),
                     .angular_velocity = rate},
                    "top");
    scene.add(Coincident{body.point({0.0, 0.0, -0.5}), Fixed<3>{}}, "point");
  }
};

TEST(Steady, PrecessionOfATopIsARootOfItsQuadratic) {
  // A p^2 cos t - C n p + m g l = 0 with n the whole rate about the axis, t and n kept.
  constexpr double lean = 0.5, n = 300.0, A = 0.3, C = 0.02;
  const double mgl = g * 0.5, root = std::sqrt(C * C * n * n - 4.0 * A * std::cos(lean) * mgl);
  for (const double sign : {-1.0, 1.0}) {
    const double p = (C * n + sign * root) / (2.0 * A * std::cos(lean));
    const Top top(lean, 1.03 * p, n - 1.03 * p * std::cos(lean));
    const auto at =
        steady(top.scene, {.keep = {{"lean", [=](const auto& now) { return top.body.axes(now).col(2).z(); }},
                                    {"spin", [=](const auto& now) {
                                       return angular_velocity(now, top.body).dot(top.body.axes(now).col(2));
                                     }}}});
    const Vec<3> rate = angular_velocity(at.sample(), top.body), axis = top.body.axes(at.sample()).col(2);
    EXPECT_NEAR(axis.z(), std::cos(lean), rounding);
    EXPECT_NEAR(rate.dot(axis), n, n * rounding);
    // What turns the axis is the precession: across it.
    const double across = (rate - rate.dot(axis) * axis).norm() / std::sqrt(1.0 - axis.z() * axis.z());
    EXPECT_NEAR(across, std::abs(p), 1e3 * rounding * std::abs(p));
  }
}

/// The distance of the nearest eigenvalue.
double off(const NormalModes<3>& modes, std::complex<double> s) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < modes.size(); ++k)
    nearest = std::min(nearest, std::abs(modes.eigenvalue(k) - s));
  return nearest;
}

/// Eigenvalues of a top that sleeps: A th'' - i C n th' - m g l th = 0 for th = x + i y, so that
/// s = i (C n +- sqrt(C^2 n^2 - 4 A m g l))/(2 A). Critical: n = sqrt(4 A m g l)/C = 121.3.
std::array<std::complex<double>, 2> asleep(double n) {
  constexpr double A = 0.3, C = 0.02, mgl = g * 0.5;
  const std::complex<double> root = std::sqrt(std::complex<double>(C * C * n * n - 4.0 * A * mgl)),
                             i(0.0, 1.0);
  return {i * (C * n + root) / (2.0 * A), i * (C * n - root) / (2.0 * A)};
}

TEST(Steady, TopAsleepIsStableAboveItsCriticalSpin) {
  // K is known to round-off of n^2, of which K keeps nothing.
  for (const double n : {20.0, 100.0, 120.0, 122.0, 150.0, 300.0, 3000.0}) {
    const Top top(0.0, 0.0, n);
    const auto modes = normal_modes(top.scene, steady(top.scene));
    ASSERT_EQ(modes.size(), 3U) << n;
    EXPECT_TRUE(modes.is_free(0));
    EXPECT_EQ(modes.eigenvalue(0), 0.0);
    for (const auto s : asleep(n)) EXPECT_LT(off(modes, s), 1e2 * rounding) << n << ' ' << s;
    EXPECT_EQ(modes.stability(), n < 121.3 ? Stability::unstable : Stability::stable) << modes.describe();
  }
}

TEST(Steady, TopAsleepIsJudgedBesideAPendulum) {
  for (const double n : {100.0, 150.0, 300.0}) {
    Top top(0.0, 0.0, n);
    const auto bob = top.scene.add_particle({.mass = 2.0, .position = {5.0, 0.0, -1.0}}, "bob");
    top.scene.add(Distance{Fixed<3>{{5.0, 0.0, 0.0}}, bob, 1.0});
    const auto modes = normal_modes(top.scene, steady(top.scene));
    ASSERT_EQ(modes.size(), 5U);
    for (const auto s : asleep(n)) EXPECT_LT(off(modes, s), 1e2 * rounding) << n;
    EXPECT_LT(off(modes, {0.0, std::sqrt(g)}), rounding);
    EXPECT_EQ(modes.stability(), n < 121.3 ? Stability::unstable : Stability::stable) << modes.describe();
  }
}

TEST(Steady, PrecessionNutatesAboutItsLean) {
  // A t'' = f(t) = A p^2 sin t cos t - C n p sin t + m g l sin t with n and A p sin^2 t + C n cos t
  // conserved, so that p' = (C n/A - 2 p cos t)/sin t and omega^2 = -f'/A = p^2 sin^2 t + (C n/A - 2 p cos
  // t)^2.
  constexpr double lean = 0.5, A = 0.3, C = 0.02, mgl = g * 0.5;
  for (const double n : {150.0, 300.0}) {
    const double c = std::cos(lean), s = std::sin(lean), root = std::sqrt(C * C * n * n - 4.0 * A * c * mgl),
                 p = (C * n - root) / (2.0 * A * c);
    const Top top(lean, p, n - p * c);
    const auto at = steady(
        top.scene, {.keep = {{"lean", [=](const auto& now) { return top.body.axes(now).col(2).z(); }}}});
    const auto modes = normal_modes(top.scene, at);
    ASSERT_EQ(modes.size(), 3U);
    EXPECT_TRUE(modes.is_free(0));
    EXPECT_TRUE(modes.is_free(1));
    const double rate = C * n / A - 2.0 * p * c;
    EXPECT_NEAR(modes.frequency(2), std::sqrt(p * p * s * s + rate * rate), 1e2 * rounding) << n;
    EXPECT_EQ(modes.stability(), Stability::stable) << modes.describe();
  }
}

/// Eigenvalues s of the paper's linear equations M s^2 + v C1 s + g K0 + v^2 K2, with its numbers of the
/// benchmark, of the companion matrix.
Eigen::VectorXcd published(double v) {
  Eigen::Matrix2d M, C, K0, K2;
  M << 80.81722, 2.31941332208709, 2.31941332208709, 0.29784188199686;
  C << 0.0, 33.86641391492494, -0.85035641456978, 1.68540397397560;
  K0 << -80.95, -2.59951685249872, -2.59951685249872, -0.80329488458618;
  K2 << 0.0, 76.59734589573222, 0.0, 2.65431523794604;
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  A.topRightCorner<2, 2>().setIdentity();
  A.bottomLeftCorner<2, 2>() = -M.inverse() * (g * K0 + v * v * K2);
  A.bottomRightCorner<2, 2>() = -M.inverse() * (v * C);
  return A.eigenvalues();
}

TEST(Steady, BicycleHasItsPublishedEigenvalues) {
  for (int v = 0; v <= 10; ++v) {
    const Scene<3> scene = whipple(v);
    const auto modes = normal_modes(scene, steady(scene));
    const Eigen::VectorXcd expected = published(v);
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

}  // namespace
}  // namespace dalembert::steady_test
