#include "../both_steppers.h"
#include "newton_euler.h"
#include <dalembert/dalembert.h>
#include <dalembert/eigen.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

// A spatial slider-crank: a crank turns about the x axis through A and carries, by a ball joint B, a coupler
// that a universal joint C joins to a slider on the x axis. A motor turns the crank by phi(t).
//
//   B = A + r (0, cos phi, sin phi),   C = (x, 0, 0),   x = B_x + sqrt(L^2 - B_y^2 - B_z^2)
//   e = (C - B)/L,   pin of C in the slider: y,   pin in the coupler: p = e x y/|e x y|
//
// The coupler's axes are e, p, e x p: its turn about itself too is given. Six equations of the coupler and
// that of the slider along x give the force at B (3), at C (3) and the torque of the cross; the rest follows.
namespace dalembert::joints_slider_crank_test {
namespace {

using namespace newton_euler;

constexpr Real r = 0.25L, L = 1.2L;
const Vector A(0.1L, 0.3L, 0.2L), g(0, 0, -9.81L);
constexpr double crank_mass = 1.5, coupler_mass = 2.0, slider_mass = 3.0;
const Vec<3> crank_inertia(0.02, 0.03, 0.04), coupler_inertia(0.05, 0.3, 0.28),
    slider_inertia(0.1, 0.12, 0.15);

constexpr auto phi = [](const auto& t) {
  using std::sin;
  return 0.4 + 3.0 * t + 0.5 * sin(2.0 * t);
};

Vector ball(Real t) { return A + r * Vector(0, std::cos(phi(t)), std::sin(phi(t))); }
Vector slider(Real t) {
  const Vector B = ball(t);
  return {B.x() + std::sqrt(L * L - B.y() * B.y() - B.z() * B.z()), 0, 0};
}
Matrix coupler_axes(Real t) {
  const Vector e = (slider(t) - ball(t)).normalized(), p = e.cross(Vector::UnitY()).normalized();
  Matrix axes;
  axes << e, p, e.cross(p);
  return axes;
}

class SpatialSliderCrank : public testing::TestWithParam<Stepper> {};
INSTANTIATE_TEST_SUITE_P(Steppers, SpatialSliderCrank, both_steppers, stepper_name);

TEST_P(SpatialSliderCrank, HasTheForcesOfNewtonAndEuler) {
  // The statement, in double precision; positions at the start from the formulas above.
  const Vec<3> A0 = A.cast<double>(), B0 = ball(0).cast<double>(), C0 = slider(0).cast<double>();
  const Eigen::Matrix3d axes = coupler_axes(0).cast<double>();
  Scene<3> scene;
  scene.add(UniformGravity<3>{g.cast<double>()});
  const auto crank =
      add_body<3>(scene, {.mass = crank_mass, .inertia = crank_inertia, .centre = 0.5 * (A0 + B0)}, "crank");
  const auto coupler = add_body<3>(
      scene, {.mass = coupler_mass, .inertia = coupler_inertia, .centre = 0.5 * (B0 + C0), .axes = axes},
      "coupler");
  const auto block =
      add_body<3>(scene, {.mass = slider_mass, .inertia = slider_inertia, .centre = C0}, "slider");
  const auto hinge = add_joint(scene, Revolute{Ground<3>{}, crank, A0, {1, 0, 0}}, "hinge");
  const auto at_B = scene.add(Coincident{crank.point_at(B0), coupler.point_at(B0)}, "ball");
  const auto cross = add_joint(scene, Universal{coupler, block, C0, axes.col(1), {0, 1, 0}}, "cross");
  const auto guide = add_joint(scene, Prismatic{Ground<3>{}, block, C0, {1, 0, 0}}, "guide");
  const auto armature = scene.add_rotor({.inertia = 0.01}, "armature");
  const auto motor =
      add_joint(scene, AngleDrive{hinge, armature, [](auto t) { return phi(t) - 0.4; }}, "motor");
  const auto run = simulate(
      scene, {.t_end = 3.0, .samples = 13, .tolerance = 1e-10, .stepper = GetParam(), .assemble = true});
  ASSERT_EQ(run.statistics().degrees_of_freedom, 0);

  const auto inertia = [](const Vec<3>& principal) {
    return Matrix(eigen(principal.cast<Real>()).asDiagonal());
  };
  const Body coupler_moving{coupler_mass, inertia(coupler_inertia),
                            [](Real t) { return Vector((ball(t) + slider(t)) / 2); }, coupler_axes};
  const Body crank_moving{crank_mass, inertia(crank_inertia),
                          [](Real t) { return Vector((A + ball(t)) / 2); },
                          [](Real t) {
                            const Real p = phi(t) - phi(Real(0));
                            return Matrix(Eigen::AngleAxis<Real>(p, Vector::UnitX()).toRotationMatrix());
                          }};
  constexpr double promised = 1e-8 * 100.0;  // of forces up to some 100 and torques of some 10
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Real t = run.times()[i];
    const Vector B = ball(t), C = slider(t), half = (C - B) / 2;
    const Matrix frame = coupler_axes(t);
    const Vector n = Vector::UnitY().cross(frame.col(1));  // across both pins
    // Unknowns: on the coupler the force at B, at C, and the torque along n.
    Columns equations = Columns::Zero(7, 7);
    for (int k = 0; k < 3; ++k) {
      add_force(equations, 0, k, Vector::Unit(k), -half);
      add_force(equations, 0, 3 + k, Vector::Unit(k), half);
    }
    add_torque(equations, 0, 6, n);
    equations(6, 3) = -1;  // on the slider along x
    Eigen::Matrix<Real, 7, 1> right;
    right << coupler_moving.needed(t, g), slider_mass * second_derivative(slider, t).x();
    const Eigen::Matrix<Real, 7, 1> x = equations.partialPivLu().solve(right);
    const Vector F_B = x.head<3>(), F_C = x.segment<3>(3), T = x[6] * n;

    const Sample<3> now = run.sample(i);
    EXPECT_LT((now.position(block.centre()) - C.cast<double>()).norm(), 1e-10);
    EXPECT_LT((now.multiplier(at_B) - F_B.cast<double>()).norm(), promised);
    const Reaction<3> on_slider = reaction(now, cross);
    EXPECT_LT((on_slider.force + F_C.cast<double>()).norm(), promised);
    EXPECT_LT((on_slider.torque + T.cast<double>()).norm(), promised);
    // The guide holds what is left of the slider's weight and of what the coupler does to it.
    const Reaction<3> of_guide = reaction(now, guide);
    const Vector held = F_C - slider_mass * g;
    EXPECT_LT(
        (of_guide.force - Vec<3>(0.0, static_cast<double>(held.y()), static_cast<double>(held.z()))).norm(),
        promised);
    EXPECT_LT((of_guide.torque - T.cast<double>()).norm(), promised);
    // The crank: its motion takes the hinge's force and, about A, its torque with the motor's.
    const Eigen::Matrix<Real, 6, 1> needed = crank_moving.needed(t, g);
    const Vector F_A = needed.head<3>() + F_B, arm = (B - A) / 2;
    const Vector T_A = needed.tail<3>() + arm.cross(F_B) + arm.cross(F_A);
    const Reaction<3> of_hinge = reaction(now, hinge), of_motor = reaction(now, motor);
    EXPECT_LT((of_hinge.force - F_A.cast<double>()).norm(), promised);
    EXPECT_LT((of_hinge.torque + of_motor.torque - T_A.cast<double>()).norm(), promised);
    EXPECT_NEAR(now.multiplier(motor)[0], static_cast<double>(T_A.x()), promised);
    EXPECT_NEAR(now.multiplier(motor)[1],
                now.multiplier(motor)[0] + 0.01 * now.angular_acceleration(armature), promised);
    EXPECT_LT(std::abs(of_hinge.torque.x()), promised);
    EXPECT_LT(of_motor.force.norm(), promised);
  }
}

}  // namespace
}  // namespace dalembert::joints_slider_crank_test
