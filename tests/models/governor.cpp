#include "dalembert/models/governor.h"

#include "conserved.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace dalembert::models::governor_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr std::array times{0.1, 0.5, 1.3, 3.1};
constexpr double h = 1e-3;
constexpr Governor governor{.mass = 0.8, .sleeve_mass = 1.1, .length = 1.2, .spin = 6.0, .angle = 0.9};

TEST(Governor, RodsAndDrivesDoWhatNewtonDemandsOfMassesAndSleeve) {
  const Model<3> model = governor.model();
  for (const double t : times) {
    const std::array points{Stencil<3>(model, t, h, 0), Stencil<3>(model, t, h, 1)};
    const Stencil<3> sleeve(model, t, h, 2);
    const Observation<3> seen = governor.reference(t);
    Vec<3> on_sleeve = Vec<3>::Zero();
    for (const std::size_t i : {0U, 1U}) {
      const Vec<3> r = points[i].position(), down = (sleeve.position() - r) / governor.length;
      const Vec<3> ahead = Vec<3>(-r.y(), r.x(), 0.0).normalized();
      expect_newton<3>(
          points[i], governor.mass, governor.gravity,
          -seen.forces[i] * r / governor.length + seen.forces[2 + i] * down + seen.forces[4 + i] * ahead,
          model.force);
      on_sleeve -= seen.forces[2 + i] * down;
    }
    expect_newton<3>(sleeve, governor.sleeve_mass, governor.gravity, on_sleeve, model.force);
  }
}

TEST(Governor, KeepsItsJacobiIntegral) {
  const Model<3> model = governor.model();
  expect_constant(
      times,
      [&](double t) {
        const auto one = jacobi_integral(Stencil<3>(model, t, h, 0), 0.8, governor.gravity, governor.spin);
        const auto two = jacobi_integral(Stencil<3>(model, t, h, 1), 0.8, governor.gravity, governor.spin);
        const auto sleeve = energy(Stencil<3>(model, t, h, 2), 1.1, governor.gravity);
        return Bounded<double>{one.value + two.value + sleeve.value, one.error + two.error + sleeve.error};
      },
      model.energy);
}

TEST(Governor, RodsCarryWhatTheNotesSayAtItsWorkingAngle) {
  // cos theta0 = (m1 + m2) g/(m1 L Omega^2); lower rods m2 g/(2 cos theta0), upper (m1 + m2/2) g/cos theta0,
  // and the drives nothing. Steps of tolerance 1e-10 add up; the forces change with the angle by at most ten
  // weights.
  Governor still = governor;
  still.angle = still.equilibrium();
  const double cosine = (0.8 + 1.1) * 9.81 / (0.8 * 1.2 * 36.0);
  EXPECT_NEAR(std::cos(still.angle), cosine, 4 * epsilon);
  const auto [scene, parts] = still.scene();
  const Trajectory<3> run = simulate(scene, {.t_end = 3.0, .samples = 13, .tolerance = 1e-10});
  const double bound = 1e-10 * static_cast<double>(run.statistics().steps);
  for (std::size_t i = 0; i < run.size(); ++i) {
    EXPECT_NEAR(run.position(parts.sleeve, i).z(), -2 * 1.2 * cosine, bound);
    for (const std::size_t k : {0U, 1U}) {
      EXPECT_NEAR(-run.multiplier(parts.lower[k], i), 1.1 * 9.81 / (2 * cosine), 10 * 9.81 * bound);
      EXPECT_NEAR(-run.multiplier(parts.upper[k], i), (0.8 + 0.55) * 9.81 / cosine, 10 * 9.81 * bound);
      EXPECT_NEAR(run.multiplier(parts.drives[k], i), 0.0, 10 * 9.81 * bound);
    }
  }
}

TEST(Governor, HangsDownBelowTheSpeedThatLiftsIt) {
  EXPECT_EQ((Governor{.spin = 5.0}.equilibrium()), 0.0);  // 3 g/(1 * 25) > 1
  EXPECT_GT((Governor{.spin = 6.0}.equilibrium()), 0.0);  // 3 g/(1 * 36) < 1
}

TEST(Governor, AxisNeverPushesTheSleeveSidewaysBecauseTheTwoSidesAreAlike) {
  const auto [scene, parts] = governor.scene();
  const Trajectory<3> run = simulate(scene, {.t_end = 3.0, .samples = 31, .tolerance = 1e-8});
  const double bound = 10 * 9.81 * 1e-8 * static_cast<double>(run.statistics().steps);
  for (std::size_t i = 0; i < run.size(); ++i)
    for (const Constraint<1> side : parts.axis) EXPECT_NEAR(run.multiplier(side, i), 0.0, bound);
}

}  // namespace
}  // namespace dalembert::models::governor_test
