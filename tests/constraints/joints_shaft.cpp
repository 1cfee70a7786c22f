#include "../both_steppers.h"
#include <dalembert/dalembert.h>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

// Two shafts joined by a universal joint at an angle b turn freely. With a the angle of the driving shaft
// from where its pin lies in the plane of both shafts,
//
//   a_2' = rho a',   rho = cos b/(1 - sin^2 b cos^2 a)                        (the classical ratio)
//   2 E = (J_1 + J_2 rho^2) a'^2
//   a'' = -J_2 rho rho_a a'^2/(J_1 + J_2 rho^2),   rho_a = -2 rho sin^2 b cos a sin a/(1 - sin^2 b cos^2 a).
//
// The cross turns on both pins, so its torque T is along their normal n, u the pin of the driving shaft and
// e_2 the axis of the driven one: n = (e_2 - (e_2 . u) u)/sqrt(1 - sin^2 b cos^2 a). About e_2, T n . e_2 =
// J_2 a_2''. Across it the driven shaft, whose centre and axis stand still, gives no torque: that of T n is
// balanced by the couple of the far bearing, at a distance l, and of the joint, which bears F = T n x e_2/l.
namespace dalembert::joints_shaft_test {
namespace {

constexpr double b = 0.6, J1 = 0.3, J2 = 0.8, l = 1.5, speed = 4.0;

/// Angle and rate of the driving shaft at increasing times: the classical Runge-Kutta method in extended
/// precision; with steps of 1e-4 of a turn its error, of fourth order, is round-off.
struct Driving {
  long double a = 0, rate = speed;
  long double t = 0;

  static long double rho(long double a) {
    const long double c = std::cos(a), s = std::sin((long double)b);
    return std::cos((long double)b) / (1 - s * s * c * c);
  }
  static long double second(long double a, long double rate) {
    const long double c = std::cos(a), s = std::sin((long double)b), r = rho(a);
    const long double r_a = -2 * r * s * s * c * std::sin(a) / (1 - s * s * c * c);
    return -J2 * r * r_a * rate * rate / (J1 + J2 * r * r);
  }
  void advance_to(long double end) {
    const int steps = 1 + static_cast<int>((end - t) / 1e-4L);
    const long double h = (end - t) / steps;
    for (int i = 0; i < steps; ++i) {
      const long double k1 = second(a, rate), r2 = rate + h / 2 * k1, k2 = second(a + h / 2 * rate, r2);
      const long double r3 = rate + h / 2 * k2, k3 = second(a + h / 2 * r2, r3);
      const long double r4 = rate + h * k3, k4 = second(a + h * r3, r4);
      a += h / 6 * (rate + 2 * r2 + 2 * r3 + r4);
      rate += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    t = end;
  }
};

class UniversalShaft : public testing::TestWithParam<Stepper> {};
INSTANTIATE_TEST_SUITE_P(Steppers, UniversalShaft, both_steppers, stepper_name);

TEST_P(UniversalShaft, HasTheClassicalRatioAndTheTorqueOfItsCross) {
  const Vec<3> e1(1.0, 0.0, 0.0), e2(std::cos(b), std::sin(b), 0.0), across(-std::sin(b), std::cos(b), 0.0);
  Eigen::Matrix3d axes;
  axes << e2, across, Vec<3>::UnitZ();
  Scene<3> scene;
  const auto driving = add_body<3>(
      scene, {.mass = 2.0, .inertia = {J1, 0.25, 0.25}, .centre = -0.7 * e1, .angular_velocity = speed * e1},
      "driving");
  const auto driven = add_body<3>(scene,
                                  {.mass = 3.0,
                                   .inertia = {J2, 0.7, 0.7},
                                   .centre = 0.8 * e2,
                                   .axes = axes,
                                   .angular_velocity = speed / std::cos(b) * e2},
                                  "driven");
  const auto bearing = add_joint(scene, Revolute{Ground<3>{}, driving, -1.0 * e1, e1}, "bearing");
  const auto cross =
      add_joint(scene, Universal{driving, driven, {0, 0, 0}, Vec<3>::UnitY(), Vec<3>::UnitZ()}, "cross");
  // The far bearing holds a point; a second hinge would hold the axis twice.
  scene.add(OnSurface{driven.point_at(l * e2), Plane<3>{l * e2, across}});
  scene.add(OnSurface{driven.point_at(l * e2), Plane<3>{l * e2, Vec<3>::UnitZ()}});

  const auto run = simulate(scene, {.t_end = 1.0, .samples = 11, .tolerance = 1e-10, .stepper = GetParam()});
  ASSERT_EQ(run.statistics().degrees_of_freedom, 1);
  Driving reference;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Sample<3> now = run.sample(i);
    reference.advance_to(run.times()[i]);
    const double a = static_cast<double>(reference.a), rate = static_cast<double>(reference.rate);
    const double rho = static_cast<double>(Driving::rho(reference.a));
    const double second = static_cast<double>(Driving::second(reference.a, reference.rate));
    const double rho_rate =
        -2.0 * rho * rho / std::cos(b) * std::sin(b) * std::sin(b) * std::cos(a) * std::sin(a) * rate;
    const Vec<3> u(0.0, std::cos(a), std::sin(a));
    const Vec<3> n = (e2 - e2.dot(u) * u).normalized();
    const double T = J2 * (rho * second + rho_rate * rate) / n.dot(e2);
    const Vec<3> F = T / l * n.cross(e2);

    constexpr double promised = 1e-8;  // of forces and torques of size 1 to 10
    EXPECT_NEAR(angular_velocity(now, bearing), rate, promised);
    EXPECT_NEAR(angular_velocity(now, driven).dot(e2) / angular_velocity(now, bearing), rho, promised);
    const Reaction<3> on_driven = reaction(now, cross), on_driving = reaction(now, bearing);
    EXPECT_LT((on_driven.torque - T * n).norm(), promised * 10.0) << T;
    EXPECT_LT((on_driven.force - F).norm(), promised * 10.0);
    EXPECT_LT((on_driving.force - F).norm(), promised * 10.0);
  }
}

}  // namespace
}  // namespace dalembert::joints_shaft_test
