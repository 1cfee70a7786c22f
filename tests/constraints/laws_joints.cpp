#include "laws_joints.h"

#include <dalembert/eigen.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <utility>

namespace dalembert::laws {

namespace {

/// Two bodies in general position, turning.
Bodies<3> add_bodies(Scene<3>& scene, const Placement<3>& at) {
  const auto turned = [&at](double angle, const Vec<3>& axis) {
    return Eigen::Matrix3d(at.turn * Eigen::AngleAxisd(angle, eigen(axis.normalized())).toRotationMatrix());
  };
  return {add_body<3>(scene,
                      {.mass = 2.0,
                       .inertia = {0.7, 0.9, 1.1},
                       .centre = at.point(0.4, -0.3, 0.2),
                       .axes = turned(0.8, {1.0, -2.0, 0.5})},
                      "A"),
          add_body<3>(scene,
                      {.mass = 3.0,
                       .inertia = {1.5, 0.8, 1.0},
                       .centre = at.point(-0.5, 0.9, 0.6),
                       .axes = turned(-1.9, {0.3, 1.0, 1.4})},
                      "B")};
}
Bodies<2> add_bodies(Scene<2>& scene, const Placement<2>& at) {
  const double turn = std::atan2(at.turn(1, 0), at.turn(0, 0));
  return {add_body<2>(scene,
                      {.mass = 2.0, .inertia = 0.7, .centre = at.point(0.4, -0.3), .angle = turn + 0.8}, "A"),
          add_body<2>(
              scene, {.mass = 3.0, .inertia = 1.5, .centre = at.point(-0.5, 0.9), .angle = turn - 1.9}, "B")};
}

}  // namespace

template <int D>
Built<D>::Built(const Case<D>& c, const Placement<D>& at)
    : bodies(add_bodies(scene, at)), system((c.add(scene, at, bodies), scene.system())) {}

namespace {

Eigen::VectorXd noise(Eigen::Index n, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  return Eigen::VectorXd::NullaryExpr(n, [&](Eigen::Index) { return uniform(random); });
}

}  // namespace

template <int D>
State stated(const Built<D>& built) {
  const auto q = built.scene.initial_positions();
  const Eigen::Index n = index(q.size());
  State s{0.0, vector(q), noise(n, 1.0, 7)};
  const Values now = values(built.system, s);
  s.v -= now.W.completeOrthogonalDecomposition().solve(now.psi);
  return s;
}
namespace {

template <int D>
State near_it(const Built<D>& built) {
  State s = stated(built);
  s.q += noise(s.q.size(), 0.01, 11);
  s.v = noise(s.v.size(), 1.0, 13);
  return s;
}

}  // namespace

template <int D>
void expect_derivatives(const Case<D>& c) {
  const Built<D> built(c);
  expect_consistent(built.system, near_it(built), noise(index(built.system.rows()), 2.0, 17));
}

namespace {

template <int D>
void expect_same_bits(const Case<D>& c) {
  const Built<D> one(c), two(c);
  const State s = near_it(one);
  const Values first = values(one.system, s), again = values(two.system, s);
  EXPECT_EQ(first.g, again.g);
  EXPECT_EQ(first.gamma, again.gamma);
  EXPECT_EQ(first.W, again.W);
}

/// Rows may mix among themselves, and a torque may come as different forces on the particles of a body, whose
/// rods take the difference. Compared are what is left for rigid bodies: the space of forces P W^T W P, P the
/// projector onto their motions, and the least accelerations that satisfy all rows.
template <int D>
struct OfRigidBodies {
  Eigen::MatrixXd forces;
  Eigen::VectorXd accelerations;

  OfRigidBodies(const Values& now, Eigen::Index rods) {
    const auto n = now.W.cols();
    const Eigen::MatrixXd R = now.W.topRows(rods);
    const Eigen::MatrixXd P = Eigen::MatrixXd::Identity(n, n) - R.completeOrthogonalDecomposition().solve(R);
    const Eigen::MatrixXd joint = now.W.bottomRows(now.W.rows() - rods) * P;
    forces = joint.transpose() * joint;
    accelerations = now.W.completeOrthogonalDecomposition().solve(-now.gamma);
  }
};

template <int D>
void expect_no_preferred_place(const Case<D>& c) {
  const Placement<D> there = laws::elsewhere<D>();
  const Built<D> here(c), moved(c, there);
  State s = stated(here), t = s;
  Eigen::MatrixXd turn = Eigen::MatrixXd::Identity(s.q.size(), s.q.size());  // rotors stay as they are
  for (const auto& body : here.bodies) {
    for (const auto& particle : body.particles) {
      const Eigen::Index p = particle.coordinate;
      turn.block<D, D>(p, p) = there.turn;
      t.q.segment<D>(p) = there.turn * s.q.segment<D>(p) + eigen(there.shift);
      t.v.segment<D>(p) = there.turn * s.v.segment<D>(p);
    }
  }
  const Values a = values(here.system, s), b = values(moved.system, t);
  const OfRigidBodies<D> at_rest(a, 2 * RigidBody<D>::rod_count), elsewhere(b, 2 * RigidBody<D>::rod_count);
  // Some 100 roundings of numbers up to 10, magnified by derivatives of size up to 10.
  constexpr double round_off = 1e4 * std::numeric_limits<double>::epsilon();
  EXPECT_LT(a.g.norm(), round_off);
  EXPECT_LT(b.g.norm(), round_off);
  EXPECT_LT(b.psi.norm(), round_off);
  EXPECT_LT((elsewhere.accelerations - turn * at_rest.accelerations).norm(), round_off);
  EXPECT_LT((elsewhere.forces - turn * at_rest.forces * turn.transpose()).norm(), round_off);
}

/// A state moved along the joint's degrees of freedom by a random way, of length about 1, and projected back
/// onto its manifold.
template <int D>
State moved_on(const Built<D>& built, State s, unsigned seed, double length = 1.0) {
  const Eigen::VectorXd way = noise(s.q.size(), length, seed);
  for (int step = 0; step < 40; ++step) {
    const Eigen::MatrixXd W = values(built.system, s).W;
    const auto rows = W.completeOrthogonalDecomposition();
    s.q += 0.025 * (way - rows.solve(W * way));
    for (int newton = 0; newton < 6; ++newton) {  // quadratic: below round-off
      const Values now = values(built.system, s);
      s.q -= now.W.completeOrthogonalDecomposition().solve(now.g);
    }
  }
  return s;
}

}  // namespace

template <int D>
void expect_action_is_reaction(const Case<D>& c) {
  const Built<D> built(c);
  // (Not so far that the centres of gears without hinges meet.)
  const State s = moved_on(built, stated(built), 29, 0.3);
  const Eigen::VectorXd lambda = noise(index(built.system.rows()), 2.0, 19);
  const Eigen::VectorXd Z = values(built.system, s).W.transpose() * lambda;
  Vec<D> force = Vec<D>::Zero();
  auto moment = detail::moment(force, force);
  for (const auto& body : built.bodies) {
    for (const auto& p : body.particles) {
      force += Z.segment<D>(p.coordinate);
      moment += detail::moment(Vec<D>(s.q.segment<D>(p.coordinate)), Vec<D>(Z.segment<D>(p.coordinate)));
    }
  }
  constexpr double round_off = 1e3 * std::numeric_limits<double>::epsilon();  // as above
  EXPECT_LT(force.norm(), round_off);
  if constexpr (D == 2) {
    EXPECT_LT(std::abs(moment), round_off);
  } else {
    EXPECT_LT(moment.norm(), round_off);
  }
}

namespace {

/// Each row removes one degree of freedom, where it starts and where a random way takes it: rows of unit
/// length that lose less than two digits together.
template <int D>
void expect_independent_rows(const Case<D>& c) {
  const Built<D> built(c);
  State s = stated(built);
  for (unsigned leg = 0; leg < 6; ++leg) {
    const Values now = values(built.system, s);
    const Eigen::MatrixXd W = now.W.rowwise().normalized();
    EXPECT_EQ(W.rows(), c.rows + 2 * RigidBody<D>::rod_count);
    EXPECT_LT(now.g.norm(), 1e-12);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> gram(W * W.transpose(), Eigen::EigenvaluesOnly);
    EXPECT_GT(gram.eigenvalues().minCoeff(), 0.01 * 0.01) << leg;  // squares of W's singular values
    s = moved_on(built, s, 23 + leg);
  }
}

}  // namespace

template <int D>
void register_case(const std::string& law, const Case<D>& c, void (*check)(const Case<D>&)) {
  register_test("EveryJoint", law + "/" + c.name + (D == 2 ? "InThePlane" : ""), [=] { check(c); });
}

template <int D>
void register_laws(const Case<D>& c) {
  register_case<D>("DifferentiatesItsEquation", c, expect_derivatives<D>);
  register_case<D>("GivesTheSameBitsTwice", c, expect_same_bits<D>);
  register_case<D>("DoesNotDependOnThePlace", c, expect_no_preferred_place<D>);
  register_case<D>("HasIndependentRows", c, expect_independent_rows<D>);
}

template struct Built<2>;
template struct Built<3>;
template State stated(const Built<2>&);
template State stated(const Built<3>&);
template void expect_derivatives(const Case<2>&);
template void expect_derivatives(const Case<3>&);
template void expect_action_is_reaction(const Case<2>&);
template void expect_action_is_reaction(const Case<3>&);
template void register_case(const std::string&, const Case<2>&, void (*)(const Case<2>&));
template void register_case(const std::string&, const Case<3>&, void (*)(const Case<3>&));
template void register_laws(const Case<2>&);
template void register_laws(const Case<3>&);

}  // namespace dalembert::laws
