#include <dalembert/dalembert.h>
#include <dalembert/eigen.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

/// What somebody writes who has Eigen in all of his code: that it compiles is the test.
namespace someone_with_eigen {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d, Eigen::Quaterniond;

TEST(EigenUsers, StateScenesAndReadResultsInTheirOwnVectors) {
  dalembert::Scene<3> scene;
  const Vector3d hook(0.0, 0.0, 1.0), down = -Vector3d::UnitZ();
  const Quaterniond turned(Eigen::AngleAxisd(0.5, Vector3d(1.0, 2.0, 3.0).normalized()));
  scene.add(dalembert::UniformGravity<3>{9.81 * down});
  const auto bob =
      scene.add_particle({.mass = 2.0, .position = hook + 0.5 * down, .velocity = Vector3d(0.1, 0.0, 0.0)});
  const auto rod = scene.add(dalembert::Distance{dalembert::Fixed<3>{hook}, bob, 0.5});
  const auto body = dalembert::add_body<3>(scene,
                                           {.mass = 1.0,
                                            .inertia = {0.1, 0.2, 0.25},
                                            .centre = turned * Vector3d::UnitX(),
                                            .axes = turned.toRotationMatrix()},
                                           "body");
  const auto corner = body.point(Vector3d(0.1, 0.2, 0.3));
  const Vector3d n = turned * Vector3d::UnitX();
  const Matrix3d R = turned.toRotationMatrix();
  const auto slope =
      scene.add(dalembert::holonomic(dalembert::points(corner),
                                     [n, d = 1.1 * n.dot(n)](const auto& r) { return r.dot(n) - d; }),
                "slope");
  scene.add(dalembert::potential(dalembert::points(corner, bob), [R, hook](const auto& r, const auto& s) {
    const auto e = (R * (r - hook)).eval();
    return 0.5 * e.squaredNorm() + 0.1 * s.dot(hook) * e.cross(s - hook).norm();
  }));
  scene.add(dalembert::force_law(dalembert::points(bob), [R, down](const auto&, const auto& v) {
    return (-0.1 * (R * v) + 0.01 * down).eval();
  }));

  const dalembert::Simulation<3> now(scene, {.t_end = 1.0});
  Vector3d r = now.position(bob), f = now.constraint_force(rod, bob);
  const Vector3d offset = r - hook, moved = now.position(corner) + hook - 2.0 * r;
  EXPECT_NEAR(offset.norm(), 0.5, 1e-12);
  EXPECT_NEAR((r - now.position(bob)).norm(), 0.0, 0.0);
  EXPECT_NEAR(offset.cross(f).norm(), 0.0, 1e-12);
  EXPECT_NEAR(hook.dot(r), now.position(bob).dot(hook), 1e-15);
  EXPECT_GT(moved.norm(), 0.0);
  EXPECT_LT((Matrix3d(body.axes(now.sample())) - R).norm(), 1e-12);
  const Quaterniond attitude = quaternion(now.sample(), body);
  EXPECT_LT(attitude.angularDistance(turned), 1e-12);
  EXPECT_LT((attitude * now.position(bob) - R * r).norm(), 1e-12);
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.linear() = R;
  place.translation() = r;
  EXPECT_LT((place * now.position(bob) - (R * r + r)).norm(), 1e-12);
  Matrix3d columns;
  columns << now.position(bob), now.velocity(bob), hook;
  EXPECT_EQ(Vector3d(columns.col(1)), Vector3d(0.1, 0.0, 0.0));
  const Eigen::AngleAxisd about(0.3, eigen(now.position(bob)).normalized());
  EXPECT_NEAR(about.axis().norm(), 1.0, 1e-15);
  r += now.position(bob);
  f = 2.0 * now.constraint_force(rod, bob);
  const Eigen::VectorXd all = now.position(bob);
  EXPECT_EQ(all.size(), 3);
  EXPECT_TRUE(Vector3d(now.position(bob)).isApprox(0.5 * r));
  (void)slope;
}

/// One particle that a constraint holds where `distance` is 0, as far as it says.
template <class F>
double residual(const F& distance) {
  dalembert::Scene<3> scene;
  const auto r = scene.add_particle({.mass = 1.0, .position = {1.0, 2.0, 3.0}});
  scene.add(dalembert::holonomic(dalembert::points(r), distance), "rule");
  const dalembert::System system = scene.system();
  auto e = system.evaluation();
  system.evaluate({0.0, scene.initial_positions(), scene.initial_velocities()}, e);
  return e.g[0];
}

TEST(EigenUsers, KeepWhatTheyTakeOfASum) {
  const Vector3d n(0.0, 0.6, 0.8), p(1.0, 1.0, 1.0);
  EXPECT_DOUBLE_EQ(residual([n, p](auto r) {
                     const auto g = n.transpose() * (r - p);
                     return g - 1.0;
                   }),
                   0.6 + 1.6 - 1.0);
  EXPECT_DOUBLE_EQ(residual([p](auto r) {
                     auto h = (r - p).template head<2>();
                     const auto& z = (r - p).z();
                     return h.squaredNorm() + z;
                   }),
                   3.0);
  EXPECT_DOUBLE_EQ(residual([p](auto r) {
                     const auto row = (r - p).transpose();
                     const auto P = (r - p) * (r - p).transpose();
                     return P(2, 1) + row.sum();
                   }),
                   5.0);
  EXPECT_DOUBLE_EQ(residual([p](auto r) {
                     const auto w = (r - p).cwiseProduct(r);
                     return sqrt(w.sum() + 1.0) + (0.5 * (r.transpose() * r)).value();
                   }),
                   3.0 + 7.0);
}

TEST(EigenUsers, MultiplyAVectorByItsOwnComponent) {
  EXPECT_DOUBLE_EQ(residual([](auto r) {
                     r *= r.y();
                     auto s = r;
                     s /= s.x();
                     return r.sum() + s.sum();
                   }),
                   12.0 + 6.0);
}

TEST(EigenUsers, ChooseBetweenVectors) {
  EXPECT_DOUBLE_EQ(residual([hook = dalembert::Vec<3>(1.0, 0.0, 0.0)](auto r) {
                     const auto s = r.x() > 5.0 ? r : hook;
                     return s.sum();
                   }),
                   1.0);
}

}  // namespace someone_with_eigen
