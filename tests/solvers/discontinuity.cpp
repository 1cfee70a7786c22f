#include "../both_steppers.h"
#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/autodiff/functions.h>
#include <dalembert/dalembert.h>
#include <dalembert/tests/solvers/flight.h>

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace dalembert::discontinuity_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double g = 9.81;

/// The outcomes of the comparisons that f makes.
template <class F>
std::vector<int> sides(const F& f, const Branches::Sides* held = nullptr) {
  Branches::Sides recorded;
  const Branches recording(&recorded, held);
  Branches::enter_batch(0);
  f();
  std::vector<int> all;
  for (const auto& one : recorded[0]) all.push_back(one.side);
  return all;
}

TEST(Branches, TellTheSidesOfAKinkApartAndItsEdge) {
  using S = Jet<1>;
  const auto outcome = [](double x) { return sides([x] { (void)abs(S::input(x, 0)); }); };
  EXPECT_EQ(outcome(2.0), outcome(1.0));
  EXPECT_EQ(outcome(-2.0), outcome(-1.0));
  EXPECT_NE(outcome(-1.0), outcome(1.0));
  EXPECT_NE(outcome(0.0), outcome(1.0));
}

TEST(Branches, HeldBranchGoesOnBeyondItsEnd) {
  using S = Jet<1>;
  Branches::Sides held;
  {
    const Branches recording(&held, nullptr);
    Branches::enter_batch(0);
    (void)abs(S::input(1.5, 0));
    (void)floor(S::input(1.5, 0));
  }
  Branches::Sides recorded;
  const Branches holding(&recorded, &held);
  Branches::enter_batch(0);
  EXPECT_EQ(abs(S::input(-2.0, 0)).value, -2.0);
  EXPECT_EQ(floor(S::input(2.25, 0)).value, 1.0);
  EXPECT_EQ(recorded[0].front().difference, -2.0);  // from 0
  EXPECT_EQ(recorded[0].back().difference, -0.25);  // behind 2
}

TEST(Branches, ComparisonsAreRecordedOnlyWhileSomebodyListens) {
  EXPECT_EQ(sides([] { EXPECT_FALSE((Jet<1>(1.0) < 0.0)); }).size(), 1U);
  EXPECT_TRUE((Jet<1>(1.0) > 0.0));
}

Options explicitly(double t_end, double tolerance) {
  return {.t_end = t_end, .samples = 11, .tolerance = tolerance, .stepper = Stepper::erk};
}

class Kinks : public testing::TestWithParam<double> {};
// A power of ten apart and in between, where steps of other lengths meet the kink elsewhere.
INSTANTIATE_TEST_SUITE_P(AtTolerances, Kinks,
                         testing::Values(1e-4, 1e-5, 3e-6, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12));

// A spring of rate k on one side of x = 0 is in contact for half a period, pi/sqrt(k), and returns the speed
// of approach. An error of velocity is one of position over the 2 s that follow; both count like the scene,
// of some metres and seconds.
TEST_P(Kinks, OneSidedSpringReturnsTheSpeed) {
  const double k = 400.0, x0 = 0.5, t_end = 3.0;
  OnALine line(x0, -1.0);
  line.scene.add(potential(points(line.body),
                           [k](const auto& r) {
                             using S = std::remove_cvref_t<decltype(r[0])>;
                             return r[0] < 0.0 ? S(0.5 * k * r[0] * r[0]) : S(0.0);
                           }),
                 "bumper");
  const auto run = simulate(line.scene, explicitly(t_end, GetParam()));
  const double leaves = x0 + std::numbers::pi / std::sqrt(k);
  const double bound = 3.0 * static_cast<double>(run.statistics().steps) * GetParam();
  EXPECT_NEAR(run.position(line.body, 10).x(), t_end - leaves, bound);
  EXPECT_NEAR(run.velocity(line.body, 10).x(), 1.0, bound);
}

// V = |x|: from the edge at speed 1 out, back after 2, and as far on the other side.
TEST_P(Kinks, KinksOfAPotentialAreMetAtTheStartAndOnTheWay) {
  OnALine line(0.0, 1.0);
  line.scene.add(potential(points(line.body), [](const auto& r) { return abs(r[0]); }), "vee");
  const auto run = simulate(line.scene, explicitly(3.0, GetParam()));
  const double bound = 3.0 * static_cast<double>(run.statistics().steps) * GetParam();
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i], s = t < 2.0 ? t : t - 2.0, x = s - 0.5 * s * s;
    EXPECT_NEAR(run.position(line.body, i).x(), t < 2.0 ? x : -x, bound);
  }
}

// No error estimate would see an effect of 1e-3: it weights a jump between the 6th and the 9th stage by a
// thousandth of what the step does.
TEST_P(Kinks, ForceActsFromItsInstantOn) {
  for (const double begin : {0.21, 0.51, 0.55, 0.83}) {
    OnALine line(0.0, 1.0);
    line.push([begin](const auto& t, const auto&, const auto&) { return t >= begin ? 1.0 : 0.0; }, "wind");
    const auto run = simulate(line.scene, explicitly(1.0, GetParam()));
    const double blown = 1.0 - begin;
    EXPECT_NEAR(run.position(line.body, 10).x(), 1.0 + 0.5 * blown * blown,
                3.0 * static_cast<double>(run.statistics().steps) * GetParam());
  }
}

// 4 N while sin(w t + 0.1) > 0: many times within the steps of a motion that is a parabola.
TEST_P(Kinks, AllJumpsOfASquareWaveAreMet) {
  for (const double w : {10.0, 20.0, 30.0, 60.0}) {
    OnALine line(0.0, 1.0);
    line.push([w](const auto& t, const auto&, const auto&) { return sin(w * t + 0.1) > 0.0 ? 4.0 : 0.0; },
              "wave");
    double x = 0.0, v = 1.0, t = 0.0;
    for (int k = 0; t < 2.0; ++k) {
      const double next = std::min(2.0, ((k + 1) * std::numbers::pi - 0.1) / w), h = next - t,
                   a = k % 2 == 0 ? 4.0 : 0.0;
      x += v * h + 0.5 * a * h * h;
      v += a * h;
      t = next;
    }
    const auto run = simulate(line.scene, explicitly(2.0, GetParam()));
    EXPECT_NEAR(run.position(line.body, 10).x(), x,
                3.0 * static_cast<double>(run.statistics().steps) * GetParam())
        << w;
  }
}

// F = 1 beyond x = 2 and 2 in front of it: thrown at it so that it just gets there, the particle turns at the
// switch. An error of 3 tol of the place leaves it behind for sqrt(2 * 3 tol) twice, at another force by 1 N.
TEST_P(Kinks, KinkTouchedAtATurningPointIsPassed) {
  for (int k = 0; k < 100; ++k) {
    const double v = (k % 2 == 0 ? 0.5 : 1.0) + 0.01 * k, x0 = 2.0 + 0.5 * v * v;
    OnALine line(x0, -v);
    line.push([](const auto&, const auto& x, const auto&) { return x > 2.0 ? 1.0 : 2.0; }, "kink");
    const auto run = simulate(line.scene, explicitly(2.0 * v + 1.0, GetParam()));
    const double bound = 2.0 * std::sqrt(6.0 * GetParam()) * (v + 1.0);
    for (std::size_t i = 0; i < run.size(); ++i) {
      const double t = run.times()[i];
      EXPECT_NEAR(run.position(line.body, i).x(), x0 - v * t + 0.5 * t * t, bound) << v;
    }
  }
}

// a = -+3 on the two sides of x + v = 0: v - 3 < 0 and v + 3 > 0 there, so both lead to it.
TEST(Chatter, IsSaidByTheNameOfTheForce) {
  OnALine line(0.0, 1.0);
  line.push([](const auto&, const auto& x, const auto& v) { return x + v > 0.0 ? -3.0 : 3.0; }, "relay");
  EXPECT_THAT(
      [&] { (void)simulate(line.scene, explicitly(3.0, 1e-8)); },
      ThrowsMessage<IntegrationFailure>(AllOf(HasSubstr("ForceLaw \"relay\""), HasSubstr("chatter"))));
}

TEST(Corner, StopsTheBeadByTheNameOfTheCurve) {
  Scene<2> scene("vee");
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto bead = scene.add_particle({.mass = 1.0, .position = {1.0, 1.0}}, "bead");
  scene.add(OnCurve{bead, [](auto r) { return r.y() - abs(r.x()); }}, "vee");
  for (const double tolerance : {1e-3, 1e-5, 1e-8, 1e-11}) {
    try {
      (void)simulate(scene, explicitly(2.0, tolerance));
      ADD_FAILURE() << "an impact has no equation";
    } catch (const IntegrationFailure& failure) {
      EXPECT_THAT(failure.what(), AllOf(HasSubstr("OnCurve \"vee\""), HasSubstr("gradient")));
      // Down a slope of 45 degrees, g/2 each way, from 1 m.
      EXPECT_NEAR(failure.time(), std::sqrt(4.0 / g), 10.0 * tolerance);
      EXPECT_EQ(failure.trajectory<2>().size(), 4U);
    }
  }
}

/// A block on a slope of 0.5 rad, pushed up it.
struct OnASlope {
  Scene<3> scene{"slope"};
  Particle<3> block;
  Constraint<1> table;

  explicit OnASlope(const Vec<3>& push)
      : block((scene.add(UniformGravity<3>{{g * std::sin(0.5), 0.0, -g * std::cos(0.5)}}),
               scene.add_particle({.mass = 2.0, .velocity = push}, "block"))),
        table(scene.add(OnSurface{block, Plane<3>{}}, "table")) {}
  template <class Law>
  void rub(Law law) {
    scene.add(friction_law(table, points(block), law), "rub");
  }
};

auto coulomb(double mu) {
  return [mu](auto N, auto, auto v) { return (-mu * N * v.normalized()).eval(); };
}

class Friction : public testing::TestWithParam<Stepper> {
 protected:
  [[nodiscard]] static Options options(double tolerance) {
    return {.t_end = 1.0, .samples = 11, .tolerance = tolerance, .stepper = GetParam()};
  }
};
INSTANTIATE_TEST_SUITE_P(InBothSteppers, Friction, both_steppers, stepper_name);

// mu = 0.7 > tan(0.5) = 0.546: it stops after v/(g (sin + mu cos)).
TEST_P(Friction, StopsTheRunWhenItSticks) {
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    OnASlope slope({-2.0, 0.0, 0.0});
    slope.rub(coulomb(0.7));
    try {
      (void)simulate(slope.scene, options(tolerance));
      ADD_FAILURE() << "nothing in the equations holds the block";
    } catch (const IntegrationFailure& failure) {
      EXPECT_THAT(failure.what(), AllOf(HasSubstr("FrictionLaw \"rub\" would stick"), HasSubstr("small^2")));
      EXPECT_NEAR(failure.time(), 2.0 / (g * (std::sin(0.5) + 0.7 * std::cos(0.5))), 10.0 * tolerance);
    }
  }
}

TEST_P(Friction, StopsTheRunAtItsStartWhereItHolds) {
  OnASlope slope({0.0, 0.0, 0.0});
  slope.rub(coulomb(0.7));
  EXPECT_THAT([&] { (void)simulate(slope.scene, options(1e-6)); },
              ThrowsMessage<IntegrationFailure>(
                  AllOf(HasSubstr("stopped at t = 0:"), HasSubstr("FrictionLaw \"rub\" would stick"))));
}

TEST_P(Friction, LetsTheBlockSlideFromRestWhereItIsWeaker) {
  OnASlope slope({0.0, 0.0, 0.0});
  slope.rub(coulomb(0.3));
  const auto run = simulate(slope.scene, options(1e-8));
  const double a = g * (std::sin(0.5) - 0.3 * std::cos(0.5));
  EXPECT_NEAR(run.position(slope.block, 10).x(), 0.5 * a, 1e3 * 1e-8);
}

TEST_P(Friction, LetsTheBlockTurnBackWhereItIsWeaker) {
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    OnASlope slope({-2.0, 0.0, 0.0});
    slope.rub(coulomb(0.3));
    const auto run = simulate(slope.scene, options(tolerance));
    const double up = g * (std::sin(0.5) + 0.3 * std::cos(0.5)),
                 down = g * (std::sin(0.5) - 0.3 * std::cos(0.5));
    const double back = 1.0 - 2.0 / up;
    EXPECT_NEAR(run.position(slope.block, 10).x(), -2.0 / up + 0.5 * down * back * back, 1e3 * tolerance);
  }
}

// Across the slope the direction of sliding turns, the speed never vanishes, and nothing is to be reported:
// v' = g (sin(0.5) e_x - 0.3 cos(0.5) v/|v|), by Runge-Kutta of order 4 in steps whose error is round-off.
TEST_P(Friction, TurnsTheBlockRound) {
  OnASlope slope({-2.0, 0.5, 0.0});
  slope.rub(coulomb(0.3));
  const auto run = simulate(slope.scene, options(1e-8));
  const auto rate = [](const Vec<2>& v) {
    return Vec<2>(g * std::sin(0.5) * Vec<2>::UnitX() - 0.3 * g * std::cos(0.5) * v.normalized());
  };
  constexpr int steps = 20'000;
  constexpr double h = 1.0 / steps;
  Vec<2> r = Vec<2>::Zero(), v(-2.0, 0.5);
  for (int i = 0; i < steps; ++i) {
    const Vec<2> k1 = rate(v), k2 = rate(v + 0.5 * h * k1), k3 = rate(v + 0.5 * h * k2),
                 k4 = rate(v + h * k3);
    r += h * v + h * h / 6.0 * (k1 + k2 + k3);
    v += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  EXPECT_LE((run.position(slope.block, 10).head<2>() - r).norm(), 1e3 * 1e-8);
}

// Smoothed over speeds of 1e-2 the block creeps down with v/sqrt(v^2 + 1e-4) = tan(0.5)/0.7.
TEST_P(Friction, CreepsIfSmoothed) {
  OnASlope slope({-2.0, 0.0, 0.0});
  slope.rub([](auto N, auto, auto v) { return (-0.7 * N / sqrt(v.squaredNorm() + 1e-4) * v).eval(); });
  const auto run = simulate(slope.scene, options(1e-8));
  const double part = std::tan(0.5) / 0.7;
  EXPECT_NEAR(run.velocity(slope.block, 10).x(), 1e-2 * part / std::sqrt(1.0 - part * part), 1e3 * 1e-8);
}

}  // namespace
}  // namespace dalembert::discontinuity_test
