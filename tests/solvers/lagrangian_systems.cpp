#include "lagrangians.h"
#include <dalembert/core/lagrange/accelerations.h>
#include <dalembert/tests/finite_differences.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

namespace dalembert::lagrangian_systems_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(LagrangeTerms, EqualTheDerivativesOfTheFunction) {
  const auto function = [](const auto& t, const auto& q, const auto& v) {
    return 0.5 * (1.0 + q[1] * q[1]) * v[0] * v[0] + sin(t * q[0]) * v[1] + exp(0.3 * v[0] * v[1]) -
           q[0] * q[1];
  };
  const LagrangianOf<2, decltype(function)> L(function);
  const double t = 0.7;
  const Vec<2> q(0.4, -1.1), v(0.8, 0.5);
  const auto terms = L.terms(t, q, v);
  EXPECT_EQ(terms.L, function(t, q, v));
  for (int k = 0; k < 2; ++k) {
    const Vec<2> e = Vec<2>::Unit(k);
    const auto at = [&](double s_q, double s_v) { return L.terms(t, q + s_q * e, v + s_v * e); };
    const auto number = [](double x) { return Eigen::VectorXd::Constant(1, x); };
    expect_slope(slope([&](double s) { return number(at(s, 0.0).L); }), number(terms.L_q[k]), "L_q");
    expect_slope(slope([&](double s) { return number(at(0.0, s).L); }), number(terms.L_v[k]), "L_v");
    expect_slope(slope([&](double s) { return Eigen::VectorXd(at(s, 0.0).L_v); }), terms.L_vq.col(k), "L_vq");
    expect_slope(slope([&](double s) { return Eigen::VectorXd(at(0.0, s).L_v); }), terms.L_vv.col(k), "L_vv");
  }
  expect_slope(slope([&](double s) { return Eigen::VectorXd(L.terms(t + s, q, v).L_v); }), terms.L_vt,
               "L_vt");
}

/// Of matrices and columns of Eigen.
detail::Accelerations accelerations_of(const Eigen::MatrixXd& M, const Eigen::VectorXd& f,
                                       const Eigen::MatrixXd& A, const Eigen::VectorXd& gamma) {
  const Eigen::MatrixXd rows = A.transpose();
  return detail::accelerations({M.data(), M.data() + M.size()}, {f.data(), f.data() + f.size()},
                               {{rows.data(), rows.data() + rows.size()}, {gamma.begin(), gamma.end()}});
}

TEST(Accelerations, ObeyTheConstraintsAndLeaveForcesOfConstraintOnly) {
  // Indefinite, in units that differ by nine digits, and with a row that is the sum of two others.
  Eigen::MatrixXd M(4, 4), A(3, 4);
  M << 2.0, 0.3, 0.0, 1e-9, 0.3, -1.0, 0.2, 0.0, 0.0, 0.2, 1.5, 0.0, 1e-9, 0.0, 0.0, 1e-18;
  A << 1.0, 0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 1.0, 2.0, 1.0, 0.0;
  const Eigen::Vector4d f(1.0, 2.0, -1.0, 3e-9);
  const Eigen::Vector3d gamma(0.5, -0.3, 0.2);
  const auto found = accelerations_of(M, f, A, gamma);
  ASSERT_TRUE(found.determined);
  const Eigen::Vector4d a(found.a.data());
  constexpr double rounding = 1e-14;  // of numbers near 1, over a handful of operations
  EXPECT_LE((A * a + gamma).cwiseAbs().maxCoeff(), rounding);
  const Eigen::Vector4d reaction = M * a - f;  // a combination of the rows of A
  EXPECT_NEAR(reaction[0], reaction[2], rounding);
  EXPECT_NEAR(reaction[3], 0.0, 1e-9 * rounding);
}

TEST(Accelerations, SayAlongWhatThereIsNoInertia) {
  const Eigen::Matrix2d M = Eigen::Matrix2d::Ones();
  const Eigen::Vector2d f(1.0, 0.0);
  const auto found = accelerations_of(M, f, Eigen::MatrixXd(0, 2), Eigen::VectorXd(0));
  ASSERT_FALSE(found.determined);
  EXPECT_NEAR(found.a[0] + found.a[1], 0.0, 1e-15);
  EXPECT_GT(std::abs(found.a[0]), 0.0);
  // A constraint that forbids that direction leaves a regular system: a = (0, a_1), a_1 = f_1 = 0.
  const Eigen::RowVector2d A(1.0, 0.0);
  EXPECT_TRUE(accelerations_of(M, f, A, Eigen::VectorXd::Zero(1)).determined);
}

TEST(LagrangianSystems, SayWhereAndAlongWhatNoAccelerationFollows) {
  const LagrangianSystem<2> together(
      {.position = {1.0, 2.0}},
      [](const auto& q, const auto& v) { return 0.5 * (v[0] + v[1]) * (v[0] + v[1]) - q[0] * q[1]; }, "pair");
  EXPECT_THAT(
      [&] { (void)simulate(together, {.t_end = 1.0}); },
      ThrowsMessage<InconsistentStart>(AllOf(HasSubstr("Lagrangian \"pair\""), HasSubstr("q = (1, 2)"),
                                             HasSubstr("singular"), HasSubstr("t = 0"))));
  const LagrangianSystem<1> still({.position = Vec<1>(1.0)},
                                  [](const auto& q, const auto& /*v*/) { return q[0] * q[0]; });
  EXPECT_THAT([&] { (void)simulate(still, {.t_end = 1.0}); },
              ThrowsMessage<InconsistentStart>(HasSubstr("has no inertia")));
  const LagrangianSystem<1> undefined(
      {.position = Vec<1>(-1.0)}, [](const auto& q, const auto& v) { return 0.5 * v[0] * v[0] - log(q[0]); });
  EXPECT_THAT([&] { (void)simulate(undefined, {.t_end = 1.0}); },
              ThrowsMessage<InconsistentStart>(HasSubstr("no finite value")));
}

TEST(LagrangianSystems, RefuseWhatMakesNoSense) {
  const auto free = [](const auto& /*q*/, const auto& v) { return 0.5 * v[0] * v[0]; };
  EXPECT_THAT([&] { LagrangianSystem<1>({.scale = Vec<1>(0.0), .names = {"x"}}, free); },
              ThrowsMessage<InvalidScene>(AllOf(HasSubstr("\"x\""), HasSubstr("scale = 0"))));
  EXPECT_THROW(LagrangianSystem<1>({.position = Vec<1>(std::nan(""))}, free), InvalidScene);
  EXPECT_THAT([&] { LagrangianSystem<1>({}, std::shared_ptr<const Lagrangian<1>>(), "none"); },
              ThrowsMessage<InvalidScene>(HasSubstr("\"none\" has no Lagrangian")));
  for (const int none : {-1, 1, 7}) {
    EXPECT_THAT([&] { (void)LagrangianSystem<1>({}, free, "free").name(none); },
                ThrowsMessage<InvalidArgument>(
                    AllOf(HasSubstr("\"free\" has no coordinate"), HasSubstr("it has 1, counted from 0"))));
  }
  LagrangianSystem<1> forced({}, free);
  EXPECT_THROW(forced.apply(nullptr), InvalidArgument);
  LagrangianSystem<1> off({.position = Vec<1>(1.0)}, free);
  off.constrain([](const auto& q) { return q[0] - 2.0; }, "stop");
  EXPECT_THAT([&] { (void)simulate(off, {.t_end = 1.0}); },
              ThrowsMessage<InconsistentStart>(HasSubstr("stop")));
}

TEST(LagrangianSystems, AndTheirMotionsCanBeReadAfterTheyWereMoved) {
  LagrangianSystem<2> system(
      {.position = Vec<2>(1.0, 2.0)},
      [](const auto& q, const auto& v) { return 0.5 * v.squaredNorm() - q[0]; }, "falling");
  const auto rail = system.constrain([](const auto& q) { return q[0] - q[1] + 1.0; }, "rail");
  const LagrangianSystem<2> taken = std::move(system);
  EXPECT_EQ(system.name(), "falling");  // NOLINT(bugprone-use-after-move)
  EXPECT_EQ(system.cyclic(), taken.cyclic());
  auto motion = simulate(system, {.t_end = 1.0, .samples = 2});
  const auto kept = std::move(motion);
  EXPECT_EQ(motion.acceleration(1), kept.acceleration(1));  // NOLINT(bugprone-use-after-move)
  EXPECT_EQ(motion.multiplier(rail, 1), kept.multiplier(rail, 1));
}

TEST(LagrangianSystems, GiveTheirDerivativesToNewtonsMatrix) {
  const Polar pendulum;
  const System system = pendulum.system.rotor_scene(0.0).system();
  const std::vector<double> q{1.0, 0.8}, v{0.0, 1.3}, lambda{0.0};
  auto terms = system.linearisation();
  system.linearise_forces({0.0, q, v}, lambda, terms);
  const auto force = [&](std::size_t k, double s_q, double s_v) {
    auto e = system.evaluation();
    std::vector<double> at_q = q, at_v = v;
    at_q[k] += s_q;
    at_v[k] += s_v;
    system.evaluate({0.0, at_q, at_v}, e);
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(e.force.data(), 2));
  };
  // Both are differences of steps near 1e-5 of forces near 10: 1e-9 of them.
  constexpr double of_differences = 1e-8;
  for (std::size_t k = 0; k < 2; ++k) {
    const Slope by_q = slope([&](double s) { return force(k, s, 0.0); }),
                by_v = slope([&](double s) { return force(k, 0.0, s); });
    for (std::size_t row = 0; row < 2; ++row) {
      const auto entry = system.stiffness_of_constraints() + 2 * row + k;
      EXPECT_NEAR(terms.stiffness[entry], by_q.value[static_cast<int>(row)], of_differences);
      EXPECT_NEAR(terms.damping[2 * row + k], by_v.value[static_cast<int>(row)], of_differences);
    }
  }
}

TEST(RouthReduction, TellsTheRateOfTheCoordinateLeftOut) {
  // A particle in the field -1/r: of r'' = beta^2/r^3 - 1/r^2 only r is left, and phi' = beta/r^2.
  const LagrangianSystem<2> kepler({.position = {1.0, 0.3}, .velocity = {0.2, 0.9}},
                                   [](const auto& q, const auto& v) {
                                     return 0.5 * (v[0] * v[0] + q[0] * q[0] * v[1] * v[1]) + 1.0 / q[0];
                                   });
  const auto radial = reduced(kepler, 1);
  EXPECT_EQ(radial.routhian->momentum(), 0.9);
  const Options options{.t_end = 3.0, .samples = 7, .tolerance = tolerance};
  const auto all = simulate(kepler, options);
  const auto one = simulate(radial.system, options);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_NEAR(one.position(i)[0], all.position(i)[0], bound);
    const double r = one.position(i)[0];
    EXPECT_NEAR(one.acceleration(i)[0], 0.81 / (r * r * r) - 1.0 / (r * r), 1e-12);
    EXPECT_NEAR(radial.routhian->rate(0.0, one.position(i), one.velocity(i)), all.velocity(i)[1], bound);
  }
}

TEST(RouthReduction, FindsRatesOfAMomentumThatIsNotLinearInThem) {
  // p = x' + 4 x'^3 + y: from the rate at the start, through rates near 0.
  const LagrangianSystem<2> system({.velocity = {1.0, 0.0}}, [](const auto& q, const auto& v) {
    return 0.5 * v[0] * v[0] + v[0] * v[0] * v[0] * v[0] + v[0] * q[1] + 0.5 * v[1] * v[1];
  });
  const auto left = reduced(system, 0);
  for (double y = -10.0; y <= 20.0; y += 0.01) {
    const double x = left.routhian->rate(0.0, Vec<1>(y), Vec<1>(0.0));
    // Round-off of p over its slope, 1 at least.
    EXPECT_NEAR(x + 4.0 * x * x * x + y, 5.0, 1e-13 * 20.0);
  }
}

TEST(LagrangianSystems, CoordinateThatMattersElsewhereIsNotCyclic) {
  const LagrangianSystem<2> stop({}, [](const auto& q, const auto& v) {
    const auto pressed = max(q[0] - 3.0, 0.0);
    return 0.5 * v.squaredNorm() - pow(pressed, 4.0) + cos(q[1]);
  });
  EXPECT_TRUE(stop.cyclic().empty());
}

TEST(RouthReduction, IsRefusedWhereTheMomentumIsNotConserved) {
  const auto free = [](const auto& q, const auto& v) { return 0.5 * v.squaredNorm() - q[1] * q[1]; };
  LagrangianSystem<2> system({.position = {0.0, 1.0}, .names = {"x", "y"}}, free);
  EXPECT_THAT([&] { (void)reduced(system, 1); },
              ThrowsMessage<InvalidArgument>(AllOf(HasSubstr("\"y\""), HasSubstr("not cyclic"))));
  EXPECT_THROW((void)reduced(system, 2), InvalidArgument);
  system.apply([](double, const Vec<2>&, const Vec<2>& v) -> Vec<2> { return -v; });
  EXPECT_THAT([&] { (void)reduced(system, 0); }, ThrowsMessage<InvalidArgument>(HasSubstr("not conserved")));
}

}  // namespace
}  // namespace dalembert::lagrangian_systems_test
