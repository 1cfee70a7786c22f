#include "../both_steppers.h"
#include <dalembert/dalembert.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dalembert::joints_gears_test {
namespace {

constexpr double gravity = 9.81;

class GearTrain : public testing::TestWithParam<Stepper> {};
INSTANTIATE_TEST_SUITE_P(Steppers, GearTrain, both_steppers, stepper_name);

// In space: a rack of mass m falls and turns a pinion of radius r_1, to which a wheel of z_1 teeth is welded,
// which turns one of z_2 teeth. All axes lie along x; the line of centres, of length d, along y.
//
//   a = m g/(m + (J_1 + J_2 (z_1/z_2)^2)/r_1^2)
//   rack:     teeth push it up with F = m (g - a), against its slide at a distance b behind
//   gear 2:   J_2 a z_1/(z_2 r_1) = G d z_2/(z_1 + z_2),   G the force of the teeth
//   bearings: bear the weight of their gear and what its teeth feel.
TEST_P(GearTrain, FallsWithItsReducedMassAndLoadsItsBearings) {
  constexpr double m = 4.0, J1 = 0.05, J2 = 0.3, r1 = 0.1, d = 0.5, m1 = 2.0, m2 = 3.0, b = 0.04;
  constexpr int z1 = 20, z2 = 30;
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -gravity}});
  const Vec<3> x(1, 0, 0), up(0, 0, 1), c2(0, d, 0), pitch_point(0, -r1, 0), behind(0, -r1 - b, 0);
  const auto rack = add_body<3>(scene, {.mass = m, .inertia = {0.2, 0.2, 0.1}, .centre = behind}, "rack");
  const auto first = add_body<3>(scene, {.mass = m1, .inertia = {J1, 0.04, 0.04}}, "first");
  const auto second = add_body<3>(scene, {.mass = m2, .inertia = {J2, 0.2, 0.2}, .centre = c2}, "second");
  const auto slide = add_joint(scene, Prismatic{Ground<3>{}, rack, behind, up}, "slide");
  const auto bearing1 = add_joint(scene, Revolute{Ground<3>{}, first, {0, 0, 0}, x}, "bearing 1");
  const auto bearing2 = add_joint(scene, Revolute{Ground<3>{}, second, c2, x}, "bearing 2");
  const auto teeth = add_joint(scene, RackAndPinion{rack, first, {0, 0, 0}, pitch_point, up}, "pinion");
  const auto mesh = add_joint(scene, Gear{first, second, {0, 0, 0}, c2, x, z1, z2}, "mesh");

  const auto run = simulate(scene, {.t_end = 2.0, .samples = 9, .tolerance = 1e-10, .stepper = GetParam()});
  ASSERT_EQ(run.statistics().degrees_of_freedom, 1);
  const double ratio = static_cast<double>(z1) / z2;
  const double a = m * gravity / (m + (J1 + J2 * ratio * ratio) / (r1 * r1));
  const double F = m * (gravity - a), G = J2 * a * ratio / r1 * (z1 + z2) / (d * z2);
  constexpr double promised = 1e-8 * 100.0;  // of forces of some 10 to 100
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Sample<3> now = run.sample(i);
    const double t = run.times()[i];
    EXPECT_NEAR(now.position(rack.centre()).z(), -0.5 * a * t * t, 1e-8);
    // The rack falls before the first gear, at y < 0: that turns about +x, the second about -x.
    EXPECT_NEAR(angular_velocity(now, bearing1), a * t / r1, 1e-7);
    EXPECT_NEAR(angular_velocity(now, bearing2), -ratio * a * t / r1, 1e-7);
    EXPECT_NEAR(now.multiplier(teeth), -F, promised);
    EXPECT_NEAR(now.multiplier(mesh), G, promised);
    // Turned about +x, the first pushes the second at y > 0 upwards, and is itself pushed down.
    EXPECT_LT((reaction(now, mesh).force - G * up).norm(), promised);
    EXPECT_LT((reaction(now, bearing2).force - (m2 * gravity - G) * up).norm(), promised);
    EXPECT_LT((reaction(now, bearing1).force - (m1 * gravity + F + G) * up).norm(), promised);
    EXPECT_LT(reaction(now, slide).force.norm(), promised);
    // F up at +b of the rack's centre, about +x, against the slide.
    EXPECT_LT((reaction(now, slide).torque + b * F * x).norm(), promised);
  }
  EXPECT_GT(0.5 * a * 4.0 / r1, 10.0 * std::numbers::pi);  // more than five turns
}

// In the plane: a sun and a fixed ring, z_s and z_r teeth, with one planet between on an arm about the sun's
// centre. Willis: w_arm/w_sun = z_s/(z_s + z_r), w_planet = -w_arm (z_r - z_p)/z_p. A damper c brakes the
// arm;
//
//   I = J_arm + (m_p R^2 + J_p (w_p/w_a)^2) + J_s (w_s/w_a)^2,   w_arm = w_0 e^(-c t/I).
//
// With ' = -c/I: the sun's teeth feel J_s w_s' = -S r_s, the planet's turning J_p w_p' = (S' ...) gives the
// ring's.
TEST_P(GearTrain, PlanetsObeyWillisAndFeelTheirTeeth) {
  constexpr double Js = 0.02, Jp = 0.03, Ja = 0.1, mp = 2.0, R = 0.3, c = 0.4, w0 = 9.0;
  constexpr int zs = 18, zp = 27, zr = zs + 2 * zp;
  const double rs = R * zs / (zs + zp), rp = R * zp / (zs + zp);
  const double sun_per_arm = static_cast<double>(zs + zr) / zs;
  const double planet_per_arm = -static_cast<double>(zr - zp) / zp;
  Scene<2> scene;
  const Vec<2> O(0, 0), P(R, 0);
  const auto sun =
      add_body<2>(scene, {.mass = 1.0, .inertia = Js, .angular_velocity = sun_per_arm * w0}, "sun");
  const auto arm = add_body<2>(scene, {.mass = 1.0, .inertia = Ja, .angular_velocity = w0}, "arm");
  const auto planet = add_body<2>(scene,
                                  {.mass = mp,
                                   .inertia = Jp,
                                   .centre = P,
                                   .velocity = {0, R * w0},
                                   .angular_velocity = planet_per_arm * w0},
                                  "planet");
  add_joint(scene, Revolute{Ground<2>{}, sun, O}, "sun's bearing");
  const auto bearing = add_joint(scene, Revolute{Ground<2>{}, arm, O}, "arm's bearing");
  const auto pin = add_joint(scene, Revolute{arm, planet, P}, "pin");
  const auto inner = add_joint(scene, Gear{sun, planet, O, P, zs, zp}, "inner");
  const auto outer = add_joint(scene, Gear{planet, Ground<2>{}, P, O, zp, -zr}, "outer");
  scene.add(TorsionDamper{bearing, c});

  const auto run = simulate(scene, {.t_end = 1.5, .samples = 7, .tolerance = 1e-10, .stepper = GetParam()});
  ASSERT_EQ(run.statistics().degrees_of_freedom, 1);
  const double I = Ja + mp * R * R + Jp * planet_per_arm * planet_per_arm + Js * sun_per_arm * sun_per_arm;
  constexpr double promised = 1e-8 * 100.0;  // of forces of some 10 to 100
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Sample<2> now = run.sample(i);
    const double t = run.times()[i], w = w0 * std::exp(-c / I * t), w_rate = -c / I * w;
    const double of_fastest = 1e-8 * sun_per_arm * w0;
    EXPECT_NEAR(angular_velocity(now, arm), w, of_fastest);
    EXPECT_NEAR(angular_velocity(now, sun), sun_per_arm * w, of_fastest);
    EXPECT_NEAR(angular_velocity(now, planet), planet_per_arm * w, of_fastest);
    // Along the arm e, and ahead of it n. The planet pushes the sun by -S ahead, S the sun's on the planet:
    const Vec<2> e = now.position(planet.centre()).normalized(), n(-e.y(), e.x());
    const double S = -Js * sun_per_arm * w_rate / rs;
    // about the planet's centre S acts at -r_p and the ring's force Q at +r_p
    const double Q = Jp * planet_per_arm * w_rate / rp + S;
    EXPECT_LT((reaction(now, inner).force - S * n).norm(), promised);
    EXPECT_LT((reaction(now, outer).force + Q * n).norm(), promised);  // on the ring
    const Vec<2> of_pin = mp * (R * w_rate * n - R * w * w * e) - (S + Q) * n;
    EXPECT_LT((reaction(now, pin).force - of_pin).norm(), promised);
    EXPECT_LT((reaction(now, bearing).force - of_pin).norm(), promised);
  }
}

TEST(Gear, MayBeGivenOtherTeeth) {
  Scene<2> scene;
  const auto a = add_body<2>(scene, {.mass = 1.0, .inertia = 0.1}, "a");
  const auto b = add_body<2>(scene, {.mass = 1.0, .inertia = 0.1, .centre = {0.6, 0}}, "b");
  Gear mesh{a, b, {0, 0}, {0.6, 0}, 10, 20};
  mesh.teeth_a = 20;
  const Gear stated{a, b, {0, 0}, {0.6, 0}, 20, 20};
  // Turned by 0.1 out of mesh, by as much of the pitch circle.
  const Vec<2> O(0, 0), P(0.6, 0), x(1, 0), y(0, 1), turned(std::cos(0.1), std::sin(0.1)),
      left(-turned.y(), turned.x());
  EXPECT_EQ(mesh(O, x, y, P, turned, left), stated(O, x, y, P, turned, left));
  EXPECT_NEAR(std::abs(mesh(O, x, y, P, turned, left)), 0.3 * 0.1, 1e-15);
}

// A drive that rests, turns round once within much less than a step, and rests again: the pinion ends as it
// began, and the wheel of twice as many teeth half a turn on.
TEST_P(GearTrain, AnIndexingDriveLosesNoTurn) {
  for (const double within : {0.1, 0.03, 0.01, 0.001}) {
    for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
      Scene<2> scene;
      const Vec<2> O(0, 0), P(0.3, 0);
      const auto pinion = add_body<2>(scene, {.mass = 1.0, .inertia = 0.1}, "pinion");
      const auto wheel = add_body<2>(scene, {.mass = 1.0, .inertia = 0.3, .centre = P}, "wheel");
      const auto pin = add_joint(scene, Revolute{Ground<2>{}, pinion, O}, "pin");
      add_joint(scene, Revolute{Ground<2>{}, wheel, P}, "bearing");
      add_joint(scene, Gear{pinion, wheel, O, P, 20, 40}, "mesh");
      const auto round = [within](auto t) { return std::numbers::pi * (1.0 + tanh((t - 4.23) / within)); };
      const Rotor armature = scene.add_rotor({.inertia = 1e-3});
      add_joint(scene, AngleDrive{pin, armature, round}, "motor");
      const auto run =
          simulate(scene, {.t_end = 10.0, .samples = 101, .tolerance = tolerance, .stepper = GetParam()});
      // Both are projected onto their constraints, to some hundred roundings.
      EXPECT_NEAR(run.angle(armature, 100), 2.0 * std::numbers::pi, 1e-11) << within << ' ' << tolerance;
      EXPECT_NEAR(std::cos(angle(run.sample(100), wheel)), -1.0, 1e-11) << within << ' ' << tolerance;
    }
  }
}

// Three turns of a planet take its ring back to where it was, at a loose tolerance and over a thousand turns:
// a tooth lost would show.
TEST_P(GearTrain, LosesNoTooth) {
  constexpr int z1 = 64, z2 = 81;  // no common divisor: a tooth is 1/81 of a turn
  Scene<2> scene;
  const Vec<2> O(0, 0), P(1, 0);
  const double w1 = 100.0, w2 = -w1 * z1 / z2;
  const auto a = add_body<2>(scene, {.mass = 1.0, .inertia = 0.1, .angular_velocity = w1}, "a");
  const auto b = add_body<2>(scene, {.mass = 1.0, .inertia = 0.3, .centre = P, .angular_velocity = w2}, "b");
  const auto pin_a = add_joint(scene, Revolute{Ground<2>{}, a, O}, "pin a");
  const auto pin_b = add_joint(scene, Revolute{Ground<2>{}, b, P}, "pin b");
  add_joint(scene, Gear{a, b, O, P, z1, z2}, "mesh");
  const Rotor turns_a = scene.add_rotor({.inertia = 1e-3, .angular_velocity = w1});
  const Rotor turns_b = scene.add_rotor({.inertia = 1e-3, .angular_velocity = w2});
  scene.add(TurnCounter{pin_a, turns_a});
  scene.add(TurnCounter{pin_b, turns_b});
  const auto run = simulate(scene, {.t_end = 60.0, .samples = 13, .tolerance = 1e-3, .stepper = GetParam()});
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double phi_a = run.angle(turns_a, i), phi_b = run.angle(turns_b, i);
    // To the round-off of some hundred roundings of positions of size 1, times the teeth.
    EXPECT_NEAR(z1 * phi_a + z2 * phi_b, 0.0, 6000.0 * 81.0 * 1e-14 + 1e-11) << i;
  }
  EXPECT_GT(run.angle(turns_a, 12), 5000.0);
}

}  // namespace
}  // namespace dalembert::joints_gears_test
