#include "../both_steppers.h"
#include <dalembert/dalembert.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dalembert::nearly_singular_test {
namespace {

class NearlySingular : public testing::TestWithParam<Stepper> {};
INSTANTIATE_TEST_SUITE_P(Steppers, NearlySingular, both_steppers, stepper_name);

/// A crank of length 1 and a rod that is a little longer. With the crank upright the slider stands at
/// x = sqrt(2 longer), and at -x on the other branch, on which it would go on straight ahead.
struct Crank {
  double longer;
  Scene<2> scene{"crank"};
  Particle<2> pin, slider;

  explicit Crank(double by, double angle = 0.6, double rate = 8.0) : longer(by) {
    const double l = 1.0 + longer, root = std::sqrt(l * l - std::pow(std::sin(angle), 2));
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    pin = scene.add_particle({.mass = 1.0,
                              .position = {std::cos(angle), std::sin(angle)},
                              .velocity = {-rate * std::sin(angle), rate * std::cos(angle)}},
                             "pin");
    slider = scene.add_particle({.mass = 0.7,
                                 .position = {std::cos(angle) + root, 0.0},
                                 .velocity = {-rate * std::sin(angle) * (1.0 + std::cos(angle) / root), 0.0}},
                                "slider");
    scene.add(Distance{Fixed<2>{}, pin, 1.0}, "crank");
    scene.add(Distance{pin, slider, l}, "rod");
    scene.add(OnCurve{slider, Plane<2>{}}, "guide");
  }

  /// How far the slider is from where the pin has it on the branch of the start.
  [[nodiscard]] double off_its_branch(const Trajectory<2>& run) const {
    double worst = 0.0;
    for (std::size_t i = 0; i < run.size(); ++i) {
      const Vec<2> p = run.position(pin, i);
      const double l = 1.0 + longer, root = std::sqrt(std::max(0.0, l * l - p.y() * p.y()));
      worst = std::max(worst, std::abs(run.position(slider, i).x() - p.x() - root));
    }
    return worst;
  }
};

/// Projection leaves a rounding of the guide and the rod, which their angle, 5e-4, divides twice.
TEST_P(NearlySingular, ASliderTurnsOnItsOwnBranchAtEveryTolerance) {
  constexpr double round_off = 1e-15 / (5e-4 * 5e-4);
  const Crank crank(1e-7);
  for (const double tolerance : {1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11}) {
    const auto run =
        simulate(crank.scene, {.t_end = 0.25, .samples = 126, .tolerance = tolerance, .stepper = GetParam()});
    EXPECT_LT(crank.off_its_branch(run), 10.0 * tolerance + round_off) << tolerance;
    EXPECT_EQ(run.statistics().singular_positions, 0) << tolerance;
    EXPECT_LT(run.statistics().steps, 3000) << tolerance;
  }
}

/// Energy: the crank turns through the place where the slider is as fast as it, unless steps jumped there.
TEST_P(NearlySingular, ASliderKeepsItsEnergyWhereItTurns) {
  for (const double longer : {1e-3, 1e-5, 1e-7}) {
    const Crank crank(longer);
    const auto run =
        simulate(crank.scene, {.t_end = 0.4, .samples = 101, .tolerance = 1e-8, .stepper = GetParam()});
    for (std::size_t i = 0; i < run.size(); ++i)
      EXPECT_NEAR(run.energy(i), run.energy(0), 1e-4 * std::abs(run.energy(0))) << longer << ' ' << i;
    EXPECT_LT(crank.off_its_branch(run), 1e-7) << longer;
  }
}

/// The branches are 2 sqrt(2e-11) = 9e-6 apart: less than steps at 1e-4 are held to.
TEST_P(NearlySingular, BranchesThatTheToleranceDoesNotTellApartAreRefused) {
  const Crank crank(1e-11);
  try {
    (void)simulate(crank.scene, {.t_end = 0.25, .tolerance = 1e-4, .stepper = GetParam()});
    FAIL() << "ran";
  } catch (const IntegrationFailure& failure) {
    EXPECT_THAT(failure.what(), testing::HasSubstr("two branches of the motion"));
    EXPECT_THAT(failure.what(), testing::HasSubstr("ask for a tolerance smaller"));
  }
}

/// Of equal lengths the branches cross, and the slider goes straight on: x = 2 cos of the crank's angle.
TEST_P(NearlySingular, SliderGoesStraightOnWhereBranchesCross) {
  const Crank crank(0.0);
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const auto run =
        simulate(crank.scene, {.t_end = 0.25, .samples = 126, .tolerance = tolerance, .stepper = GetParam()});
    EXPECT_EQ(run.statistics().singular_positions, 1) << tolerance;
    for (std::size_t i = 0; i < run.size(); ++i)
      EXPECT_NEAR(run.position(crank.slider, i).x(), 2.0 * run.position(crank.pin, i).x(), 100.0 * tolerance);
  }
}

}  // namespace
}  // namespace dalembert::nearly_singular_test
