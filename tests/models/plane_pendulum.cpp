#include "dalembert/models/plane_pendulum.h"

#include "hanging.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace dalembert::models::plane_pendulum_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// g = 9.81 is rounded to a double, which shifts the phase omega0 t by up to omega0 t epsilon/4; a bob that
/// moves at no more than sqrt(2 g l) = 4.43 m/s is then off by 4.43 t epsilon/4. Results are
/// rounded to epsilon/2.
double published_bound(double t) { return 4.43 * t * epsilon / 4 + epsilon; }

TEST(PlanePendulum, EndsWhereIftommBenchmarkA01SaysAfter10And1000Seconds) {
  const PlanePendulum pendulum;
  const Vec<2> at_10 = pendulum.reference(10.0).positions[0];
  EXPECT_LT((at_10 - Vec<2>(0.27508746257611686, -0.961419205099125064)).norm(), published_bound(10.0));
  const Vec<2> at_1000 = pendulum.reference(1000.0).positions[0];
  EXPECT_LT((at_1000 - Vec<2>(-0.683230188552314855, -0.730203060422762328)).norm(), published_bound(1000.0));
}

TEST(PlanePendulum, PeriodGrowsWithAmplitudeAsPublished) {
  struct Published {
    double degrees, ratio;
  };
  for (const auto [degrees, ratio] :
       {Published{10, 1.0019071881432166}, Published{30, 1.017408797595956},
        Published{60, 1.0731820071493644}, Published{90, 1.1803405990160962},
        Published{150, 1.762203729503756}, Published{179, 3.9010651603890857}}) {
    const double amplitude = degrees * std::numbers::pi / 180;
    const PlanePendulum pendulum{.amplitude = amplitude};
    const double small = 2 * std::numbers::pi * std::sqrt(pendulum.length / pendulum.gravity);
    // d ln K / d ln amplitude is at most 30 (at 179 deg), so two roundings of the amplitude move the ratio by
    // up to 30 epsilon; the quotient adds two more.
    EXPECT_NEAR(pendulum.period() / small, ratio, 32 * epsilon * ratio) << degrees << " deg";
  }
}

TEST(PlanePendulum, IsBackAtItsStartAfterAPeriodAndOppositeAfterHalf) {
  const PlanePendulum pendulum{.amplitude = 2.0};
  const Observation<2> start = pendulum.reference(0.0);
  const Observation<2> half = pendulum.reference(pendulum.period() / 2);
  const Observation<2> full = pendulum.reference(pendulum.period());
  // At rest, a rounding of the period moves the bob in second order only.
  EXPECT_LT((full.positions[0] - start.positions[0]).norm(), 4 * epsilon);
  EXPECT_LT((half.positions[0] - Vec<2>(-start.positions[0].x(), start.positions[0].y())).norm(),
            4 * epsilon);
}

TEST(PlanePendulum, KeepsItsEnergyAndItsTensionIsWhatNewtonDemands) {
  const PlanePendulum pendulum{.mass = 0.7, .length = 1.3, .gravity = 9.81, .amplitude = 2.5};
  expect_newton_and_energy(pendulum.model(), {0.7}, 9.81, std::array{0.1, 0.5, 1.1, 2.0, 7.3}, 5e-3, 1e-7);
}

TEST(PlanePendulum, TensionIsThriceTheWeightAtTheBottomAndNoneAtRestOnTheHorizontal) {
  const PlanePendulum pendulum;
  const double weight = pendulum.mass * pendulum.gravity;
  EXPECT_NEAR(pendulum.reference(0.0).forces[0], 0.0, 4 * epsilon * weight);
  EXPECT_NEAR(pendulum.reference(pendulum.period() / 4).forces[0], 3 * weight, 12 * epsilon * weight);
}

}  // namespace
}  // namespace dalembert::models::plane_pendulum_test
