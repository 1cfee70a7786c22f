#include "../equations.h"
#include <dalembert/constraints/coincident.h>
#include <dalembert/constraints/compliant.h>
#include <dalembert/constraints/distance.h>
#include <dalembert/constraints/nonholonomic.h>
#include <dalembert/core/scene/scene.h>
#include <dalembert/solvers/ida/newton_matrix.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace dalembert::newton_matrix_test {
namespace {

/// The Jacobian of (R1, R2, R3, R4) in (q, v, lambda, mu) with q' = c q + ..., v' = c v + ..., block
/// by block as in the header of NewtonMatrix, at mu = 0. Its blocks come from System, which other
/// tests compare with finite differences.
Eigen::MatrixXd full_jacobian(const System& system, const State& at, const Eigen::VectorXd& lambda,
                              double c) {
  const Eigen::Index n = index(system.coordinates()), m = index(system.rows()),
                     h = index(system.holonomic_rows());
  const Values now = values(system, at);
  const Derivatives d = derivatives(system, at, lambda);
  const Eigen::MatrixXd G = now.W.topRows(h);
  const Eigen::MatrixXd M = vector(system.masses()).asDiagonal();
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(2 * n + m + h, 2 * n + m + h);
  J.block(0, 0, n, n) = -c * M;
  J.block(0, n, n, n) = M;
  J.block(0, 2 * n + m, n, h) = G.transpose();
  J.block(n, 0, n, n) = d.stiffness;
  J.block(n, n, n, n) = d.damping - c * M;
  J.block(n, 2 * n, n, m) = now.W.transpose() + d.friction;
  J.block(2 * n, 0, m, n) = d.psi_q;
  J.block(2 * n, n, m, n) = now.W;
  J.block(2 * n + m, 0, h, n) = G;
  Eigen::VectorXd C(static_cast<Eigen::Index>(system.rows()));
  for (std::size_t r = 0; r < system.rows(); ++r) C[static_cast<Eigen::Index>(r)] = system.law(r).compliance;
  J.block(2 * n, 2 * n, m, m) = c * C.asDiagonal();
  J.block(2 * n + m, 2 * n, h, h) = C.head(h).asDiagonal();
  return J;
}

/// A chain of three particles in space with rods, springs and a driven end.
System::Evaluation equations(const System& system, const Instant& at) {
  auto e = system.evaluation();
  system.evaluate(at, e);
  return e;
}

class NewtonMatrixTest : public testing::Test {
 protected:
  Scene<3> scene;
  Particle<3> a = scene.add_particle({.mass = 1.0});
  Particle<3> b = scene.add_particle({.mass = 2.0});
  Particle<3> c = scene.add_particle({.mass = 0.5});
  double rate = 50.0;  // IDA's c

  NewtonMatrixTest() {
    scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
    scene.add(Distance{driven([](auto t) { return vec(sin(t), 0.0, t * t); }), a, 1.0});
    scene.add(Distance{a, b, 1.0});
    scene.add(Spring{b, c, 2000.0, 0.5});
    scene.add(Spring{Fixed<3>{}, c, 30.0});
  }
  void add_damping_and_nonholonomic_rows() {
    scene.add(Damper{a, c, 40.0});
    scene.add(
        nonholonomic(points(c), [](auto t, auto r, auto v) { return v.y() - (r.x() + sin(t)) * v.x(); }));
    scene.add(nonholonomic(points(a, b),
                           [](auto r_a, auto, auto v_a, auto v_b) { return v_b.z() - r_a.y() * v_a.x(); }));
  }

  /// Friction that reads a rod's and a blade's multiplier, on other particles too.
  void add_friction() {
    const auto rod = scene.add(Distance{Fixed<3>{}, b, 1.0});
    const auto blade = scene.add(nonholonomic(points(c), [](auto, auto v) { return v.y() - v.x(); }));
    scene.add(friction_law(rod, points(a, b), [](auto lambda, auto r_a, auto, auto v_a, auto v_b) {
      return std::tuple{(-0.3 * abs(lambda) * v_a).eval(), (0.2 * lambda * v_b * r_a.x()).eval()};
    }));
    scene.add(friction_law(blade, points(c), [](auto lambda, auto, auto v) {
      return (-0.5 * abs(lambda) * v.normalized()).eval();
    }));
  }

  State state{0.4, (Eigen::VectorXd(9) << 0.8, -0.5, 1.3, 0.4, 0.9, -0.7, 1.1, 0.2, -0.3).finished(),
              (Eigen::VectorXd(9) << -0.3, 1.2, 0.7, 0.9, -1.1, 0.5, 0.6, -0.4, 1.3).finished()};

  /// Corrections of the sizes that Newton's iteration has: c dq ~ dv, and dlambda ~ c dv.
  [[nodiscard]] Eigen::VectorXd correction(const System& system) const {
    const Eigen::Index n = index(system.coordinates()), m = index(system.rows()),
                       h = index(system.holonomic_rows());
    Eigen::VectorXd x(2 * n + m + h);
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = std::sin(1.0 + 3.7 * static_cast<double>(i));
    x.head(n) /= rate;
    x.segment(2 * n, m) *= rate;
    return x;
  }

  /// b = J x is formed in long sums and solved by two eliminations: the result is x up to round-off
  /// times the number of unknowns times the condition of J, rows and columns scaled to what they measure.
  void expect_solves(bool with_mu) {
    const System system = scene.system();
    const Eigen::Index n = index(system.coordinates()), m = index(system.rows()),
                       h = index(system.holonomic_rows());
    const Eigen::VectorXd lambda = 10.0 * correction(system).segment(0, m);
    const Eigen::MatrixXd J = full_jacobian(system, state, lambda, rate);
    Eigen::VectorXd x = correction(system);
    if (!with_mu) x.tail(h).setZero();

    Eigen::VectorXd columns = Eigen::VectorXd::Ones(J.cols()), rows = Eigen::VectorXd::Ones(J.rows());
    columns.head(n).setConstant(1.0 / rate);
    columns.segment(2 * n, m).setConstant(rate);
    rows.segment(n, n).setConstant(1.0 / rate);
    rows.tail(h).setConstant(rate);
    const Eigen::MatrixXd scaled = rows.asDiagonal() * J * columns.asDiagonal();
    const Eigen::VectorXd singular = scaled.jacobiSvd().singularValues();
    const double condition = singular[0] / singular[singular.size() - 1];
    ASSERT_LT(condition, 1e5) << "the state is too close to singular to test anything";
    const double bound = static_cast<double>(J.rows()) * std::numeric_limits<double>::epsilon() * condition;

    NewtonMatrix newton(Problem(system), all_rows(system), 1.0);
    ASSERT_TRUE(newton.factorise(state.instant(), equations(system, state.instant()),
                                 {lambda.data(), static_cast<std::size_t>(m)}, rate));
    Eigen::VectorXd found = J * x;
    const Eigen::VectorXd dense = J.fullPivLu().solve(found);
    newton.solve(rate, {found.data(), static_cast<std::size_t>(found.size())});
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      EXPECT_NEAR(found[i] / columns[i], dense[i] / columns[i],
                  bound * (x.array() / columns.array()).matrix().norm())
          << "unknown " << i;
    }
  }
};

TEST_F(NewtonMatrixTest, SolvesTheFullSystemWithStiffnessAndAnyMu) { expect_solves(true); }

TEST_F(NewtonMatrixTest, SolvesTheFullSystemWithDampingAndNonholonomicRowsIfMuStaysZero) {
  add_damping_and_nonholonomic_rows();
  expect_solves(false);
}

TEST_F(NewtonMatrixTest, SolvesTheFullSystemWithFrictionIfMuStaysZero) {
  add_friction();
  expect_solves(false);
}

// What a solve leaves is of order |psi_q| / c |W|, about 1/50 as for compliant rows, here not squared: the
// second pass knows dmu but for psi_q dq.
TEST_F(NewtonMatrixTest, ConvergesToTheFullSystemWithFrictionAndAnyMu) {
  Scene<3> own;
  const auto p = own.add_particle({.mass = 1.0});
  const auto q = own.add_particle({.mass = 2.0});
  const auto rod = own.add(Distance{Fixed<3>{}, p, 1.0});
  own.add(Distance{p, q, 1.0});
  own.add(friction_law(rod, points(p, q), [](auto lambda, auto, auto, auto v_p, auto v_q) {
    return std::tuple{(-0.3 * abs(lambda) * v_p).eval(), (0.2 * lambda * v_q).eval()};
  }));
  const System system = own.system();
  state.q = (Eigen::VectorXd(6) << 0.8, -0.5, 1.3, 0.4, 0.9, -0.7).finished();
  state.v = (Eigen::VectorXd(6) << -0.3, 1.2, 0.7, 0.9, -1.1, 0.5).finished();
  const Eigen::VectorXd lambda = Eigen::Vector2d(5.0, -3.0);
  const Eigen::MatrixXd J = full_jacobian(system, state, lambda, rate);
  const Eigen::VectorXd x = correction(system), b = J * x;
  NewtonMatrix newton(Problem(system), all_rows(system), 1.0);
  ASSERT_TRUE(
      newton.factorise(state.instant(), equations(system, state.instant()), {lambda.data(), 2}, rate));
  EXPECT_FALSE(newton.soft());
  Eigen::VectorXd found = Eigen::VectorXd::Zero(x.size());
  double left = x.norm();
  for (int i = 0; i < 5; ++i) {
    Eigen::VectorXd correction = b - J * found;
    newton.solve(rate, {correction.data(), static_cast<std::size_t>(correction.size())});
    found += correction;
    const double now = (x - found).norm();
    EXPECT_LT(now, std::max(0.1 * left, 1e-9 * x.norm())) << "solve " << i;
    left = now;
  }
}

// The neglected terms are there to be neglected: with them the two solutions differ.
TEST_F(NewtonMatrixTest, NeglectsWhatMultipliesMuAndNothingElse) {
  add_damping_and_nonholonomic_rows();
  const System system = scene.system();
  const Eigen::VectorXd lambda = Eigen::VectorXd::Ones(index(system.rows()));
  Eigen::VectorXd x = correction(system);
  Eigen::VectorXd found = full_jacobian(system, state, lambda, rate) * x;
  NewtonMatrix newton(Problem(system), all_rows(system), 1.0);
  ASSERT_TRUE(newton.factorise(state.instant(), equations(system, state.instant()),
                               {lambda.data(), system.rows()}, rate));
  newton.solve(rate, {found.data(), static_cast<std::size_t>(found.size())});
  EXPECT_GT((found - x).norm(), 1e-3 * x.norm());
}

// Each solve leaves a part (|psi_q| / c |W|)^2 of the error, about (1/50)^2; solving again for what is
// left converges to the dense solution, whether the compliance is large or small against 1/(c^2 m).
TEST_F(NewtonMatrixTest, ConvergesToTheFullSystemWithCompliantRows) {
  for (const double compliance : {1e-9, 1e-4, 1.0}) {
    Scene<3> own;
    const auto p = own.add_particle({.mass = 1.0});
    const auto q = own.add_particle({.mass = 2.0});
    own.add(compliant(Distance{Fixed<3>{}, p, 1.0}, compliance));
    own.add(Distance{p, q, 1.0});
    const System system = own.system();
    state.q = (Eigen::VectorXd(6) << 0.8, -0.5, 1.3, 0.4, 0.9, -0.7).finished();
    state.v = (Eigen::VectorXd(6) << -0.3, 1.2, 0.7, 0.9, -1.1, 0.5).finished();
    const Eigen::VectorXd lambda = Eigen::Vector2d(5.0, -3.0);
    const Eigen::MatrixXd J = full_jacobian(system, state, lambda, rate);
    const Eigen::VectorXd x = correction(system), b = J * x;
    NewtonMatrix newton(Problem(system), all_rows(system), 1.0);
    ASSERT_TRUE(
        newton.factorise(state.instant(), equations(system, state.instant()), {lambda.data(), 2}, rate));
    Eigen::VectorXd found = Eigen::VectorXd::Zero(x.size());
    double left = x.norm();
    for (int i = 0; i < 5; ++i) {
      Eigen::VectorXd correction = b - J * found;
      newton.solve(rate, {correction.data(), static_cast<std::size_t>(correction.size())});
      found += correction;
      const double now = (x - found).norm();
      EXPECT_LT(now, std::max(0.05 * left, 1e-9 * x.norm()))
          << "compliance " << compliance << ", solve " << i;
      left = now;
    }
  }
}

// Spring and damper are stiff at this rate: c^2 m = 5000, c m = 100.
TEST_F(NewtonMatrixTest, SolvesWithoutConstraints) {
  Scene<3> free;
  const auto p = free.add_particle({.mass = 2.0});
  free.add(Spring{Fixed<3>{}, p, 3000.0, 0.2});
  free.add(Damper{Fixed<3>{{1.0, 1.0, 1.0}}, p, 300.0});
  scene = std::move(free);
  state.q = Eigen::Vector3d(0.8, -0.5, 1.3);
  state.v = Eigen::Vector3d(0.1, 0.2, 0.3);
  expect_solves(true);
}

}  // namespace
}  // namespace dalembert::newton_matrix_test
