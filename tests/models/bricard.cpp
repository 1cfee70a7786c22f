#include "dalembert/models/bricard.h"

#include "../equations.h"
#include <dalembert/tests/models/newton.h>

#include <Eigen/SVD>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace dalembert::models::bricard_test {
namespace {

// Four times the integral of da/a' over a quarter of a swing, a' from the conservation of energy, with 50
// digits. (The benchmark's own value, 4.9863086086536, agrees in twelve.)
constexpr double period = 4.98630860865765;

TEST(BricardReference, HasThePublishedPeriod) {
  const Bricard ring;
  // At rest after each period, so a wrong period shows in second order only; half way between rest and
  // rest it shows in first: at period/4 rod 1 points along -z. The speed there is about 2, the last digit
  // 1e-14.
  constexpr double digits = 1e-13;
  EXPECT_NEAR(ring.reference(0.25 * period).positions[0].x(), 0.0, digits);
  EXPECT_NEAR(ring.reference(0.75 * period).positions[0].x(), 0.0, digits);
  EXPECT_NEAR(ring.reference(1.25 * period).positions[0].x(), 0.0, digits);
}

TEST(BricardReference, StartsWithAFifthOfGravity) {
  const Bricard ring;
  // P_2.z = -a at first order
  const double h = 1e-3, a = -ring.reference(h).positions[0].z();
  EXPECT_NEAR(2.0 * a / (h * h), ring.gravity / 5.0, 10.0 * h);
}

TEST(BricardReference, KeepsAllRodsAtLengthOneAndAllAxesAtRightAngles) {
  const Bricard ring;
  for (const double t : {0.3, 1.0, 1.9}) {
    const auto p = ring.reference(t).positions;
    const std::array<Vec<3>, 6> P = {Vec<3>::Zero(), p[0], p[1], p[2], p[3], Vec<3>::UnitZ()};
    std::array<Vec<3>, 5> r;
    for (std::size_t i = 0; i < 5; ++i) {
      r[i] = P[i + 1] - P[i];
      EXPECT_NEAR(r[i].norm(), 1.0, 1e-14);
    }
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(r[i].cross(r[i + 1]).dot(r[i + 1].cross(r[i + 2])), 0.0, 1e-14);
  }
}

// The centre of a uniform rod is in the middle of its ends.
TEST(BricardReference, GroundForceIsMassTimesAccelerationLessGravityOfAllRods) {
  const Bricard ring;
  for (const double t : {0.3, 1.0, 1.9}) {
    Vec<3> ground = 5.0 * ring.mass * ring.gravity * Vec<3>::UnitY();
    double error = 0.0;
    for (const std::size_t joint : {0U, 1U, 2U, 3U}) {  // each shared by two rods
      const auto a = Stencil(ring.model(), t, 2e-3, joint).acceleration();
      ground += ring.mass * a.value;
      error += ring.mass * a.error;
    }
    const Observation<3> seen = ring.reference(t);
    EXPECT_LT((ground - Vec<3>(seen.forces[0], seen.forces[1], seen.forces[2])).norm(), error);
  }
}

TEST(Bricard, HasOneDegreeOfFreedomAndOneRedundantEquation) {
  const BricardScene built = Bricard{}.scene();
  const auto run = simulate(built.scene, {.t_end = 0.1, .samples = 2});
  EXPECT_EQ(run.statistics().degrees_of_freedom, 1);
  EXPECT_EQ(run.statistics().redundant_equations, 1);
}

/// The time next to `t` when rod 1 points along -z.
double passage(Simulation<3>& simulation, const ThinRod<3>& rod, double t) {
  simulation.advance_to(t);
  return t - simulation.position(rod.end()).x() / simulation.velocity(rod.end()).x();
}

/// W of all rows at a sample.
Eigen::MatrixXd constraint_rows(const System& system, const Sample<3>& sample) {
  const FlatSample& flat = sample.flat();
  auto e = system.evaluation();
  system.evaluate({flat.time, flat.q, flat.v}, e);
  return by_rows(system, e.w);
}

// One combination of the rows is zero; a multiplier is determined if its row has no part in it.
TEST(Bricard, ForcesAreMarkedWhereTheyAreNotUnique) {
  const BricardScene built = Bricard{}.scene();
  const System system = built.scene.system();
  const auto run = simulate(built.scene, {.t_end = 3.0, .samples = 4, .tolerance = 1e-8});
  for (std::size_t i = 0; i < run.size(); ++i) {
    const FlatSample flat = run.sample(i).flat();
    const Eigen::MatrixXd W = constraint_rows(system, run.sample(i));
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(W.rowwise().normalized(), Eigen::ComputeFullU);
    const Eigen::VectorXd null = svd.matrixU().rightCols<1>();
    // The other singular values are above 0.1: the null vector is exact to some 10 roundings.
    constexpr double round_off = 1e-14;
    ASSERT_LT(svd.singularValues().tail<1>()[0], round_off);
    for (std::size_t r = 0; r < system.rows(); ++r) {
      const bool unique = flat.unique[r] != 0;
      EXPECT_EQ(unique, std::abs(null[index(r)]) < 1e6 * round_off)
          << system.row_label(r) << " at " << flat.time;
    }
  }
}

// Rod 1 points along -z at a quarter and at three quarters of each period. Next to these instants its end
// moves along x evenly to third order: one Newton step from 1e-4 away is exact to 1e-12.
TEST(Bricard, HasThePublishedPeriod) {
  const Bricard ring;
  const BricardScene built = ring.scene();
  Simulation<3> simulation(built.scene, {.t_end = 2.0 * period, .tolerance = 1e-8});
  const double first = passage(simulation, built.rods[0], 0.25 * period - 1e-4);
  const double second = passage(simulation, built.rods[0], 1.25 * period - 1e-4);
  EXPECT_NEAR(second - first, period, 1e-5 * period);
}

}  // namespace
}  // namespace dalembert::models::bricard_test
