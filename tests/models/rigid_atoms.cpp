#include "dalembert/models/rigid_atoms.h"

#include <dalembert/eigen.h>
#include <dalembert/models/error.h>
#include <dalembert/tests/models/newton.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <gtest/gtest.h>

#include <cmath>

namespace dalembert::models::rigid_atoms_test {
namespace {

/// Errors grow by about the tolerance per step and, at the speed of turning, in proportion to time.
constexpr double error_per_tolerance = 1e3;

RigidAtoms with(int atoms) {
  RigidAtoms body;
  body.atoms = atoms;
  return body;
}

TEST(RigidAtomsReference, ForceIsMassTimesAcceleration) {
  const RigidAtoms body;
  for (const double t : {0.4, 2.1, 5.3}) {
    const Observation<3> seen = body.reference(t);
    for (const std::size_t atom : {0U, 3U, 6U}) {
      const Bounded<Vec<3>> Z =
          force_by_newton(Stencil(body.model(), t, 5e-3, atom), body.mass / body.atoms, 0.0);
      const Vec<3> expected = Vec<3>::from(seen.forces.data() + 3 * atom);
      EXPECT_LT((Z.value - expected).norm(), Z.error);
    }
  }
}

TEST(RigidAtomsReference, ConservesEnergyAndAngularMomentum) {
  const RigidAtoms body;
  const double m = body.mass / body.atoms;
  const Vec<3> L0 = body.inertia() * body.angular_velocity;
  for (const double t : {0.4, 2.1, 5.3}) {
    Bounded<double> T{0.0, 0.0};
    Bounded<Vec<3>> L{Vec<3>::Zero(), 0.0};
    for (std::size_t i = 0; i < static_cast<std::size_t>(body.atoms); ++i) {
      const Stencil<3> atom(body.model(), t, 5e-3, i);
      const auto v = atom.velocity();
      const auto E = energy(atom, m, 0.0);
      T.value += E.value;
      T.error += E.error;
      L.value += m * atom.position().cross(v.value);
      L.error += m * atom.position().norm() * v.error;
    }
    EXPECT_NEAR(T.value, body.model().energy, T.error);
    EXPECT_LT((L.value - L0).norm(), L.error);
  }
}

// A symmetric top turns about L at the rate |L|/I_1 while it turns about its own axis at w_3 (1 - I_3/I_1).
TEST(RigidAtomsReference, IsTheClosedFormForASymmetricTop) {
  RigidAtoms body;
  body.semi_axes = {0.8, 0.8, 0.5};
  const Vec<3> w = body.angular_velocity, I = eigen(body.inertia()).diagonal(), L = I.cwiseProduct(w);
  for (const double t : {0.7, 3.0, 10.0}) {
    const Eigen::AngleAxisd about_L(L.norm() / I.x() * t, eigen(L).normalized());
    const Eigen::AngleAxisd about_axis(w.z() * (1.0 - I.z() / I.x()) * t, Eigen::Vector3d::UnitZ());
    const Observation<3> seen = body.reference(t);
    for (std::size_t i = 0; i < seen.positions.size(); ++i)
      EXPECT_LT((seen.positions[i] - about_L * (about_axis * body.places()[i])).norm(), 1e-13);
  }
}

class RigidBodyOfAtoms : public ::testing::TestWithParam<std::pair<int, double>> {};

TEST_P(RigidBodyOfAtoms, HasSixDegreesOfFreedomAndMovesAsEulerSays) {
  const auto [atoms, tolerance] = GetParam();
  const RigidAtoms body = with(atoms);
  const Measurement run = measure(body.model(), {.t_end = 5.0, .samples = 11, .tolerance = tolerance});
  EXPECT_LT(run.error_position, error_per_tolerance * tolerance);
  EXPECT_LT(run.error_force, 10.0 * error_per_tolerance * tolerance);
  EXPECT_LT(run.energy_drift, error_per_tolerance * tolerance);
  EXPECT_EQ(run.statistics.degrees_of_freedom, 6);
}

// Of all ways to give every atom its force, the bonds do it with the least sum of squares.
TEST_P(RigidBodyOfAtoms, BondsCarryTheLeastForces) {
  const auto [atoms, tolerance] = GetParam();
  const RigidAtoms body = with(atoms);
  const BoundAtoms<3> built = body.scene();
  const auto run = simulate(built.scene, {.t_end = 1.0, .samples = 3, .tolerance = tolerance});
  const auto bonds = static_cast<Eigen::Index>(built.bonds.size());
  for (std::size_t i = 0; i < run.size(); ++i) {
    Eigen::MatrixXd along = Eigen::MatrixXd::Zero(3 * atoms, bonds);
    Eigen::VectorXd force(3 * atoms), carried(bonds);
    Eigen::Index bond = 0;
    for (int a = 0; a < atoms; ++a) {
      force.segment<3>(3 * a) = eigen(run.constraint_force(built.atoms[static_cast<std::size_t>(a)], i));
      for (int b = a + 1; b < atoms; ++b, ++bond) {
        const Vec<3> e = (run.position(built.atoms[static_cast<std::size_t>(b)], i) -
                          run.position(built.atoms[static_cast<std::size_t>(a)], i))
                             .normalized();
        along.block<3, 1>(3 * b, bond) = eigen(e);
        along.block<3, 1>(3 * a, bond) = -eigen(e);
        carried[bond] = run.multiplier(built.bonds[static_cast<std::size_t>(bond)], i);
        EXPECT_EQ(run.sample(i).is_unique(built.bonds[static_cast<std::size_t>(bond)]), atoms == 4);
      }
    }
    // The geometry is that of a rigid body to about 1e-13, which a threshold of 1e-9 takes for exact.
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> least;
    least.setThreshold(1e-9);
    least.compute(along);
    EXPECT_EQ(least.rank(), 3 * atoms - 6);
    EXPECT_LT((carried - least.solve(force)).norm(), 1e-9 * force.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, RigidBodyOfAtoms,
                         ::testing::Values(std::pair{4, 1e-6}, std::pair{4, 1e-10}, std::pair{8, 1e-6},
                                           std::pair{8, 1e-10}, std::pair{20, 1e-6}, std::pair{20, 1e-10}));

// In the plane a body of N atoms moves with its centre and turns at a constant rate.
TEST(RigidBodyOfAtoms, HasThreeDegreesOfFreedomInThePlane) {
  const double rate = 2.0, tolerance = 1e-8;
  const Vec<2> drift(0.3, -0.1);
  for (const int atoms : {3, 4, 8}) {
    std::vector<ParticleState<2>> states;
    for (const Vec<3>& s : with(atoms).places()) {
      const Vec<2> r(s.x(), s.y());
      states.push_back({1.0, r, drift + rate * Vec<2>(-r.y(), r.x())});
    }
    const BoundAtoms<2> built = bind<2>("plane body", states);
    const auto run = simulate(built.scene, {.t_end = 5.0, .samples = 11, .tolerance = tolerance});
    EXPECT_EQ(run.statistics().degrees_of_freedom, 3);
    for (std::size_t i = 0; i < run.size(); ++i) {
      const double t = run.times()[i];
      const Eigen::Rotation2Dd turned(rate * t);
      for (std::size_t k = 0; k < states.size(); ++k) {
        const Vec<2> arm = turned * states[k].position;
        EXPECT_LT((run.position(built.atoms[k], i) - drift * t - arm).norm(),
                  error_per_tolerance * tolerance);
        EXPECT_LT((run.constraint_force(built.atoms[k], i) + rate * rate * arm).norm(),
                  10.0 * error_per_tolerance * tolerance);
      }
    }
  }
}

}  // namespace
}  // namespace dalembert::models::rigid_atoms_test
