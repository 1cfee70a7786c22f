#include "../both_steppers.h"
#include "readings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace dalembert::in_line_test {
namespace {

class TwoLinkages : public testing::TestWithParam<Stepper> {};
INSTANTIATE_TEST_SUITE_P(Steppers, TwoLinkages, both_steppers, stepper_name);

/// Parallelograms of unit particles turn uniformly: their rods pull with 1, nothing pulls or pushes the
/// crossbars. The second is in line a little before the first. Where one has forces without bound, those of
/// the other must not be judged by them: what can be read is right to the root of the tolerance, as promised.
TEST_P(TwoLinkages, GiveNoUndeterminedForceWhenBothAreInLine) {
  constexpr double tolerance = 1e-6, phase = 0.5;
  for (const double before : {1e-5, 1e-4, 1e-3}) {
    Scene<2> scene;
    std::vector<Constraint<1>> crossbars;
    for (const double angle : {phase, phase + before}) {
      const Vec<2> arm(std::cos(angle), std::sin(angle)), velocity(-arm.y(), arm.x());
      const Vec<2> left(10.0 * static_cast<double>(crossbars.size()), 0.0), right = left + Vec<2>::UnitX();
      const auto p = scene.add_particle({.mass = 1.0, .position = left + arm, .velocity = velocity});
      const auto q = scene.add_particle({.mass = 1.0, .position = right + arm, .velocity = velocity});
      scene.add(Distance{Fixed<2>{left}, p, 1.0});
      scene.add(Distance{Fixed<2>{right}, q, 1.0});
      crossbars.push_back(scene.add(Distance{p, q, 1.0}));
    }
    std::vector<double> times;
    for (const double in_line : {std::numbers::pi - phase, std::numbers::pi - phase - before}) {
      for (int k = 4; k <= 40; ++k) {
        for (const double side : {-1.0, 1.0}) times.push_back(in_line + side * std::pow(10.0, -0.25 * k));
      }
    }
    std::ranges::sort(times);
    const auto run =
        simulate(scene, {.t_end = 3.0, .times = times, .tolerance = tolerance, .stepper = GetParam()});
    int read = 0;
    for (const Sample<2>& now : run) {
      for (const auto& crossbar : crossbars) {
        if (!now.is_determined(crossbar)) continue;
        ++read;
        EXPECT_LT(std::abs(now.multiplier(crossbar)), std::sqrt(tolerance)) << now.time();
      }
    }
    EXPECT_GT(read, 20);  // those farthest away
  }
}

}  // namespace
}  // namespace dalembert::in_line_test
