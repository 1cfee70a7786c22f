#include "../both_steppers.h"
#include <dalembert/dalembert.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

// A screw press. A spindle turns in the nut of its frame and carries a ram, which a slide guides and a spring
// below holds up. The spindle's travel is x = kappa phi, kappa = pitch/(2 pi), the ram goes with it:
//
//   (J/kappa^2 + m_s + m_r) x'' = -(m_s + m_r) g - k x        x(t) = x_e (1 - cos w t) from rest      (1)
//
// with the spring relaxed at the start. On the ram the spindle exerts P = m_r (x'' + g) + k x upwards; on the
// spindle the nut exerts P + m_s (x'' + g) upwards and the torque J phi'' about its axis, the ratio of which
// is -kappa but for inertia: F kappa + J phi'' = 0. The ram hangs offset by c from the spindle's axis: its
// slide takes the moment of P and the weight.
namespace dalembert::joints_press_test {
namespace {

constexpr double pitch = 0.02, kappa = pitch / (2.0 * std::numbers::pi), J = 4e-4, m_s = 3.0, m_r = 5.0;
constexpr double gravity = 9.81, k = 2000.0, c = 0.1;

class ScrewPress : public testing::TestWithParam<Stepper> {};
INSTANTIATE_TEST_SUITE_P(Steppers, ScrewPress, both_steppers, stepper_name);

TEST_P(ScrewPress, OscillatesAsItsReducedMass) {
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -gravity}});
  const auto spindle =
      add_body<3>(scene, {.mass = m_s, .inertia = {0.02, 0.02, J}, .centre = {0, 0, 0.3}}, "spindle");
  const auto ram =
      add_body<3>(scene, {.mass = m_r, .inertia = {0.03, 0.04, 0.05}, .centre = {c, 0, -0.4}}, "ram");
  const auto nut = add_joint(scene, Screw{Ground<3>{}, spindle, {0, 0, 0.2}, {0, 0, 1}, pitch}, "nut");
  const auto slide = add_joint(scene, Prismatic{Ground<3>{}, ram, {c, 0, -0.4}, {0, 0, 1}}, "slide");
  const auto rod = scene.add(Distance{spindle.point_at({0, 0, 0}), ram.point_at({0, 0, -0.2}), 0.2}, "neck");
  scene.add(Spring{Fixed<3>{{c, 0, -1.4}}, ram.centre(), k, 1.0});

  const auto run = simulate(scene, {.t_end = 1.0, .samples = 11, .tolerance = 1e-10, .stepper = GetParam()});
  ASSERT_EQ(run.statistics().degrees_of_freedom, 1);
  const double m = J / (kappa * kappa) + m_s + m_r, w = std::sqrt(k / m);
  const double x_e = -(m_s + m_r) * gravity / k;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i], x = x_e * (1.0 - std::cos(w * t)), x2 = x_e * w * w * std::cos(w * t);
    const double P = m_r * (x2 + gravity) + k * x, F = P + m_s * (x2 + gravity);
    const Sample<3> now = run.sample(i);
    EXPECT_NEAR(travel(now, nut), x, 1e-10 * 100.0);
    EXPECT_NEAR(now.multiplier(rod), -P, 1e-8 * 100.0);  // of a weight of 100: it hangs
    const Reaction<3> on_spindle = reaction(now, nut), on_ram = reaction(now, slide);
    EXPECT_LT((on_spindle.force - F * Vec<3>::UnitZ()).norm(), 1e-8 * 100.0);
    EXPECT_LT((on_spindle.torque - J * x2 / kappa * Vec<3>::UnitZ()).norm(), 1e-8);
    EXPECT_NEAR(on_spindle.torque.z(), -kappa * F, 1e-8);
    EXPECT_LT(on_ram.force.norm(), 1e-8 * 100.0);
    // P acts at -c from the ram's centre: its moment about it is P c about +y, the slide's the opposite.
    EXPECT_LT((on_ram.torque + P * c * Vec<3>::UnitY()).norm(), 1e-8 * 100.0 * c);
  }
}

// Falling free, without spring or ram, a heavy flywheel on a fine thread turns 300 times. Its turns are
// counted by a rotor, whose angle is a coordinate of its own: no thread is lost, at whatever tolerance.
TEST_P(ScrewPress, LosesNoThread) {
  constexpr double fine = 0.001, per = fine / (2.0 * std::numbers::pi), drop = 0.3, its_J = 8e-5,
                   counter = 1e-5;
  for (const double tolerance : {1e-3, 1e-6}) {
    Scene<3> scene;
    scene.add(UniformGravity<3>{{0.0, 0.0, -gravity}});
    const auto wheel = add_body<3>(scene, {.mass = 5.0, .inertia = {6e-5, 6e-5, its_J}}, "wheel");
    const auto nut = add_joint(scene, Screw{Ground<3>{}, wheel, {0, 0, 0}, {0, 0, 1}, fine}, "nut");
    const Rotor turns = scene.add_rotor({.inertia = counter}, "turns");
    scene.add(TurnCounter{nut, turns});
    const double a = 5.0 * gravity / ((its_J + counter) / (per * per) + 5.0), T = std::sqrt(2.0 * drop / a);
    const auto run =
        simulate(scene, {.t_end = T, .samples = 31, .tolerance = tolerance, .stepper = GetParam()});
    for (std::size_t i = 0; i < run.size(); ++i) {
      const Sample<3> now = run.sample(i);
      // Of 2000 radians, to the round-off of positions (a hundred roundings of an angle of size 1).
      EXPECT_NEAR(travel(now, nut) / per, now.angle(turns), 2000.0 * 1e-13 + 1e-13) << "at " << tolerance;
    }
    RecordProperty("turns", std::to_string(travel(run.sample(30), nut) / fine));
    // Of the way, one tolerance for each radian.
    EXPECT_NEAR(travel(run.sample(30), nut), -drop, 2000.0 * tolerance * drop);
  }
}

}  // namespace
}  // namespace dalembert::joints_press_test
