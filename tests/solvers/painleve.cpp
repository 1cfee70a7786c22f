#include "../both_steppers.h"
#include <dalembert/dalembert.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace dalembert::painleve_test {
namespace {

class Painleve : public testing::TestWithParam<Stepper> {};
INSTANTIATE_TEST_SUITE_P(Steppers, Painleve, both_steppers, stepper_name);

/// A rod of length 2 l slides on its foot, at an angle phi to the floor. With its moment of inertia
/// m l^2/3 the normal force has the denominator 1 + 3 cos phi (cos phi - mu sin phi): where
/// that vanishes, at mu = 1.5 from cos^2 + 1/3 = 1.5 sin cos on, the law has no solution beyond. On the way
/// there friction only takes energy.
TEST_P(Painleve, ARodThatSlidesToTheSingularityOfItsNormalForceStopsThereByName) {
  const double l = 0.5, mu = 1.5, angle = 0.5, rate = 4.0, slip = -8.0;
  Scene<2> scene("rod");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto rod =
      add_body(scene,
               BodyState<2>{.mass = 1.0,
                            .inertia = l * l / 3.0,
                            .centre = {l * std::cos(angle), l * std::sin(angle)},
                            .angle = angle,
                            .velocity = {slip - rate * l * std::sin(angle), rate * l * std::cos(angle)},
                            .angular_velocity = rate},
               "rod");
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

}  // namespace
}  // namespace dalembert::painleve_test
