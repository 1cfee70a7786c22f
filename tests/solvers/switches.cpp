#include <dalembert/constraints/holonomic.h>
#include <dalembert/constraints/on_curve.h>
#include <dalembert/constraints/unilateral.h>
#include <dalembert/core/forces/forces.h>
#include <dalembert/core/points/points.h>
#include <dalembert/core/scene/scene.h>
#include <dalembert/solvers/simulation.h>
#include <dalembert/tests/both_steppers.h>
#include <dalembert/tests/solvers/flight.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

/// Comparisons in equations: what lies between two switches is seen whatever the step.
namespace dalembert::switches_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double g = 9.81;

class Switches : public testing::TestWithParam<StepperAt> {
 protected:
  [[nodiscard]] static double tolerance() { return GetParam().tolerance; }
  [[nodiscard]] static Options options(double t_end) {
    return {.t_end = t_end, .samples = 11, .tolerance = tolerance(), .stepper = GetParam().stepper};
  }
  /// The scenes have some metres and seconds: each step may err by the tolerance in position and velocity,
  /// and both grow with the few seconds that follow.
  [[nodiscard]] static double bound(const Trajectory<2>& run) {
    return 5.0 * static_cast<double>(run.statistics().steps) * tolerance();
  }
};
INSTANTIATE_TEST_SUITE_P(InBothSteppers, Switches, both_steppers_at({1e-4, 1e-6, 1e-8, 1e-10, 1e-12}),
                         tolerance_name);

/// x of a motion from speed v at x = 0 back to there with the force f against it.
double thrown(double v, double f, double t) { return v * t - 0.5 * f * t * t; }

// V = 3 + 3x below -0.3, -7x in between, 3x above 0, energy 1.1: there and back between 1.1/3 and -1.1/7,
// with speed sqrt(2.2) at 0.
TEST_P(Switches, BandBetweenEqualSlopesTurnsTheMotionBack) {
  Flight flight(0.2, 1.0);
  flight.in_potential([](auto x) {
    if (x < -0.3) return 3.0 + 3.0 * x;
    if (x < 0.0) return -7.0 * x;
    return 3.0 * x;
  });
  const auto run = simulate(flight.scene, options(5.0));
  const double speed = std::sqrt(2.2), right = 2.0 * speed / 3.0, left = 2.0 * speed / 7.0;
  const double first = (speed - 1.0) / 3.0;  // since it would have left 0
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double phase = std::fmod(run.times()[i] + first, right + left);
    const double x = phase < right ? thrown(speed, 3.0, phase) : -thrown(speed, 7.0, phase - right);
    EXPECT_NEAR(run.position(flight.body, i).x(), x, bound(run));
    EXPECT_NEAR(run.energy(i), 1.1, 7.0 * bound(run));
  }
}

// Free flight at 1 m/s over two ridges of width 2w and height h at 1 and 2 m, whatever their width: each
// delays by twice the time over a slope less 2w.
TEST_P(Switches, AllSwitchesOfTwoNarrowRidgesInOneStepAreSeen) {
  for (const double w : {0.1, 1e-3, 1e-5}) {
    const double h = 0.3;
    Flight flight(0.0, 1.0);
    flight.in_potential(
        [=](auto x) { return h * (max(1.0 - abs(x - 1.0) / w, 0.0) + max(1.0 - abs(x - 2.0) / w, 0.0)); });
    const auto run = simulate(flight.scene, options(5.0));
    const double over = 2.0 * (1.0 - std::sqrt(1.0 - 2.0 * h)) / (h / w);
    // An error of position on a slope is one of energy.
    const double all = (1.0 + h / w) * bound(run);
    EXPECT_NEAR(run.position(flight.body, 10).x(), 5.0 - 2.0 * (over - 2.0 * w), all) << w;
    EXPECT_NEAR(run.velocity(flight.body, 10).x(), 1.0, all) << w;
  }
}

// A saw-tooth of slopes +-s and period 1: half a tooth up takes as long as one down.
TEST_P(Switches, AllTeethOfASawWrittenWithFloorArePassed) {
  const double s = 0.5, v = 1.0;
  Flight flight(0.0, v);
  flight.in_potential([=](auto x) { return s * abs(x - floor(x + 0.5)); });
  const double up = (v - std::sqrt(v * v - s)) / s;  // over 1/2
  const auto run = simulate(flight.scene, options(20.0 * up));
  EXPECT_NEAR(run.position(flight.body, 10).x(), 10.0, bound(run));
  EXPECT_NEAR(run.velocity(flight.body, 10).x(), v, bound(run));
  EXPECT_NEAR(run.position(flight.body, 5).x(), 5.0, bound(run));
}

// Backlash: a spring of rate k behind a gap d on either side.
TEST_P(Switches, BacklashReturnsTheSpeed) {
  const double k = 50.0, d = 0.2;
  Flight flight(0.0, 1.0);
  flight.in_potential([=](auto x) {
    using S = decltype(x);
    const S past = x > d ? S(x - d) : x < -d ? S(x + d) : S(0.0);
    return 0.5 * k * past * past;
  });
  const double half = 2.0 * d + std::numbers::pi / std::sqrt(k);
  const auto run = simulate(flight.scene, options(4.0 * half));
  EXPECT_NEAR(run.position(flight.body, 10).x(), 0.0, bound(run));
  EXPECT_NEAR(run.velocity(flight.body, 10).x(), 1.0, 10.0 * bound(run));
}

// A well with a flat bottom of width 2, walls of slope 5: 2/v across, 2v/5 at a wall.
TEST_P(Switches, EndOfAFlatBottomIsSeenFromIt) {
  const double v = 0.7;
  Flight flight(0.0, v);
  flight.in_potential([](auto x) { return 5.0 * max(abs(x) - 1.0, 0.0); });
  const double period = 2.0 * (2.0 / v + 2.0 * v / 5.0);
  const auto run = simulate(flight.scene, options(2.0 * period));
  EXPECT_NEAR(run.position(flight.body, 10).x(), 0.0, bound(run));
  EXPECT_NEAR(run.velocity(flight.body, 10).x(), v, bound(run));
  EXPECT_NEAR(run.position(flight.body, 5).x(), 0.0, bound(run));
}

// A push of 1 N for as long as `brief` within a run of 3 s.
TEST_P(Switches, KickIsSeenHoweverBrief) {
  for (const double brief : {0.5, 1e-3, 1e-6}) {
    Flight flight(0.0, 1.0);
    flight.push(
        [=](const auto& t, const auto& x, const auto&) {
          using S = std::remove_cvref_t<decltype(x)>;
          return t > 1.0 && t < 1.0 + brief ? S(1.0 / brief) : S(0.0);
        },
        "kick");
    const auto run = simulate(flight.scene, options(3.0));
    // The kick lasts as long to the rounding of the times of its ends.
    const double all = bound(run) + 4.0 * std::numeric_limits<double>::epsilon() / brief;
    EXPECT_NEAR(run.velocity(flight.body, 10).x(), 2.0, all) << brief;
    EXPECT_NEAR(run.position(flight.body, 10).x(), 5.0 - 0.5 * brief, 2.0 * all) << brief;
  }
}

// Constant drag d < g against the velocity: up with g + d, down with g - d.
TEST_P(Switches, DragTurnsWithTheVelocity) {
  const double d = 3.0, v = 5.0, up = v / (g + d), t_end = 1.5;
  Flight flight(0.0, v);
  flight.push(
      [](const auto&, const auto& x, const auto& v_x) {
        using S = std::remove_cvref_t<decltype(x)>;
        return S(v_x > 0.0 ? -g - 3.0 : -g + 3.0);
      },
      "gravity and drag");
  const auto run = simulate(flight.scene, options(t_end));
  const double down = t_end - up;
  EXPECT_NEAR(run.position(flight.body, 10).x(), 0.5 * v * up - 0.5 * (g - d) * down * down, bound(run));
}

// Hertz's contact: a force that has no value on the other side. It returns the speed, after
// 2 (v^2/(0.8 k))^(2/5)/v int_0^1 dx/sqrt(1 - x^(5/2)) = 2.9432 (...) (Johnson, Contact Mechanics, 11.24).
TEST_P(Switches, RootThatEndsAtItsSwitchIsPassed) {
  const double k = 1000.0, v = 1.0;
  Flight flight(0.5, -v);
  flight.push(
      [=](const auto&, const auto& x, const auto&) {
        using S = std::remove_cvref_t<decltype(x)>;
        return x < 0.0 ? S(k * pow(-x, 1.5)) : S(0.0);
      },
      "Hertz");
  const auto run = simulate(flight.scene, options(3.0));
  const double depth = std::pow(v * v / (0.8 * k), 0.4),
               integral = std::sqrt(std::numbers::pi) * std::tgamma(0.4) / (2.5 * std::tgamma(0.9));
  const double contact = 2.0 * depth / v * integral;
  EXPECT_NEAR(run.velocity(flight.body, 10).x(), v, bound(run));
  EXPECT_NEAR(run.position(flight.body, 10).x(), v * (3.0 - 0.5 - contact), bound(run));
}

// V = |x|^3: continuous up to the second derivative of the force's slope, so nothing stops there.
TEST_P(Switches, SwitchOfCurvatureAloneIsPassedInStride) {
  const auto steps = [&](bool kinked) {
    Flight flight(0.0, 1.0);
    if (kinked)
      flight.in_potential([](auto x) { return pow(abs(x), 3); });
    else
      flight.in_potential([](auto x) { return x * x; });
    const auto run = simulate(flight.scene, options(10.0));
    for (std::size_t i = 0; i < run.size(); ++i) EXPECT_NEAR(run.energy(i), 0.5, bound(run));
    return run.statistics().steps;
  };
  EXPECT_LT(steps(true), 5 * steps(false));
}

// Down a slope of 45 degrees, g/2 each way, from 1 m to where the curve has its corner.
TEST_P(Switches, CornerOfACurveIsNamed) {
  for (const double t_end : {1.0, 2.0, 3.7}) {
    Scene<2> scene("vee");
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto bead = scene.add_particle({.mass = 1.0, .position = {1.0, 1.0}}, "bead");
    scene.add(OnCurve{bead, [](auto r) { return r.y() - abs(r.x()); }}, "vee");
    try {
      (void)simulate(scene, options(t_end));
      ADD_FAILURE() << "an impact has no equation";
    } catch (const IntegrationFailure& failure) {
      EXPECT_THAT(failure.what(), AllOf(HasSubstr("OnCurve \"vee\""), HasSubstr("gradient")));
      EXPECT_NEAR(failure.time(), std::sqrt(4.0 / g), 1e3 * tolerance());
    }
  }
}

// a = -+3 on the two sides of x + v = 0: v - 3 < 0 and v + 3 > 0 there, so both lead to it.
TEST_P(Switches, ChatteringSwitchIsNamed) {
  Flight flight(0.0, 1.0);
  flight.push(
      [](const auto&, const auto& x, const auto& v) {
        using S = std::remove_cvref_t<decltype(x)>;
        return S(x + v > 0.0 ? -3.0 : 3.0);
      },
      "relay");
  EXPECT_THAT(
      [&] { (void)simulate(flight.scene, options(3.0)); },
      ThrowsMessage<IntegrationFailure>(AllOf(HasSubstr("ForceLaw \"relay\""), HasSubstr("chatter"))));
}

// A curve of a line and a parabola, y = x^2/2 beyond 0: the bead leaves the line at 1 m/s; energy is kept.
TEST_P(Switches, ForceJumpsWithTheCurvatureOfACurve) {
  Scene<2> scene("run-out");
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto bead = scene.add_particle({.mass = 1.0, .position = {-1.0, 0.0}, .velocity = {1.0, 0.0}});
  const auto curve = scene.add(holonomic(points(bead), [](auto r) {
    const auto past = max(r.x(), 0.0);
    return r.y() - 0.5 * past * past;
  }));
  const auto run = simulate(scene, options(4.0));
  for (std::size_t i = 0; i < run.size(); ++i) EXPECT_NEAR(run.energy(i), 0.5, 10.0 * bound(run));
  EXPECT_NEAR(run.multiplier(curve, 2), g, 1e-9);  // on the line
  EXPECT_NEAR(run.position(bead, 2).x(), -1.0 + 0.8, bound(run));
}

// Together with a contact, an event and dense output: a ball falls through a band of half the gravity onto a
// floor.
TEST_P(Switches, SwitchesAreFoundBesideContactsAndEvents) {
  Scene<2> scene("fall");
  const auto ball = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}, .velocity = {0.1, 0.0}}, "ball");
  scene.add(potential(points(ball),
                      [](auto r) {
                        const auto y = r.y();
                        return g * (y < 0.4 ? 1.0 * y : y < 0.6 ? 0.4 + 0.5 * (y - 0.4) : y - 0.1);
                      }),
            "V");
  const auto floor_ = scene.add(unilateral(OnCurve{ball, Plane<2>{}}, {.restitution = 1.0}), "floor");
  auto o = options(2.0);
  o.dense = true;
  const auto run =
      simulate(scene, o,
               {{.name = "band", .function = [=](const auto& now) { return now.position(ball).y() - 0.6; }}});
  // v^2/2 = g 0.4 at 0.6, g 0.5 at 0.4, g 0.9 at the floor; down and up take the same time.
  const double v1 = std::sqrt(0.8 * g), v2 = std::sqrt(g), v3 = std::sqrt(1.8 * g);
  const double first = v1 / g, second = (v2 - v1) / (0.5 * g), third = (v3 - v2) / g;
  ASSERT_GE(run.events().size(), 3U);
  EXPECT_NEAR(run.events()[0].time, first, bound(run));
  EXPECT_NEAR(run.events()[1].time, first + second + third, bound(run));
  EXPECT_EQ(run.events()[1].kind, EventKind::struck);
  EXPECT_NEAR(run.impulse(floor_, 1), 2.0 * v3, 10.0 * bound(run));
  EXPECT_NEAR(run.events()[2].time, first + 2.0 * (second + third), bound(run));
  for (std::size_t i = 0; i < run.size(); ++i) EXPECT_NEAR(run.energy(i), 0.9 * g + 0.005, 30.0 * bound(run));
  const double t = first + 0.5 * second;
  EXPECT_NEAR(run.at({t}).position(ball, 0).y(), 0.6 - v1 * 0.5 * second - 0.25 * g * 0.25 * second * second,
              bound(run));
}

}  // namespace
}  // namespace dalembert::switches_test
