// Lagrangians in which a comparison switches: what jumps is an impulse, and refused by name; a kink, and a
// potential that jumps with the time, are followed exactly.
#include "failure_of.h"
#include "lagrangians.h"
#include <dalembert/tests/both_steppers.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace dalembert::lagrangian_jumps_test {
namespace {

using testing::HasSubstr;

class LagrangianJumps : public testing::TestWithParam<Stepper> {
 protected:
  [[nodiscard]] static Options options(double t_end = 3.0) {
    return {.t_end = t_end, .samples = 16, .tolerance = tolerance, .stepper = GetParam()};
  }
  /// That the run of L stops as an impulse, at this time: a root is found to some roundings of the time.
  template <int N>
  static void expect_impulse(const LagrangianSystem<N>& system, double time) {
    const auto failure = failure_of([&] { (void)simulate(system, options()); });
    ASSERT_TRUE(failure) << system.name();
    EXPECT_THAT(failure->what(), HasSubstr("Lagrangian \"" + system.name() + "\" jumps here"));
    EXPECT_NEAR(failure->time(), time, bound);
  }
  /// The same of one coordinate that has come from q = -1, unless it is told otherwise.
  template <class L>
  static void expect_impulse(const std::string& name, double speed, L lagrangian, double time) {
    expect_impulse(
        LagrangianSystem<1>({.position = Vec<1>(-1.0), .velocity = Vec<1>(speed)}, lagrangian, name), time);
  }
  /// The position over a run, at every sample.
  template <class L, class Position>
  static void expect_motion(Vec<1> q, Vec<1> v, L lagrangian, double t_end, Position exact) {
    const LagrangianSystem<1> system({.position = q, .velocity = v}, lagrangian);
    const auto motion = simulate(system, options(t_end));
    for (std::size_t i = 0; i < motion.size(); ++i)
      EXPECT_NEAR(motion.position(i)[0], exact(motion.times()[i]), bound) << motion.times()[i];
  }
};
INSTANTIATE_TEST_SUITE_P(Steppers, LagrangianJumps, both_steppers, stepper_name);

/// One number or another.
template <class S>
S either(bool one, double a, double b) {
  return S(one ? a : b);
}

TEST_P(LagrangianJumps, OfMomentaWithTheTimeAreRefused) {
  expect_impulse(
      "mass", 1.0,
      [](const auto& t, const auto&, const auto& v) {
        return 0.5 * either<std::decay_t<decltype(v[0])>>(t > 1.0, 4.0, 1.0) * v[0] * v[0];
      },
      1.0);
  expect_impulse(
      "vector potential", 1.0,
      [](const auto& t, const auto&, const auto& v) {
        return 0.5 * v[0] * v[0] + either<std::decay_t<decltype(v[0])>>(t > 1.0, 0.5, 0.0) * v[0];
      },
      1.0);
}

TEST_P(LagrangianJumps, WithThePositionAreRefused) {
  // q = -1 + 2t, and on a step that comes with c = 0.3 it is reached where -1 + 2t = 0.3 t.
  expect_impulse(
      "step", 2.0,
      [](const auto& q, const auto& v) {
        return 0.5 * v[0] * v[0] - either<std::decay_t<decltype(q[0])>>(q[0] > 0.0, 1.0, 0.0);
      },
      0.5);
  expect_impulse(
      "moving step", 2.0,
      [](const auto& t, const auto& q, const auto& v) {
        return 0.5 * v[0] * v[0] - either<std::decay_t<decltype(q[0])>>(q[0] > 0.3 * t, 1.0, 0.0);
      },
      1.0 / 1.7);
  expect_impulse(
      "mass", 1.0,
      [](const auto& q, const auto& v) {
        return 0.5 * either<std::decay_t<decltype(q[0])>>(q[0] > 0.0, 4.0, 1.0) * v[0] * v[0];
      },
      1.0);
}

TEST_P(LagrangianJumps, WithTheVelocityAreRefused) {
  // p = v + sign v would have to be continuous: the motion sticks at v = 0.
  expect_impulse(
      "sign", 1.0, [](const auto& q, const auto& v) { return 0.5 * v[0] * v[0] + abs(v[0]) - q[0]; }, 1.0);
}

/// Two coordinates; the inertia of y jumps where x passes 0.
LagrangianSystem<2> refracting() {
  return LagrangianSystem<2>(
      {.position = {-1.0, 0.0}, .velocity = {1.0, 1.0}},
      [](const auto& q, const auto& v) {
        const auto m = either<std::decay_t<decltype(q[0])>>(q[0] > 0.0, 4.0, 1.0);
        return 0.5 * (v[0] * v[0] + m * v[1] * v[1]);
      },
      "refracting");
}

TEST_P(LagrangianJumps, OfSeveralCoordinatesAreRefused) {
  expect_impulse(refracting(), 1.0);
  expect_impulse(reduced(refracting(), 1).system, 1.0);
}

TEST_P(LagrangianJumps, OfConstrainedCoordinatesAreRefused) {
  LagrangianSystem<2> line(
      {.position = {-1.0, -1.0}, .velocity = {1.0, 1.0}},
      [](const auto& q, const auto& v) {
        return 0.5 * v.squaredNorm() - either<std::decay_t<decltype(q[0])>>(q[1] > 0.0, 0.3, 0.0);
      },
      "on a line");
  line.constrain([](const auto& q) { return q[0] - q[1]; }, "line");
  expect_impulse(line, 1.0);
}

TEST_P(LagrangianJumps, DoNotConcernKinksOfPotentials) {
  // V = |q| from rest at 1: parabolas of quarter periods sqrt 2. A constant of any size changes nothing.
  const double quarter = std::numbers::sqrt2;
  const auto exact = [quarter](double t) {
    const double since = std::fmod(t + quarter, 4.0 * quarter);  // since it rose through 0
    const double u = std::fmod(since, 2.0 * quarter);
    return (since < 2.0 * quarter ? 1.0 : -1.0) * u * (quarter - 0.5 * u);
  };
  for (const double constant : {0.0, 1e12})
    expect_motion(
        Vec<1>(1.0), Vec<1>(0.0),
        [constant](const auto& q, const auto& v) { return 0.5 * v[0] * v[0] - abs(q[0]) + constant; }, 10.0,
        exact);
  // A spring on one side of q = 0: half a period of it, and back at the speed it came with.
  const double half = std::numbers::pi / 8.0;
  expect_motion(
      Vec<1>(-1.0), Vec<1>(1.0),
      [](const auto& q, const auto& v) {
        const auto in = max(q[0], 0.0);
        return 0.5 * v[0] * v[0] - 32.0 * in * in;
      },
      3.0,
      [half](double t) {
        return t < 1.0 ? t - 1.0 : t < 1.0 + half ? std::sin(8.0 * (t - 1.0)) / 8.0 : 1.0 + half - t;
      });
}

TEST_P(LagrangianJumps, DoNotConcernKinksOfInertias) {
  // (1 + max(q, 0)) v^2 is conserved: (1 + q)^(3/2) grows by 3/2 in unit time.
  expect_motion(
      Vec<1>(-1.0), Vec<1>(1.0),
      [](const auto& q, const auto& v) { return 0.5 * (1.0 + max(q[0], 0.0)) * v[0] * v[0]; }, 5.0,
      [](double t) { return t < 1.0 ? t - 1.0 : std::cbrt(std::pow(1.0 + 1.5 * (t - 1.0), 2.0)) - 1.0; });
}

TEST_P(LagrangianJumps, OfPotentialsWithTheTimeAreFollowed) {
  // Momenta do not jump where a spring is exchanged, of 1 and 4 from q = 1; nor where L becomes another by a
  // function of time.
  const auto exact = [](double t) {
    return t < 1.0
               ? std::cos(t)
               : std::cos(1.0) * std::cos(2.0 * (t - 1.0)) - 0.5 * std::sin(1.0) * std::sin(2.0 * (t - 1.0));
  };
  expect_motion(
      Vec<1>(1.0), Vec<1>(0.0),
      [](const auto& t, const auto& q, const auto& v) {
        const auto k = either<std::decay_t<decltype(q[0])>>(t > 1.0, 4.0, 1.0);
        return 0.5 * v[0] * v[0] - 0.5 * k * q[0] * q[0] +
               either<std::decay_t<decltype(q[0])>>(t > 2.0, 7.0, 0.0);
      },
      3.0, exact);
}

TEST_P(LagrangianJumps, OfRouthiansWithTheTimeAreFollowed) {
  // The momentum of y is conserved by the reduction: its rate is 1 and, where its inertia is 4, 1/4.
  const LagrangianSystem<2> system({.position = {1.0, 0.0}, .velocity = {0.0, 1.0}},
                                   [](const auto& t, const auto& q, const auto& v) {
                                     const auto m = either<std::decay_t<decltype(q[0])>>(t > 1.0, 4.0, 1.0);
                                     return 0.5 * (v[0] * v[0] - q[0] * q[0] + m * v[1] * v[1]);
                                   });
  const auto rest = reduced(system, 1);
  const auto motion = simulate(rest.system, options());
  EXPECT_NEAR(motion.position(15)[0], std::cos(3.0), bound);
  EXPECT_NEAR(rest.routhian->rate(3.0, motion.position(15), motion.velocity(15)), 0.25, bound);
}

TEST_P(LagrangianJumps, OfGeneralizedForcesAreFollowed) {
  LagrangianSystem<1> pushed({}, [](const auto&, const auto& v) { return 0.5 * v[0] * v[0]; });
  pushed.apply([](double t, const Vec<1>&, const Vec<1>&) { return Vec<1>(t > 1.0 ? 1.0 : 0.0); });
  const auto motion = simulate(pushed, options());
  EXPECT_NEAR(motion.position(15)[0], 2.0, bound);
}

}  // namespace
}  // namespace dalembert::lagrangian_jumps_test
