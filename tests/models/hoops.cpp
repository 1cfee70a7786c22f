#include "conserved.h"
#include <dalembert/models/hoop_about_diameter.h>
#include <dalembert/models/hoop_about_external_axis.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace dalembert::models::hoops_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr std::array times{0.1, 0.5, 1.3, 3.1};
constexpr double h = 2e-3;

TEST(HoopAboutExternalAxis, KeepsItsJacobiIntegralAndItsForceIsWhatNewtonDemands) {
  const HoopAboutExternalAxis hoop{.mass = 0.6, .radius = 1.2, .offset = 0.7, .spin = 2.5, .amplitude = 2.4};
  const Model<2> model = hoop.model();
  for (const double t : times) {
    const Stencil<2> bead(model, t, h, 0);
    const Vec<2> centre = hoop.offset * Vec<2>(std::cos(hoop.spin * t), std::sin(hoop.spin * t));
    const Vec<2> towards = (centre - bead.position()).normalized();
    expect_newton<2>(bead, hoop.mass, 0.0, hoop.reference(t).forces[0] * towards, model.force);
  }
  expect_constant(
      times, [&](double t) { return jacobi_integral(Stencil<2>(model, t, h, 0), hoop.mass, 0.0, hoop.spin); },
      model.energy);
}

TEST(HoopAboutExternalAxis, StartsWhereItsSceneDoesAndIsThereAgainAfterAPeriodAsSeenFromTheHoop) {
  const HoopAboutExternalAxis hoop;
  const BeadOnCurve built = hoop.scene();
  const std::span<const double> start = built.scene.initial_positions();
  const Vec<2> first = hoop.reference(0.0).positions[0];
  EXPECT_LT((first - Vec<2>(start[0], start[1])).norm(), 4 * epsilon);
  const Vec<2> later = hoop.reference(hoop.period()).positions[0];
  const double back = -hoop.spin * hoop.period(), c = std::cos(back), s = std::sin(back);
  EXPECT_LT((Vec<2>(c * later.x() - s * later.y(), s * later.x() + c * later.y()) - first).norm(),
            10 * epsilon * (1 - back));
}

TEST(HoopAboutExternalAxis, HoldsTheBeadOnItsCircleFarthestFromTheAxis) {
  // theta = 0 at rest relative to the hoop: m Omega^2 (R + l) (mex25).
  const BeadOnCurve built = HoopAboutExternalAxis{.amplitude = 0.0}.scene();
  const Trajectory<2> run = simulate(built.scene, {.t_end = 2.0, .samples = 9, .tolerance = 1e-10});
  // Steps of tolerance 1e-10 add up in the angle, whose cosine changes in second order.
  for (std::size_t i = 0; i < run.size(); ++i)
    EXPECT_NEAR(-run.multiplier(built.curve, i), 9.0 * 1.5,
                9.0 * 1.5 * 1e-10 * static_cast<double>(run.statistics().steps));
}

TEST(HoopAboutDiameter, KeepsItsJacobiIntegralAndItsForcesAreWhatNewtonDemands) {
  const HoopAboutDiameter hoop{.mass = 0.6, .radius = 1.2, .gravity = 9.81, .spin = 3.5, .angle = 1.9};
  const Model<3> model = hoop.model();
  for (const double t : times) {
    const Stencil<3> bead(model, t, h, 0);
    const Vec<3> sideways(-std::sin(hoop.spin * t), std::cos(hoop.spin * t), 0.0);
    const Observation<3> seen = hoop.reference(t);
    expect_newton<3>(bead, hoop.mass, hoop.gravity,
                     -seen.forces[0] * bead.position() / hoop.radius + seen.forces[1] * sideways,
                     model.force);
  }
  expect_constant(
      times,
      [&](double t) {
        return jacobi_integral(Stencil<3>(model, t, h, 0), hoop.mass, hoop.gravity, hoop.spin);
      },
      model.energy);
}

TEST(HoopAboutDiameter, BeadRestsAtTheBottomOrWhereTheTurningHoldsIt) {
  // Omega^2 = 2 g/R: cos phi0 = 1/2, force towards the centre m (R Omega^2 sin^2 + g cos) = 2 m g (any phi0:
  // m R Omega^2). Slower than Omega^2 = g/R: phi0 = 0 and m g.
  constexpr double tolerance = 1e-10;
  struct Case {
    double omega_squared, cosine, force;
  };
  for (const auto [omega_squared, cosine, force] : {Case{2.0, 0.5, 2.0}, Case{0.5, 1.0, 1.0}}) {
    HoopAboutDiameter hoop{.spin = std::sqrt(omega_squared * 9.81)};
    EXPECT_NEAR(std::cos(hoop.equilibrium()), cosine, 4 * epsilon);
    hoop.angle = hoop.equilibrium();
    const BeadOnHoop built = hoop.scene();
    const Trajectory<3> run = simulate(built.scene, {.t_end = 3.0, .samples = 13, .tolerance = tolerance});
    const double bound = tolerance * static_cast<double>(run.statistics().steps);
    for (std::size_t i = 0; i < run.size(); ++i) {
      EXPECT_NEAR(run.position(built.bead, i).z(), -cosine, bound);
      EXPECT_NEAR(-run.multiplier(built.sphere, i), force * 9.81, 10 * 9.81 * bound);
      EXPECT_NEAR(run.multiplier(built.plane, i), 0.0, 10 * 9.81 * bound);
    }
  }
}

}  // namespace
}  // namespace dalembert::models::hoops_test
