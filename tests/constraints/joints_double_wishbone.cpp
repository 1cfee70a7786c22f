#include "../both_steppers.h"
#include "newton_euler.h"
#include <dalembert/dalembert.h>
#include <dalembert/eigen.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

// A double wishbone: two arms hinged to the chassis along skew axes carry an upright by ball joints, a tie
// rod steers it, a spring stands on the lower arm, which a motor moves. The angle theta of the lower arm is
// given; that of the upper one, psi, and the turn chi of the upright about the line of its balls follow from
// the two lengths
//
//   |U(psi) - L(theta)| = |U_0 - L_0|,   |S(chi) - T| = |S_0 - T|,
//
// each by Newton's iteration. Three bodies' 18 equations give the 18 forces and torques.
namespace dalembert::joints_double_wishbone_test {
namespace {

using namespace newton_euler;

const Vector P1(0, 0.35L, 0.2L), d1 = Vector(1, 0.05L, 0.02L).normalized(), L0(0.02L, 0.8L, 0.18L);
const Vector P2(-0.03L, 0.4L, 0.5L), d2 = Vector(1, -0.08L, 0.06L).normalized(), U0(-0.02L, 0.74L, 0.52L);
const Vector S0(-0.15L, 0.78L, 0.25L), T(-0.14L, 0.38L, 0.24L);                      // tie rod
const Vector D0 = P1 + 0.6L * (L0 - P1) + Vector(0, 0, 0.02L), top(0, 0.55L, 0.7L);  // spring
const Vector hub(0, 0.82L, 0.35L), g(0, 0, -9.81L);
constexpr double stiffness = 3e4, relaxed = 0.5;

constexpr auto theta = [](const auto& t) {
  using std::sin;
  return 0.2 * sin(2.0 * t) + 0.05 * sin(5.0 * t);
};

Matrix about(const Vector& axis, Real angle) {
  return Eigen::AngleAxis<Real>(angle, axis).toRotationMatrix();
}

/// A root of f near 0, simple; the secant method to the last digit.
template <class F>
Real root(const F& f) {
  Real a = -0.01L, b = 0.01L, f_a = f(a), f_b = f(b);
  for (int i = 0; i < 30 && f_b != f_a && std::abs(f_b) > 1e-19L; ++i) {
    const Real c = b - f_b * (b - a) / (f_b - f_a);
    a = b, f_a = f_b, b = c, f_b = f(c);
  }
  return b;
}

/// The axes of the upright with its balls at L and U, turned about their line by chi.
Matrix upright_axes(const Vector& L, const Vector& U, Real chi) {
  const Vector e = (U - L).normalized(), n = (Vector::UnitX() - e.x() * e).normalized();
  Matrix axes;
  axes << n, e.cross(n), e;
  return about(e, chi) * axes;
}

struct Pose {
  Real psi;
  Vector L, U, S;
  Matrix lower, upper, upright;  // rotations from the start

  explicit Pose(Real t) {
    lower = about(d1, theta(t));
    L = P1 + lower * (L0 - P1);
    psi = root([&](Real p) { return (P2 + about(d2, p) * (U0 - P2) - L).norm() - (U0 - L0).norm(); });
    upper = about(d2, psi);
    U = P2 + upper * (U0 - P2);
    const Matrix stated = upright_axes(L0, U0, 0).transpose();
    const Real chi = root([&](Real x) {
      return (L + upright_axes(L, U, x) * stated * (S0 - L0) - T).norm() - (S0 - T).norm();
    });
    upright = upright_axes(L, U, chi) * stated;
    S = L + upright * (S0 - L0);
  }
};

/// What a test needs of a body: stated in double precision, moving in extended.
struct Part {
  double mass;
  Vec<3> inertia;
  Vector centre;  // at the start
  [[nodiscard]] BodyState<3> state() const {
    return {.mass = mass, .inertia = inertia, .centre = centre.cast<double>()};
  }
  [[nodiscard]] Matrix moments() const { return eigen(inertia.cast<Real>()).asDiagonal(); }
};
const Part lower_part{6.0, {0.05, 0.02, 0.06}, (P1 + L0) / 2},
    upper_part{4.0, {0.03, 0.015, 0.04}, (P2 + U0) / 2}, upright_part{25.0, {0.6, 0.9, 0.7}, hub};

class DoubleWishbone : public testing::TestWithParam<Stepper> {};
INSTANTIATE_TEST_SUITE_P(Steppers, DoubleWishbone, both_steppers, stepper_name);

TEST_P(DoubleWishbone, HasTheForcesOfNewtonAndEuler) {
  const auto place = [](const Vector& r) { return Vec<3>(r.cast<double>()); };
  Scene<3> scene;
  scene.add(UniformGravity<3>{place(g)});
  const auto lower = add_body(scene, lower_part.state(), "lower arm");
  const auto upper = add_body(scene, upper_part.state(), "upper arm");
  const auto upright = add_body(scene, upright_part.state(), "upright");
  const auto hinge1 = add_joint(scene, Revolute{Ground<3>{}, lower, place(P1), place(d1)}, "lower hinge");
  const auto hinge2 = add_joint(scene, Revolute{Ground<3>{}, upper, place(P2), place(d2)}, "upper hinge");
  const auto ball1 = scene.add(Coincident{lower.point_at(place(L0)), upright.point_at(place(L0))}, "L");
  const auto ball2 = scene.add(Coincident{upper.point_at(place(U0)), upright.point_at(place(U0))}, "U");
  const auto tie = scene.add(
      Distance{Fixed<3>{place(T)}, upright.point_at(place(S0)), static_cast<double>((S0 - T).norm())}, "tie");
  scene.add(Spring{Fixed<3>{place(top)}, lower.point_at(place(D0)), stiffness, relaxed});
  const auto motor = add_joint(scene, AngleDrive{hinge1, scene.add_rotor({.inertia = 0.01}), theta}, "motor");
  const auto run = simulate(
      scene, {.t_end = 2.0, .samples = 9, .tolerance = 1e-10, .stepper = GetParam(), .assemble = true});
  ASSERT_EQ(run.statistics().degrees_of_freedom, 0);
  ASSERT_EQ(run.statistics().redundant_equations, 0);

  const Body bodies[] = {{lower_part.mass, lower_part.moments(),
                          [](Real t) { return Vector(P1 + Pose(t).lower * (lower_part.centre - P1)); },
                          [](Real t) { return Pose(t).lower; }},
                         {upper_part.mass, upper_part.moments(),
                          [](Real t) { return Vector(P2 + Pose(t).upper * (upper_part.centre - P2)); },
                          [](Real t) { return Pose(t).upper; }},
                         {upright_part.mass, upright_part.moments(),
                          [](Real t) {
                            const Pose p(t);
                            return Vector(p.L + p.upright * (hub - L0));
                          },
                          [](Real t) { return Pose(t).upright; }}};
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Real t = run.times()[i];
    const Pose pose(t);
    Vector c[3];
    Columns A = Columns::Zero(18, 18);
    Eigen::Matrix<Real, 18, 1> right;
    for (int k = 0; k < 3; ++k) {
      c[k] = bodies[k].centre(t);
      right.segment<6>(6 * k) = bodies[k].needed(t, g);
    }
    const Vector u1 = d1.unitOrthogonal(), u2 = d2.unitOrthogonal();
    for (int k = 0; k < 3; ++k) {
      const Vector e = Vector::Unit(k);
      add_force(A, 0, k, e, P1 - c[0]);
      add_force(A, 1, 6 + k, e, P2 - c[1]);
      add_force(A, 2, 11 + k, e, pose.L - c[2]);
      add_force(A, 0, 11 + k, -e, pose.L - c[0]);
      add_force(A, 2, 14 + k, e, pose.U - c[2]);
      add_force(A, 1, 14 + k, -e, pose.U - c[1]);
    }
    add_torque(A, 0, 3, u1);
    add_torque(A, 0, 4, d1.cross(u1));
    add_torque(A, 0, 5, d1);  // the motor
    add_torque(A, 1, 9, u2);
    add_torque(A, 1, 10, d2.cross(u2));
    add_force(A, 2, 17, (pose.S - T).normalized(), pose.S - c[2]);
    const Vector D = P1 + pose.lower * (D0 - P1), along = (top - D).normalized();
    const Vector of_spring = stiffness * ((top - D).norm() - relaxed) * along;
    right.head<3>() -= of_spring;
    right.segment<3>(3) -= (D - c[0]).cross(of_spring);
    const Eigen::Matrix<Real, 18, 1> x = A.fullPivLu().solve(right);

    constexpr double promised = 1e-8 * 2000.0;  // of forces of some 1000 to 5000
    const Sample<3> now = run.sample(i);
    const auto force = [&x](int first) { return Vec<3>(x.segment<3>(first).cast<double>()); };
    const Vector torque1 = x[3] * u1 + x[4] * d1.cross(u1), torque2 = x[9] * u2 + x[10] * d2.cross(u2);
    EXPECT_NEAR(angle(now, hinge2), static_cast<double>(pose.psi), 1e-10);
    EXPECT_LT((now.position(upright.point_at(place(hub))) - place(c[2])).norm(), 1e-10);
    EXPECT_LT((reaction(now, hinge1).force - force(0)).norm(), promised);
    EXPECT_LT((reaction(now, hinge1).torque - torque1.cast<double>()).norm(), promised);
    EXPECT_LT((reaction(now, hinge2).force - force(6)).norm(), promised);
    EXPECT_LT((reaction(now, hinge2).torque - torque2.cast<double>()).norm(), promised);
    EXPECT_LT((now.multiplier(ball1) - force(11)).norm(), promised);
    EXPECT_LT((now.multiplier(ball2) - force(14)).norm(), promised);
    EXPECT_NEAR(now.multiplier(tie), static_cast<double>(x[17]), promised);
    EXPECT_NEAR(now.multiplier(motor)[0], static_cast<double>(x[5]), promised);
  }
}

}  // namespace
}  // namespace dalembert::joints_double_wishbone_test
