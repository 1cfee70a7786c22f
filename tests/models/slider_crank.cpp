#include "dalembert/models/slider_crank.h"

#include <dalembert/tests/models/newton.h>

#include <gtest/gtest.h>

#include <cmath>

namespace dalembert::models::slider_crank_test {
namespace {

// SUNDIALS' example idasSlCrank at rtol = atol = 1e-6 prints five digits; the tolerance may have moved the
// last.
constexpr double q10 = 1.2757, x10 = 1.0236, p10 = -0.49881;

TEST(SliderCrankReference, IsThePublishedEnd) {
  const SliderCrank crank;
  const Observation<2> end = crank.reference(10.0);
  EXPECT_NEAR(std::atan2(end.positions[0].y(), end.positions[0].x()), q10, 1e-4);
  EXPECT_NEAR(end.positions[1].x(), x10, 1e-4);
  EXPECT_NEAR(std::asin(-end.positions[0].y()), p10, 1e-4);
}

// m2 x'' = R_x + drive + spring and damper, whose middles lie at equal heights: their force is along x.
TEST(SliderCrankReference, PinForceIsMassTimesAccelerationLessTheOtherForces) {
  const SliderCrank s;
  for (const double t : {1.0, 4.0, 7.7}) {
    const Stencil<2> pin(s.model(), t, 1e-2, 0), slider(s.model(), t, 1e-2, 1);
    const auto v_pin = pin.velocity(), v = slider.velocity(), a = slider.acceleration();
    // Middle of the rod: half way from the slider to the pin; middle of the crank: half the pin.
    const double length = 0.5 * slider.position().x(), rate = 0.5 * v.value.x();
    const double tension = s.stiffness * (length - s.relaxed_length) + s.damping * rate;
    const double R_x = s.slider_mass * a.value.x() - s.drive + tension;
    EXPECT_NEAR(R_x, s.reference(t).forces[0], a.error + v.error + v_pin.error);
  }
}

TEST(SliderCrank, EndsAtThePublishedValues) {
  const SliderCrank s;
  const SliderCrankScene built = s.scene();
  const auto run = simulate(built.scene, {.t_end = 10.0, .tolerance = 1e-8});
  const Sample<2> end = run.sample(run.size() - 1);
  const Vec<2> crank = built.crank.axes(end).col(0), rod = built.rod.axes(end).col(0);
  EXPECT_EQ(run.statistics().degrees_of_freedom, 1);
  EXPECT_NEAR(std::atan2(crank.y(), crank.x()), q10, 1e-4);
  EXPECT_NEAR(end.position(built.rod.centre()).x(), x10, 1e-4);
  EXPECT_NEAR(std::atan2(rod.y(), rod.x()), p10, 1e-4);
}

}  // namespace
}  // namespace dalembert::models::slider_crank_test
