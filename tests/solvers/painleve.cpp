#include "../both_steppers.h"
#include <dalembert/dalembert.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace dalembert::painleve_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class Painleve : public testing::TestWithParam<Stepper> {};
INSTANTIATE_TEST_SUITE_P(Steppers, Painleve, both_steppers, stepper_name);

/// A rod of mass 1 and length 2 l whose foot, at the origin, slips, while it turns about it.
RigidBody<2> add_rod(Scene<2>& scene, double l, double angle, double rate, double slip) {
  return add_body(scene,
                  BodyState<2>{.mass = 1.0,
                               .inertia = l * l / 3.0,
                               .centre = {l * std::cos(angle), l * std::sin(angle)},
                               .angle = angle,
                               .velocity = {slip - rate * l * std::sin(angle), rate * l * std::cos(angle)},
                               .angular_velocity = rate},
                  "rod");
}

/// A rod of length 2 l slides on its foot, at an angle phi to the floor. With its moment of inertia
/// m l^2/3 the normal force has the denominator 1 + 3 cos phi (cos phi - mu sin phi): where
/// that vanishes, at mu = 1.5 from cos^2 + 1/3 = 1.5 sin cos on, the law has no solution beyond. On the way
/// there friction only takes energy.
TEST_P(Painleve, ARodThatSlidesToTheSingularityOfItsNormalForceStopsThereByName) {
  const double l = 0.5, mu = 1.5, angle = 0.5, rate = 4.0, slip = -8.0;
  Scene<2> scene("rod");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto rod = add_rod(scene, l, angle, rate, slip);
  const auto foot = rod.point({-l, 0.0});
  const auto floor = scene.add(OnCurve{foot, Plane<2>{}}, "floor");
  scene.add(friction_law(floor, points(foot),
                         [mu](auto N, auto, auto v) { return (-mu * N * v.normalized()).eval(); }),
            "rub");
  try {
    (void)simulate(scene, {.t_end = 0.6, .samples = 61, .tolerance = 1e-6, .stepper = GetParam()});
    FAIL() << "there is no motion beyond";
  } catch (const IntegrationFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("Painleve"), std::string::npos) << failure.what();
    EXPECT_NE(std::string(failure.what()).find("\"rub\""), std::string::npos) << failure.what();
    const auto until = failure.trajectory<2>();
    // Steps are a part of the time left: some for each of its fifty halvings down to round-off.
    EXPECT_LT(until.statistics().steps, 500);
    for (std::size_t i = 1; i < until.size(); ++i) EXPECT_LT(until.energy(i), until.energy(i - 1));
    // The angle at which the denominator vanishes is not passed: its sign is that of the run's last sample.
    const double phi = dalembert::angle(until.sample(until.size() - 1), rod);
    EXPECT_GT(1.0 + 3.0 * std::cos(phi) * (std::cos(phi) - mu * std::sin(phi)), 0.0);
  }
}

/// A rod of length 2 l and mass 1 on a wire, which holds its foot both ways and is rough. At an angle phi,
/// with the rate w, it presses by N, for which with s the sign of the slip
///
///   A N = b,   A = 1 + 3 cos phi (cos phi + s mu sin phi sign N),   b = g - l w^2 sin phi
struct RodOnAWire {
  static constexpr double l = 0.5, g = 9.81;
  double mu;
  Scene<2> scene{"rod"};
  RigidBody<2> rod;
  BodyPoint<2> foot;
  Constraint<1> wire;

  RodOnAWire(double friction, double angle, double rate, double slip) : mu(friction) {
    scene.add(UniformGravity<2>{{0.0, -g}});
    rod = add_rod(scene, l, angle, rate, slip);
    foot = rod.point({-l, 0.0});
    wire = scene.add(OnCurve{foot, Plane<2>{}}, "wire");
    scene.add(coulomb(wire, Slip{foot, Plane<2>{}}, mu), "rub");
  }
  [[nodiscard]] double A(const Sample<2>& at, double sign_of_N) const {
    const double phi = angle(at, rod), s = at.velocity(foot).x() < 0.0 ? -1.0 : 1.0;
    return 1.0 + 3.0 * std::cos(phi) * (std::cos(phi) + s * mu * std::sin(phi) * sign_of_N);
  }
  [[nodiscard]] double b(const Sample<2>& at) const {
    return g - l * std::pow(angular_velocity(at, rod), 2) * std::sin(angle(at, rod));
  }
};

TEST_P(Painleve, ARodWhoseLawHasTwoMotionsAtItsStartIsRefusedByName) {
  // phi = 1, w = 0, mu = 2.5, s = 1: b = 9.81, A = 5.28567 for N > 0, -1.53410 for N < 0.
  const RodOnAWire scene(2.5, 1.0, 0.0, 3.0);
  EXPECT_THAT([&] { (void)simulate(scene.scene, {.t_end = 0.01, .stepper = GetParam()}); },
              ThrowsMessage<Error>(AllOf(HasSubstr("\"rub\": more than one motion"), HasSubstr("1.8559"),
                                         HasSubstr("-6.3946"))));
}

TEST_P(Painleve, ARodThatSlidesIntoARegionOfTwoMotionsKeepsItsOwn) {
  // At t = 0.091 N falls through 0 with b, where A > 0 for both signs, and soon A < 0 for N > 0. Of the two
  // solutions from there on the run keeps N < 0, whatever is listed on the way. One that begins there is
  // refused.
  constexpr double tolerance = 1e-8;
  const RodOnAWire scene(1.5, 0.5, 4.0, -8.0);
  const Event<2> listed{.name = "listed", .function = [](const Sample<2>& at) { return at.time() - 0.13; }};
  const auto run = simulate(
      scene.scene, {.t_end = 0.15, .samples = 16, .tolerance = tolerance, .stepper = GetParam()}, {listed});
  EXPECT_EQ(run.size(), 16U);
  for (std::size_t i = 0; i < run.size(); ++i) {
    const auto at = run.sample(i);
    const double N = run.multiplier(scene.wire, i), sign = i <= 9 ? 1.0 : -1.0;
    EXPECT_GT(sign * N, 0.0);
    // Of the run's own state, as exactly as velocities satisfy the wire.
    EXPECT_NEAR(scene.A(at, sign) * N, scene.b(at), 100.0 * tolerance * scene.g) << i;
  }
  const auto there = run.sample(12);
  EXPECT_LT(scene.A(there, 1.0), 0.0);
  EXPECT_LT(scene.b(there), 0.0);
  const RodOnAWire again(1.5, angle(there, scene.rod), angular_velocity(there, scene.rod),
                         there.velocity(scene.foot).x());
  EXPECT_THAT([&] { (void)simulate(again.scene, {.t_end = 0.01, .stepper = GetParam()}); },
              ThrowsMessage<Error>(HasSubstr("\"rub\"")));
}

}  // namespace
}  // namespace dalembert::painleve_test
