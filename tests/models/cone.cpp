#include "dalembert/models/cone.h"

#include "newton.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace dalembert::models::cone_test {
namespace {

TEST(ConeSlide, EndsWhereAnIndependentComputationSays) {
  // BENCHMARKS B8, 16 digits: two units in the last of them, and 1e-13 for the reference itself.
  const Observation<3> end = ConeSlide{}.reference(10.0);
  EXPECT_LT((end.positions[0] - Vec<3>(-0.2372569607975887, 0.5041174860496391, 0.9650263807605208)).norm(),
            1e-13);
  EXPECT_NEAR(end.forces[0], 36.34220578374362, 1e-13 * 36.4 + 1e-14);
}

TEST(ConeSlide, KeepsItsEnergyAndItsNormalForceIsWhatNewtonDemands) {
  const ConeSlide cone{
      .mass = 0.4, .half_angle = 0.6, .gravity = 9.81, .start_radius = 1.5, .speed_ratio = 0.7};
  const Model<3> model = cone.model();
  const double sine = std::sin(cone.half_angle), cosine = std::cos(cone.half_angle);
  double first_energy = 0.0, first_error = 0.0;
  for (const double t : {0.1, 0.5, 0.9, 2.3, 5.0}) {
    const Stencil<3> particle(model, t, 2e-3, 0);
    const Vec<3> r = particle.position();
    const double rho = std::hypot(r.x(), r.y());
    const Vec<3> inward(-cosine * r.x() / rho, -cosine * r.y() / rho, sine);
    const auto demanded = force_by_newton(particle, cone.mass, cone.gravity);
    EXPECT_LT((cone.reference(t).forces[0] * inward - demanded.value).norm(), demanded.error) << t;
    EXPECT_LT(demanded.error, 1e-6 * model.force);

    const auto total = energy(particle, cone.mass, cone.gravity);
    if (first_error == 0.0) {
      first_energy = total.value;
      first_error = total.error;
    }
    EXPECT_LE(std::abs(total.value - first_energy), total.error + first_error) << t;
    EXPECT_LT(total.error, 1e-6 * model.energy);
  }
}

TEST(ConeSlide, GoesRoundInACircleAtTheSpeedThatTheNotesGive) {
  // phi'^2 = g cot(a)/r (mex133): speed^2 = g r cot(a), normal force m g/sin(a).
  const double half_angle = 0.5;
  const ConeSlide cone{.half_angle = half_angle, .speed_ratio = std::sqrt(1 / std::tan(half_angle))};
  for (const auto& seen : cone.reference(std::array{0.0, 1.0, 10.0})) {
    const Vec<3>& r = seen.positions[0];
    EXPECT_NEAR(std::hypot(r.x(), r.y()), 1.0, 1e-13);  // what references are good for
    EXPECT_NEAR(seen.forces[0], 9.81 / std::sin(half_angle), 1e-13 * 9.81 / std::sin(half_angle));
  }
}

}  // namespace
}  // namespace dalembert::models::cone_test
