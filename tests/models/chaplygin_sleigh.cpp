#include "dalembert/models/chaplygin_sleigh.h"

#include <dalembert/tests/models/newton.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dalembert::models::chaplygin_sleigh_test {
namespace {

constexpr double tolerance = 1e-8;

/// u, w and the angle turned by at time t: the closed form.
struct ClosedForm {
  double u, w, theta;
  ClosedForm(const ChaplyginSleigh& c, double t) {
    const double J = c.blade_inertia(), ratio = std::sqrt(J / c.mass);
    const double U = std::hypot(c.speed, ratio * c.turn_rate), s0 = std::atanh(c.speed / U);
    const double s = s0 + c.arm * U * c.mass / J * t;
    const auto gd = [](double x) { return std::atan(std::sinh(x)); };
    u = U * std::tanh(s);
    w = U / ratio / std::cosh(s);
    theta = ratio / c.arm * (gd(s) - gd(s0));
  }
};

TEST(ChaplyginSleighReference, IsTheClosedForm) {
  const ChaplyginSleigh sleigh;
  for (const double t : {0.5, 2.0, 7.0}) {
    const ClosedForm exact(sleigh, t);
    const Observation<2> seen = sleigh.reference(t);
    const Vec<2> axis = (seen.positions[1] - seen.positions[0]) / sleigh.arm;
    constexpr double round_off = 1e-13;
    EXPECT_NEAR(axis.x(), std::cos(exact.theta), round_off);
    EXPECT_NEAR(axis.y(), std::sin(exact.theta), round_off);
    const double Z = sleigh.mass * exact.u * exact.w * sleigh.inertia / sleigh.blade_inertia();
    EXPECT_NEAR(seen.forces[0], Z, round_off);
  }
}

TEST(ChaplyginSleighReference, ForceIsMassTimesAccelerationOfTheCentre) {
  const ChaplyginSleigh sleigh;
  for (const double t : {0.5, 2.0, 4.0}) {
    const Observation<2> seen = sleigh.reference(t);
    const Vec<2> axis = (seen.positions[1] - seen.positions[0]) / sleigh.arm;
    const auto a = Stencil(sleigh.model(), t, 1e-2, 1).acceleration();
    const Vec<2> ma = sleigh.mass * a.value;
    EXPECT_NEAR(ma.dot(axis), 0.0, sleigh.mass * a.error);  // the blade only pushes across
    EXPECT_NEAR(axis.x() * ma.y() - axis.y() * ma.x(), seen.forces[0], sleigh.mass * a.error);
  }
}

TEST(ChaplyginSleigh, BladeForceAndTurnAreTheClosedForm) {
  const ChaplyginSleigh sleigh;
  const SleighScene built = sleigh.scene();
  const auto run = simulate(built.scene, {.t_end = 10.0, .tolerance = tolerance});
  const double scale = sleigh.model().force;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const ClosedForm exact(sleigh, run.times()[i]);
    const double Z = sleigh.mass * exact.u * exact.w * sleigh.inertia / sleigh.blade_inertia();
    EXPECT_NEAR(run.multiplier(built.edge, i), Z, 1e-4 * scale);
    const Vec<2> axis = built.body.axes(run.sample(i)).col(0);
    EXPECT_LT((axis - Vec<2>(std::cos(exact.theta), std::sin(exact.theta))).norm(), 1e-5);
  }
}

// Blade first is unstable: any slow turn grows until the sleigh has turned round.
TEST(ChaplyginSleigh, TurnsInAllByPiTimesARootOfTheInertias) {
  ChaplyginSleigh sleigh;
  sleigh.turn_rate = 1e-2;
  const SleighScene built = sleigh.scene();
  const double J = sleigh.blade_inertia(), k = sleigh.arm * sleigh.mass / J;  // w decays like exp(-k U t)
  const double U = std::hypot(sleigh.speed, std::sqrt(J / sleigh.mass) * sleigh.turn_rate);
  const double t_end = 2.0 * std::atanh(-sleigh.speed / U) / (k * U);
  Simulation<2> simulation(built.scene, {.t_end = t_end, .tolerance = tolerance});
  double turned = 0.0;
  Vec<2> axis(1.0, 0.0);
  constexpr int samples = 1000;
  for (int i = 1; i <= samples; ++i) {
    simulation.advance_to(t_end * i / samples);
    const Vec<2> next = built.body.axes(simulation.sample()).col(0);
    turned += std::atan2(axis.x() * next.y() - axis.y() * next.x(), axis.dot(next));
    axis = next;
  }
  // By symmetry the run ends with w as at the start. Both tails lack J/(m a) w/U to first order of w/U,
  // and to third, (w/U)^3/3, less than 1e-6.
  const double all =
      std::numbers::pi * std::sqrt(1.0 + sleigh.inertia / (sleigh.mass * sleigh.arm * sleigh.arm));
  const double tails = 2.0 * J / (sleigh.mass * sleigh.arm) * sleigh.turn_rate / U;
  EXPECT_NEAR(turned, all - tails, 1e-5 * all);
}

}  // namespace
}  // namespace dalembert::models::chaplygin_sleigh_test
