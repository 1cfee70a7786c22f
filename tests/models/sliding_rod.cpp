#include "dalembert/models/sliding_rod.h"

#include "conserved.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace dalembert::models::sliding_rod_test {
namespace {

constexpr std::array times{0.1, 0.3, 0.7, 1.6};
constexpr double h = 1e-3;

double cross(const Vec<2>& a, const Vec<2>& b) { return a.x() * b.y() - a.y() * b.x(); }

TEST(SlidingRod, TrackForceIsWhatNewtonDemandsOfTheCentreAndOfTheTurning) {
  const SlidingRod rod{.mass = 0.8, .length = 1.4, .angle = 0.9, .drift = -0.4};
  const Model<2> model = rod.model();
  const double inertia = rod.mass * rod.length * rod.length / 12.0;
  for (const double t : times) {
    const Stencil<2> centre(model, t, h, 0), foot(model, t, h, 1);
    const double N = rod.reference(t).forces[0];
    expect_newton<2>(centre, rod.mass, rod.gravity, Vec<2>(0.0, N), model.force);
    // I (angular acceleration) = torque of N about the centre; arm x arm'' = arm^2 (angular acceleration).
    const Vec<2> arm = foot.position() - centre.position();
    const auto a = centre.acceleration(), b = foot.acceleration();
    const double arms_error = arm.norm() * (a.error + b.error) * inertia / arm.squaredNorm();
    EXPECT_NEAR(inertia * cross(arm, b.value - a.value) / arm.squaredNorm(), arm.x() * N, arms_error) << t;
    EXPECT_LT(arms_error, 1e-6 * model.force * rod.length);
  }
}

TEST(SlidingRod, KeepsItsEnergyAndItsFootOnTheTrack) {
  const SlidingRod rod{.mass = 0.8, .length = 1.4, .angle = 0.9, .drift = -0.4};
  const Model<2> model = rod.model();
  const double turning = rod.mass / 6.0;  // I/2 over the square of the arm, l/2
  expect_constant(
      times,
      [&](double t) {
        const Stencil<2> centre(model, t, h, 0), foot(model, t, h, 1);
        EXPECT_EQ(foot.position().y(), 0.0);
        const auto own = energy(centre, rod.mass, rod.gravity);
        const auto a = centre.velocity(), b = foot.velocity();
        const double speed = (b.value - a.value).norm(), error = a.error + b.error;
        return Bounded<double>{own.value + turning * speed * speed,
                               own.error + 2 * turning * error * (speed + error)};
      },
      model.energy);
}

TEST(SlidingRod, WeighsAQuarterLevelAtRest) {
  // theta = 90 degrees: theta'' = 3 g/(2 l) as about a fixed end, the centre falls with 3 g/4, the track
  // bears m g/4.
  const SlidingRod rod{.angle = std::numbers::pi / 2};
  const double bound = 20 * std::numeric_limits<double>::epsilon() * 9.81;  // some twenty operations
  EXPECT_NEAR(rod.reference(0.0).forces[0], 9.81 / 4, bound);
  const RodOnTrack built = rod.scene();
  EXPECT_NEAR(simulate(built.scene, {.t_end = 0.1, .samples = 2}).multiplier(built.track, 0), 9.81 / 4,
              bound);
}

TEST(SlidingRod, BearsItsWeightHangingStraightDownOrBalancedUpright) {
  for (const double angle : {0.0, std::numbers::pi}) {
    const RodOnTrack built = SlidingRod{.angle = angle}.scene();
    const Trajectory<2> run = simulate(built.scene, {.t_end = 0.5, .samples = 6});
    // sin(pi) is 1.2e-16 in double; upright, that grows by exp(sqrt(6 g/l) t) = 50, and enters the force
    // squared.
    for (std::size_t i = 0; i < run.size(); ++i)
      EXPECT_NEAR(run.multiplier(built.track, i), 9.81, 20 * std::numeric_limits<double>::epsilon() * 9.81);
  }
}

TEST(SlidingRod, MomentumAlongTheTrackIsBetaOfTheNotes) {
  // beta_x = m x' + (m l/2) theta' cos theta, with x' and theta' of the simulated foot and body, is kept. The
  // tolerance is per step and relative to lengths and speeds of order one.
  const SlidingRod rod{.mass = 0.8, .length = 1.4, .angle = 0.9, .drift = -0.4};
  const RodOnTrack built = rod.scene();
  constexpr double tolerance = 1e-8;
  const Trajectory<2> run = simulate(built.scene, {.t_end = 2.0, .tolerance = tolerance});
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Vec<2> axis = built.rod.axes(run.sample(i)).col(0);  // (sin theta, cos theta)
    const Vec<2> turning = run.velocity(built.rod.centre(), i) - run.velocity(built.foot, i);
    const double rate = -cross(axis, turning) / (rod.length / 2);  // theta counts clockwise
    const double beta =
        rod.mass * run.velocity(built.foot, i).x() + rod.mass * rod.length / 2 * rate * axis.y();
    EXPECT_NEAR(beta, rod.mass * rod.drift, static_cast<double>(run.statistics().steps) * tolerance);
  }
}

}  // namespace
}  // namespace dalembert::models::sliding_rod_test
