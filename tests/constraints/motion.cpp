#include "../both_steppers.h"
#include <dalembert/dalembert.h>
#include <dalembert/eigen.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

// What is read of a body's motion, against what was stated and against the closed form of a free top.
namespace dalembert::motion_test {
namespace {

// Sums of four particles' terms of size up to 10, some ten operations each.
constexpr double round_off = 500.0 * std::numeric_limits<double>::epsilon();

const Eigen::Matrix3d turned =
    Eigen::AngleAxisd(0.8, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();

TEST(MotionOfABody, IsWhatWasStatedInSpace) {
  Scene<3> scene;
  const BodyState<3> s{.mass = 3.0,
                       .inertia = {0.9, 1.5, 1.2},
                       .centre = {0.3, -0.2, 0.7},
                       .axes = turned,
                       .velocity = {1.0, 0.5, -2.0},
                       .angular_velocity = {0.6, -1.3, 0.9}};
  const auto body = add_body(scene, s, "body");
  EXPECT_NEAR(body.mass(), s.mass, round_off);
  EXPECT_LT((body.inertia() - s.inertia).norm(), round_off);

  const Simulation<3> at(scene, {.t_end = 1.0});
  const Sample<3> sample = at.sample();
  const Eigen::Matrix3d R = s.axes, I = R * eigen(s.inertia).asDiagonal() * R.transpose();
  const Vec<3> w = s.angular_velocity, L = I * w, about(2.0, 1.0, -1.0);
  EXPECT_LT((angular_velocity(sample, body) - w).norm(), round_off);
  EXPECT_LT((quaternion(sample, body).toRotationMatrix() - s.axes).norm(), round_off);
  EXPECT_GE(quaternion(sample, body).w(), 0.0);
  EXPECT_NEAR(kinetic_energy(sample, body), 0.5 * s.mass * s.velocity.squaredNorm() + 0.5 * w.dot(L),
              round_off);
  EXPECT_LT((momentum(sample, body) - s.mass * s.velocity).norm(), round_off);
  EXPECT_LT((angular_momentum(sample, body) - L).norm(), round_off);
  EXPECT_LT(
      (angular_momentum(sample, body, about) - L - s.mass * (s.centre - about).cross(s.velocity)).norm(),
      round_off);
}

TEST(MotionOfABody, IsWhatWasStatedInThePlane) {
  Scene<2> scene;
  const BodyState<2> s{.mass = 3.0,
                       .inertia = 0.7,
                       .centre = {0.3, -0.2},
                       .angle = 2.5,
                       .velocity = {1.0, 0.5},
                       .angular_velocity = -1.3};
  const auto body = add_body(scene, s, "body");
  EXPECT_NEAR(body.inertia(), s.inertia, round_off);
  const Simulation<2> at(scene, {.t_end = 1.0});
  const Sample<2> sample = at.sample();
  EXPECT_NEAR(angle(sample, body), s.angle, round_off);
  EXPECT_NEAR(angular_velocity(sample, body), s.angular_velocity, round_off);
  EXPECT_NEAR(kinetic_energy(sample, body), 0.5 * 3.0 * 1.25 + 0.5 * 0.7 * 1.69, round_off);
  EXPECT_NEAR(angular_momentum(sample, body), -0.7 * 1.3, round_off);
  // 3 (0.3 * 0.5 + 0.2 * 1.0) = 1.05 of the centre
  EXPECT_NEAR(angular_momentum(sample, body, Vec<2>::Zero()), 1.05 - 0.7 * 1.3, round_off);
}

TEST(MotionOfALamina, IsWhatWasStated) {
  Scene<3> scene;
  const LaminaState s{.mass = 2.0,
                      .inertia = {0.4, 1.1},
                      .axes = turned,
                      .velocity = {1.0, 0.5, -2.0},
                      .angular_velocity = {0.6, -1.3, 0.9}};
  const Lamina plate = add_lamina(scene, s, "plate");
  const Simulation<3> at(scene, {.t_end = 1.0});
  const Vec<3> moments(0.4, 1.1, 1.5);
  const Vec<3> L = s.axes * moments.cwiseProduct(s.axes.transpose() * s.angular_velocity);
  EXPECT_LT((plate.axes(at.sample()) - s.axes).norm(), round_off);
  EXPECT_LT((quaternion(at.sample(), plate).toRotationMatrix() - s.axes).norm(), round_off);
  EXPECT_LT((angular_velocity(at.sample(), plate) - s.angular_velocity).norm(), round_off);
  EXPECT_LT((angular_momentum(at.sample(), plate) - L).norm(), round_off);
  EXPECT_NEAR(kinetic_energy(at.sample(), plate), 5.25 + 0.5 * s.angular_velocity.dot(L), round_off);
  // Euler: I omega' = -omega x L
  const Vec<3> alpha =
      -(s.axes * Vec<3>(s.axes.transpose() * s.angular_velocity.cross(L)).cwiseQuotient(moments));
  EXPECT_LT((angular_acceleration(at.sample(), plate) - alpha).norm(), round_off);
}

// A rod of mass 6 and length 2 has 6 * 4/12 = 2 across.
TEST(MotionOfAThinRod, IsWhatWasStated) {
  Scene<3> scene;
  const auto rod = add_thin_rod<3>(scene,
                                   {.mass = 6.0,
                                    .start = {-1, 0, 0},
                                    .end = {1, 0, 0},
                                    .start_velocity = {0, -1, 2},
                                    .end_velocity = {0, 1, 4}},
                                   "rod");
  const Simulation<3> at(scene, {.t_end = 1.0});
  EXPECT_LT((angular_velocity(at.sample(), rod) - Vec<3>(0.0, -1.0, 1.0)).norm(), round_off);
  EXPECT_LT((angular_momentum(at.sample(), rod) - Vec<3>(0.0, -2.0, 2.0)).norm(), round_off);
  EXPECT_NEAR(kinetic_energy(at.sample(), rod), 0.5 * 6.0 * 9.0 + 0.5 * 2.0 * 2.0, round_off);

  Scene<2> plane;
  const auto bar =
      add_thin_rod<2>(plane, {.mass = 6.0, .start = {0, 0}, .end = {0, 2}, .end_velocity = {-3, 0}}, "bar");
  const Simulation<2> now(plane, {.t_end = 1.0});
  EXPECT_NEAR(angle(now.sample(), bar), 0.5 * M_PI, round_off);
  EXPECT_NEAR(angular_velocity(now.sample(), bar), 1.5, round_off);
}

// Let go with the centre level with a hinge at distance d: alpha = -m g d/(I + m d^2), of a rod -3 g/(2 l).
// Round-off is that of numbers of size 10.
TEST(AngularAcceleration, BeginsAsTheMomentOfTheWeightOverTheInertia) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto body = add_body<2>(scene, {.mass = 3.0, .inertia = 0.7, .centre = {0.4, 0.0}}, "body");
  scene.add(Coincident{Fixed<2>{}, body.point({-0.4, 0.0})}, "hinge");
  const auto rod = add_thin_rod<2>(scene, {.mass = 6.0, .start = {5, 0}, .end = {7, 0}}, "rod");
  scene.add(Coincident{Fixed<2>{{5.0, 0.0}}, rod.start()}, "end");
  const Simulation<2> at(scene, {.t_end = 1.0});
  EXPECT_NEAR(angular_acceleration(at.sample(), body), -3.0 * 9.81 * 0.4 / (0.7 + 3.0 * 0.16),
              10 * round_off);
  EXPECT_NEAR(angular_acceleration(at.sample(), rod), -1.5 * 9.81 / 2.0, 10 * round_off);
}
TEST(AngularAcceleration, IsPerpendicularToARodInSpace) {
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
  const auto rod = add_thin_rod<3>(scene, {.mass = 6.0, .start = {0, 0, 0}, .end = {0, 2, 0}}, "rod");
  scene.add(Coincident{Fixed<3>{}, rod.start()}, "end");
  const Simulation<3> at(scene, {.t_end = 1.0});
  const Vec<3> alpha = angular_acceleration(at.sample(), rod);
  EXPECT_LT((alpha - Vec<3>(-1.5 * 9.81 / 2.0, 0.0, 0.0)).norm(), 10 * round_off);
}

TEST(Motion, RefusesABodyOfAnotherScene) {
  Scene<3> mine, other;
  const BodyState<3> s{.mass = 2.0, .inertia = {0.5, 0.6, 0.7}};
  add_body(other, s, "first");
  const auto body = add_body(other, s, "second");
  mine.add_particle({.mass = 1.0});
  const Simulation<3> at(mine, {.t_end = 1.0});
  EXPECT_THROW((void)kinetic_energy(at.sample(), body), InvalidArgument);
  EXPECT_THROW((void)momentum(at.sample(), body), InvalidArgument);
  EXPECT_THROW((void)angular_momentum(at.sample(), body, {0.0, 0.0, 0.0}), InvalidArgument);
}

/// A free top with moments A, A, C turns about its angular momentum L, which stands still, by |L| t/A, and
/// about its own axis by n t, n = omega_3 (A - C)/A (Landau, Lifshitz, Mechanics, 33):
///
///   R(t) = Rot(L, |L| t/A) R(0) Rot(e_3, n t),   omega(t) = Rot(L, |L| t/A) omega(0)
class FreeTop : public testing::TestWithParam<Stepper> {};
INSTANTIATE_TEST_SUITE_P(Steppers, FreeTop, both_steppers, stepper_name);

TEST_P(FreeTop, TurnsAsItsClosedFormDoes) {
  constexpr double A = 0.5, C = 0.8, tolerance = 1e-10;
  Scene<3> scene;
  const BodyState<3> s{
      .mass = 2.0, .inertia = {A, A, C}, .axes = turned, .angular_velocity = {1.1, -1.3, 1.9}};
  const auto top = add_body(scene, s, "top");
  const auto run =
      simulate(scene, {.t_end = 2.0, .samples = 9, .tolerance = tolerance, .stepper = GetParam()});

  const Vec<3> in_body = s.axes.transpose() * s.angular_velocity;
  const Vec<3> L = s.axes * Vec<3>(A, A, C).cwiseProduct(in_body);
  const double n = in_body.z() * (A - C) / A;
  // Local errors add along the motion, one turn in the length of the run: docs/accuracy.md names factors of
  // about 100.
  constexpr double allowed = 100.0 * tolerance;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i];
    const Eigen::AngleAxisd about_L(L.norm() * t / A, eigen(L).normalized()),
        spin(n * t, Eigen::Vector3d::UnitZ());
    const Sample<3> now = run.sample(i);
    EXPECT_LT((top.axes(now) - about_L.toRotationMatrix() * s.axes * spin.toRotationMatrix()).norm(),
              allowed);
    EXPECT_LT((angular_velocity(now, top) - about_L * s.angular_velocity).norm(), allowed);
    EXPECT_LT((angular_momentum(now, top) - L).norm(), allowed);
    // omega' = (L/A) x omega
    const Vec<3> omega = about_L * s.angular_velocity;
    EXPECT_LT((angular_acceleration(now, top) - (L / A).cross(omega)).norm(), 2.0 * L.norm() / A * allowed);
  }
}

}  // namespace
}  // namespace dalembert::motion_test
