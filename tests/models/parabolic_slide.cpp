#include "dalembert/models/parabolic_slide.h"

#include "conserved.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace dalembert::models::parabolic_slide_test {
namespace {

constexpr std::array times{0.1, 0.4, 1.1, 2.7};

TEST(ParabolicSlide, KeepsItsEnergyAndItsNormalForceIsWhatNewtonDemands) {
  const ParabolicSlide slide{.mass = 0.7, .curvature = 0.8, .gravity = 9.81, .amplitude = 1.2};
  const Model<2> model = slide.model();
  for (const double t : times) {
    const Stencil<2> bead(model, t, 2e-3, 0);
    const Vec<2> normal = Vec<2>(-2 * slide.curvature * bead.position().x(), 1.0).normalized();
    expect_newton<2>(bead, slide.mass, slide.gravity, slide.reference(t).forces[0] * normal, model.force);
  }
  expect_constant(
      times, [&](double t) { return energy(Stencil<2>(model, t, 2e-3, 0), slide.mass, slide.gravity); },
      model.energy);
}

TEST(ParabolicSlide, IsBackAtItsStartAfterAPeriod) {
  const ParabolicSlide slide{.curvature = 1.5, .amplitude = 2.0};
  // At rest, a rounding of the period moves the bead in second order only: what a reference is good for,
  // relative.
  const Vec<2> back = slide.reference(slide.period()).positions[0];
  EXPECT_NEAR(back.x(), slide.amplitude, 1e-13 * slide.amplitude);
  EXPECT_NEAR(slide.reference(slide.period() / 2).positions[0].x(), -slide.amplitude,
              1e-13 * slide.amplitude);
}

TEST(ParabolicSlide, CarriesTheWeightOfABeadAtRestAtTheBottom) {
  const ParabolicSlide slide{.mass = 2.0, .amplitude = 0.0};
  const BeadOnCurve built = slide.scene();
  const Trajectory<2> run = simulate(built.scene, {.t_end = 5.0, .samples = 6});
  for (std::size_t i = 0; i < run.size(); ++i) {
    EXPECT_EQ(run.position(built.bead, i), (Vec<2>(0.0, 0.0)));
    // One rounding of m g and one of the division by the mass.
    EXPECT_NEAR(run.multiplier(built.curve, i), 2.0 * 9.81,
                2 * std::numeric_limits<double>::epsilon() * 19.62);
  }
}

TEST(ParabolicSlide, ForceAtRestOnTheSlopeIsTheNormalPartOfTheWeight) {
  // At x = 1, A = 1/2 the slope is 45 degrees: m g cos 45 = m g/sqrt 2. The same from the library at the
  // start.
  const ParabolicSlide slide{.curvature = 0.5, .amplitude = 1.0};
  const double expected = 9.81 / std::numbers::sqrt2;
  EXPECT_NEAR(slide.reference(0.0).forces[0], expected,
              4 * std::numeric_limits<double>::epsilon() * expected);
  const BeadOnCurve built = slide.scene();
  const Trajectory<2> run = simulate(built.scene, {.t_end = 1.0, .samples = 2});
  EXPECT_NEAR(run.multiplier(built.curve, 0), expected,
              10 * std::numeric_limits<double>::epsilon() * expected);
}

}  // namespace
}  // namespace dalembert::models::parabolic_slide_test
