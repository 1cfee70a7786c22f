#include "../equations.h"
#include <dalembert/constraints/distance.h>
#include <dalembert/constraints/holonomic.h>
#include <dalembert/constraints/nonholonomic.h>
#include <dalembert/constraints/on_surface.h>
#include <dalembert/core/scene/scene.h>
#include <dalembert/solvers/manifold/manifold.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace dalembert::manifold_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Two particles in space of unlike mass: a rod between them, one on a sphere, one with a blade.
System two_particles() {
  Scene<3> scene;
  const auto a = scene.add_particle({.mass = 1.0});
  const auto b = scene.add_particle({.mass = 3.0});
  scene.add(nonholonomic(points(b), [](auto t, auto r, auto v) { return v.y() - (r.x() + t) * v.x(); }));
  scene.add(Distance{a, b, 1.5});
  scene.add(OnSurface{a, Sphere<3>{{0.0, 0.0, 0.0}, 1.0}});
  scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
  scene.add(Spring{a, b, 7.0, 1.0});
  scene.add(Damper{Fixed<3>{{0.0, 0.0, 5.0}}, b, 0.5});
  return scene.system();
}

std::vector<double> ones(const System& system) { return std::vector<double>(system.coordinates(), 1.0); }

class ManifoldTest : public testing::Test {
 protected:
  System system = two_particles();
  ActiveRows rows{{0, 1, 2}, 2};
  State state{0.4, (Eigen::VectorXd(6) << 0.8, -0.5, 0.4, 1.4, 0.9, -0.7).finished(),
              (Eigen::VectorXd(6) << -0.3, 1.2, 0.7, 0.9, -1.1, 0.5).finished()};
  Eigen::VectorXd acceleration = Eigen::VectorXd::Zero(6), lambda = Eigen::VectorXd::Zero(3);

  static std::span<double> span(Eigen::VectorXd& x) { return {x.data(), static_cast<std::size_t>(x.size())}; }

  Violation project(Manifold& manifold) {
    return manifold.project_positions(state.t, span(state.q), span(state.v), 1e-15);
  }
  bool solve(Manifold& manifold) {
    return manifold.solve_motion(state.t, span(state.q), span(state.v), span(acceleration), span(lambda));
  }
};

/// What is left of W x + c = 0, or of a row of M v' - F - W^T lambda = 0, after a backward stable
/// solution with 9 unknowns of size 100 at most.
constexpr double round_off = 9.0 * 16.0 * epsilon * 100.0;

TEST_F(ManifoldTest, ProjectionSatisfiesEveryHolonomicConstraint) {
  Manifold manifold(Problem(system), rows, ones(system));
  const Violation left = project(manifold);
  // A residual of round-off: a norm of numbers of size 2, in about ten operations.
  EXPECT_LE(left.size, 10.0 * 2.0 * epsilon);
  EXPECT_LE(values(system, state).g.cwiseAbs().maxCoeff(), 10.0 * 2.0 * epsilon);
}

TEST_F(ManifoldTest, ProjectionIgnoresNonholonomicRows) {
  State before = state;
  Scene<3> blade;
  const auto p = blade.add_particle({.mass = 1.0});
  blade.add(nonholonomic(points(p), [](auto, auto v) { return v.y(); }));
  const System only = blade.system();
  Manifold manifold(Problem(only), {{0}, 0}, ones(only));
  Eigen::VectorXd q = before.q.head(3), v = before.v.head(3);
  EXPECT_EQ(manifold.project_positions(0.0, span(q), span(v), 1e-15).size, 0.0);
  EXPECT_EQ(q, before.q.head(3));
}

// v - v0 = M^-1 W^T y and W v + psi(v = 0) = 0: the least change of v in the mass-weighted norm.
TEST_F(ManifoldTest, VelocitiesChangeByTheLeastImpulseThatSatisfiesTheConstraints) {
  Manifold manifold(Problem(system), rows, ones(system));
  (void)project(manifold);
  const Eigen::VectorXd v0 = state.v;
  ASSERT_TRUE(solve(manifold));
  const Values now = values(system, state);
  EXPECT_LE(now.psi.cwiseAbs().maxCoeff(), round_off);
  const Eigen::VectorXd impulse = masses(system) * (state.v - v0);
  const Eigen::VectorXd y = now.W.transpose().colPivHouseholderQr().solve(impulse);
  EXPECT_LE((now.W.transpose() * y - impulse).norm(), round_off) << "not in the space of constraint forces";
}

TEST_F(ManifoldTest, AccelerationsAndMultipliersSolveTheEquationsOfMotion) {
  Manifold manifold(Problem(system), rows, ones(system));
  (void)project(manifold);
  ASSERT_TRUE(solve(manifold));
  const Values now = values(system, state);
  EXPECT_LE((masses(system) * acceleration - now.F - now.W.transpose() * lambda).norm(), round_off);
  EXPECT_LE((now.W * acceleration + now.gamma).norm(), round_off);
}

TEST_F(ManifoldTest, ViolationsAreDistancesAndSpeeds) {
  Scene<2> line;
  const auto p = line.add_particle({.mass = 1.0});
  line.add(holonomic(points(p), [](auto r) { return 10.0 * (r.y() - 1.0); }));
  line.add(holonomic(points(p), [](auto r) { return r.x() - 0.5; }));
  const System two = line.system();
  auto e = two.evaluation();
  const State s{0.0, Eigen::Vector2d(0.0, 0.75), Eigen::Vector2d(3.0, 4.0)};
  two.evaluate(s.instant(), e);
  EXPECT_EQ(position_violation(two, e, ones(two)).size, 0.5);
  EXPECT_EQ(position_violation(two, e, ones(two)).row, 1);
  EXPECT_EQ(velocity_violation(two, e, ones(two)).size, 4.0);
  EXPECT_EQ(velocity_violation(two, e, ones(two)).row, 0);
}

}  // namespace
}  // namespace dalembert::manifold_test
