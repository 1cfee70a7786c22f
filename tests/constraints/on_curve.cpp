#include "dalembert/constraints/on_curve.h"

#include "../equations.h"
#include <dalembert/solvers/simulation.h>

#include <gmock/gmock.h>

namespace dalembert::on_curve_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double round_off = 32.0 * std::numeric_limits<double>::epsilon();

// On an incline of 3:4 the normal force is m g cos = 2 * 10 * 4/5, along the normal (-3, 4)/5.
TEST(OnCurve, NormalForceOnAnInclineIsTheCosineOfTheWeight) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -10.0}});
  const auto bead = scene.add_particle({.mass = 2.0, .position = {4.0, 3.0}});
  const auto line = scene.add(OnCurve{bead, Plane<2>{{0.0, 0.0}, {-3.0, 4.0}}});
  const Simulation<2> simulation(scene, {.t_end = 1.0});
  EXPECT_NEAR(simulation.multiplier(line), 16.0, 20.0 * round_off);
  EXPECT_LE((simulation.constraint_force(line, bead) - 16.0 * Vec<2>(-0.6, 0.8)).norm(), 20.0 * round_off);
}

// At the top of a circle of radius 2 with speed 3: N = m g - m v^2 / R = 20 - 9, outwards.
TEST(OnCurve, SpeedLightensABeadOnTopOfACircle) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -10.0}});
  const auto bead = scene.add_particle({.mass = 2.0, .position = {1.0, 3.0}, .velocity = {3.0, 0.0}});
  const auto circle = scene.add(OnCurve{bead, Sphere<2>{{1.0, 1.0}, 2.0}});
  EXPECT_NEAR(Simulation<2>(scene, {.t_end = 1.0}).multiplier(circle), 11.0, 20.0 * round_off);
}

// y = x^2 through its vertex with speed v: curvature 2, so N = m (g + 2 v^2) = 1 (10 + 8); |grad g| = 1.
TEST(OnCurve, ParabolaCarriesWeightAndCentripetalForceAtItsVertex) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -10.0}});
  const auto bead = scene.add_particle({.mass = 1.0, .velocity = {2.0, 0.0}});
  const auto wire = scene.add(OnCurve{bead, [](auto r) { return r.y() - r.x() * r.x(); }});
  const Simulation<2> simulation(scene, {.t_end = 1.0});
  EXPECT_LE((simulation.constraint_force(wire, bead) - Vec<2>(0.0, 18.0)).norm(), 18.0 * round_off);
}

// A line that rises with acceleration 3, y = 1.5 t^2: N = m (g + 3).
TEST(OnCurve, ALiftAddsToTheWeight) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -10.0}});
  const auto bead = scene.add_particle({.mass = 2.0});
  const auto lift = scene.add(OnCurve{bead, [](auto t, auto r) { return r.y() - 1.5 * t * t; }});
  EXPECT_NEAR(Simulation<2>(scene, {.t_end = 1.0}).multiplier(lift), 26.0, 26.0 * round_off);
}

TEST(OnCurve, RefusesACurveThatMakesNoSense) {
  Scene<2> scene;
  const auto bead = scene.add_particle({.mass = 1.0});
  EXPECT_THAT(
      [&] {
        scene.add(OnCurve{bead, Sphere<2>{{0.0, 0.0}, -1.0}}, "ring");
      },
      ThrowsMessage<InvalidScene>(
          AllOf(HasSubstr("OnCurve \"ring\""), HasSubstr("radius = "), HasSubstr("finite and > 0"))));
  EXPECT_THAT(
      [&] {
        scene.add(OnCurve{bead, Plane<2>{{0.0, 0.0}, {0.0, 0.0}}}, "line");
      },
      ThrowsMessage<InvalidScene>(AllOf(HasSubstr("OnCurve \"line\""), HasSubstr("normal must be finite"))));
}

// x y = 0 has no normal where its branches cross.
TEST(OnCurve, APointWithoutNormalIsNamed) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -1.0}});
  const auto bead = scene.add_particle({.mass = 1.0});
  scene.add(OnCurve{bead, [](auto r) { return r.x() * r.y(); }}, "cross");
  EXPECT_THAT(
      [&] { (void)simulate(scene, {.t_end = 1.0}); },
      ThrowsMessage<InconsistentStart>(AllOf(HasSubstr("OnCurve \"cross\""), HasSubstr("no normal"))));
}

}  // namespace
}  // namespace dalembert::on_curve_test
