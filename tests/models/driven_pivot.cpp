#include "dalembert/models/driven_pivot.h"

#include "conserved.h"
#include <dalembert/models/plane_pendulum.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace dalembert::models::driven_pivot_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::array times{0.1, 0.5, 1.3, 3.1};

TEST(DrivenPivot, TensionIsWhatNewtonDemandsForEveryWayOfDriving) {
  for (DrivenPivot pivot : {DrivenPivot::horizontal(), DrivenPivot::vertical(), DrivenPivot::circular()}) {
    pivot.mass = 0.7;
    pivot.length = 1.3;
    const Model<2> model = pivot.model();
    SCOPED_TRACE(model.name);
    for (const double t : times) {
      const Stencil<2> bob(model, t, 1e-3, 0);
      const Vec<2> upwards = (pivot.pivot(t) - bob.position()) / pivot.length;
      expect_newton<2>(bob, pivot.mass, pivot.gravity, pivot.reference(t).forces[0] * upwards, model.force);
    }
  }
}

TEST(DrivenPivot, PivotsMoveAsInTheNotes) {
  // x = A cos omega t (mex248); y down = A cos omega t (mex249); x = A cos, y = A sin (mex250). Phases of pi
  // and pi/2 are rounded.
  constexpr double A = 0.1, t = 0.37, bound = 1e-15;
  const double c = A * std::cos(10.0 * t), s = A * std::sin(10.0 * t);
  EXPECT_LT((DrivenPivot::horizontal(A).pivot(t) - Vec<2>(c, 0.0)).norm(), bound);
  EXPECT_LT((DrivenPivot::vertical(A).pivot(t) - Vec<2>(0.0, -c)).norm(), bound);
  EXPECT_LT((DrivenPivot::circular(A).pivot(t) - Vec<2>(c, s)).norm(), bound);
}

TEST(DrivenPivot, IsThePlanePendulumAtRest) {
  const DrivenPivot still{.angle = 2.0};
  const PlanePendulum pendulum{.amplitude = 2.0};
  for (const double t : times) {
    EXPECT_LT((still.reference(t).positions[0] - pendulum.reference(t).positions[0]).norm(), 1e-13);
    EXPECT_NEAR(still.reference(t).forces[0], pendulum.reference(t).forces[0], 1e-13 * 3 * 9.81);
  }
}

/// How far from upright the pendulum gets in a run over 30 swings of g and l, from 0.1 rad off it, driven
/// vertically with A = l/20 and A^2 omega^2 = ratio 2 g l.
double farthest_from_upright(double ratio) {
  DrivenPivot pivot = DrivenPivot::vertical(0.05);
  pivot.frequency = std::sqrt(ratio * 2 * pivot.gravity * pivot.length) / pivot.amplitude_y;
  pivot.angle = pi - 0.1;
  const DrivenPendulum built = pivot.scene();
  double farthest = 0.0;
  simulate(built.scene, {.t_end = 30.0, .samples = 3001, .tolerance = 1e-7}, [&](const Sample<2>& sample) {
    const Vec<2> rod = sample.position(built.bob) - pivot.pivot(sample.time());
    farthest = std::max(farthest, std::abs(std::atan2(rod.x(), rod.y())));
  });
  return farthest;
}

TEST(DrivenPivot, StandsUpsideDownIfDrivenFastEnough) {
  // Kapitza: averaged over the drive, the potential per m g l is cos x + (ratio/2) sin^2 x in x from upright;
  // the swing also trembles by (A/l) sin x. At ratio 2 the barrier is at cos x = 1/2 and 0.1 rad stays of
  // order 0.1.
  EXPECT_LT(farthest_from_upright(2.0), 0.2);
  EXPECT_GT(farthest_from_upright(0.5), pi / 2);
}

}  // namespace
}  // namespace dalembert::models::driven_pivot_test
