#include "conserved.h"
#include <dalembert/models/elastic_string_circle.h>
#include <dalembert/models/elastic_string_line.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace dalembert::models::elastic_strings_test {
namespace {

using Tied = ElasticStringCircle::Tied;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double no_gravity = 0.0;
constexpr std::array times{0.1, 0.4, 1.3, 4.1};
constexpr double h = 2e-3;

/// The pull of a string of stiffness k and relaxed length l0 from r towards P.
Vec<2> pull(const Vec<2>& P, const Vec<2>& r, double k, double l0) {
  const Vec<2> along = P - r;
  return k * (along.norm() - l0) * along.normalized();
}

/// Kinetic energy of a block and the string's, k (R - l0)^2/2.
Bounded<double> total_energy(const Stencil<2>& block, double mass, const Vec<2>& P, double k, double l0) {
  const auto kinetic = energy(block, mass, no_gravity);
  const double stretch = (P - block.position()).norm() - l0;
  return {kinetic.value + k * stretch * stretch / 2, kinetic.error};
}

TEST(ElasticStringLine, KeepsItsEnergyAndItsForceIsWhatNewtonDemands) {
  const ElasticStringLine string{
      .mass = 0.7, .stiffness = 12.0, .relaxed_length = 0.8, .stretch = 1.3, .amplitude = 1.5};
  const Model<2> model = string.model();
  const Vec<2> P(0.0, -1.3 * 0.8);
  for (const double t : times) {
    const Stencil<2> block(model, t, h, 0);
    const Vec<2> line(0.0, string.reference(t).forces[0]);
    expect_newton<2>(block, 0.7, no_gravity, line + pull(P, block.position(), 12.0, 0.8), model.force);
  }
  expect_constant(
      times, [&](double t) { return total_energy(Stencil<2>(model, t, h, 0), 0.7, P, 12.0, 0.8); },
      model.energy);
}

TEST(ElasticStringCircle, KeepsItsEnergyAndItsForceIsWhatNewtonDemandsWithPOutsideOrInside) {
  for (const Tied tied : {Tied::outside, Tied::inside}) {
    const ElasticStringCircle string{.mass = 0.7,
                                     .stiffness = 12.0,
                                     .relaxed_length = 0.8,
                                     .stretch = 1.3,
                                     .radius = 1.7,
                                     .tied = tied,
                                     .angle = 1.4};
    const Model<2> model = string.model();
    const Vec<2> P(string.distance(), 0.0);
    for (const double t : times) {
      const Stencil<2> block(model, t, h, 0);
      const Vec<2> r = block.position();
      expect_newton<2>(block, 0.7, no_gravity,
                       string.reference(t).forces[0] * r.normalized() + pull(P, r, 12.0, 0.8), model.force);
    }
    expect_constant(
        times, [&](double t) { return total_energy(Stencil<2>(model, t, h, 0), 0.7, P, 12.0, 0.8); },
        model.energy);
  }
}

// mex251, k = 30, l0 = 1: at rest the line or circle holds k l0/2 = 15, by reference and by library.

TEST(ElasticStringLine, HoldsHalfOfStiffnessTimesRelaxedLengthAtRest) {
  const ElasticStringLine string{.stiffness = 30.0, .relaxed_length = 1.0, .amplitude = 0.0};
  EXPECT_NEAR(string.reference(1.0).forces[0], 15.0, 4 * epsilon * 30);
  const BeadOnCurve built = string.scene();
  const Trajectory<2> run = simulate(built.scene, {.t_end = 1.0, .samples = 3});
  for (std::size_t i = 0; i < run.size(); ++i)
    EXPECT_NEAR(run.multiplier(built.curve, i), 15.0, 4 * epsilon * 30);
}

TEST(ElasticStringCircle, HoldsInwardsAtRestIfPIsOutsideAndOutwardsIfInside) {
  for (const auto& [tied, force] : {std::pair{Tied::outside, -15.0}, std::pair{Tied::inside, 15.0}}) {
    const ElasticStringCircle string{.stiffness = 30.0, .relaxed_length = 1.0, .tied = tied, .angle = 0.0};
    EXPECT_NEAR(string.reference(1.0).forces[0], force, 10 * epsilon * 30);
    const BeadOnCurve built = string.scene();
    const Trajectory<2> run = simulate(built.scene, {.t_end = 1.0, .samples = 3});
    for (std::size_t i = 0; i < run.size(); ++i)
      EXPECT_NEAR(run.multiplier(built.curve, i), force, 10 * epsilon * 30);
  }
}

TEST(ElasticStringCircle, DistancesOfPAreThoseOfTheNotes) {
  EXPECT_DOUBLE_EQ(ElasticStringCircle{}.distance(), 2.0 + 1.5);                        // r + 3 l0/2
  EXPECT_DOUBLE_EQ((ElasticStringCircle{.tied = Tied::inside}.distance()), 2.0 - 1.5);  // r - 3 l0/2
}

}  // namespace
}  // namespace dalembert::models::elastic_strings_test
