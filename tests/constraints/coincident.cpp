#include "dalembert/constraints/coincident.h"

#include "../equations.h"
#include <dalembert/constraints/distance.h>
#include <dalembert/core/errors.h>
#include <dalembert/solvers/simulation.h>

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dalembert::coincident_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double round_off = 16.0 * std::numeric_limits<double>::epsilon();

TEST(Coincident, ResidualsGradientAndBiasAreThoseByHand) {
  Scene<2> scene;
  const auto a = scene.add_particle({.mass = 1.0});
  const auto b = scene.add_particle({.mass = 1.0});
  scene.add(Coincident{a, b});
  const Values now = values(scene.system(),
                            {0.0, Eigen::Vector4d(1.0, 2.0, 4.0, 7.0), Eigen::Vector4d(0.0, -1.0, 1.0, 1.0)});
  EXPECT_EQ(now.g, Eigen::Vector2d(3.0, 5.0));
  EXPECT_EQ(now.psi, Eigen::Vector2d(1.0, 2.0));
  EXPECT_EQ(now.gamma, Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(now.W, (Eigen::Matrix<double, 2, 4>() << -1, 0, 1, 0, 0, -1, 0, 1).finished());
}

// b hangs from a fixed point: the multipliers are the force on b, its weight upwards.
TEST(Coincident, MultipliersAreTheForceOnTheSecondPoint) {
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -10.0}});
  const auto b = scene.add_particle({.mass = 2.0, .position = {1.0, 2.0, 3.0}});
  const auto pin = scene.add(Coincident{Fixed<3>{{1.0, 2.0, 3.0}}, b});
  const Simulation<3> simulation(scene, {.t_end = 1.0});
  EXPECT_LE((simulation.multiplier(pin) - Vec<3>(0.0, 0.0, 20.0)).norm(), 20.0 * round_off);
  EXPECT_EQ(simulation.constraint_force(pin, b), simulation.multiplier(pin));
}

// Two particles pinned together, 1 kg and 3 kg, pulled by a force of 8 on the second: both
// accelerate at 2; the pin exerts 2 on the first and -2 on the second.
TEST(Coincident, PassesOnAForce) {
  Scene<2> scene;
  const auto a = scene.add_particle({.mass = 1.0});
  const auto b = scene.add_particle({.mass = 3.0});
  scene.add(force_law(points(b), [](auto r, auto) {
    using S = typename decltype(r)::Scalar;
    return VecOf<S, 2>{S(8.0), S(0.0)};
  }));
  const auto pin = scene.add(Coincident{a, b});
  const Simulation<2> simulation(scene, {.t_end = 1.0});
  EXPECT_LE((simulation.constraint_force(pin, a) - Vec<2>(2.0, 0.0)).norm(), 8.0 * round_off);
  EXPECT_LE((simulation.constraint_force(pin, b) + Vec<2>(2.0, 0.0)).norm(), 8.0 * round_off);
}

// Pinned to (t^2, 0), 3 kg need the force 6 along x; positions and velocities are those of the path.
TEST(Coincident, CarriesAParticleAlongADrivenPath) {
  Scene<2> scene;
  const auto load = scene.add_particle({.mass = 3.0});
  const auto pin = scene.add(Coincident{driven([](auto t) { return vec(t * t, 0.0); }), load});
  const auto run = simulate(scene, {.t_end = 2.0, .samples = 3});
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i];
    EXPECT_LE((run.position(load, i) - Vec<2>(t * t, 0.0)).norm(), 4.0 * round_off);
    EXPECT_LE((run.velocity(load, i) - Vec<2>(2.0 * t, 0.0)).norm(), 4.0 * round_off);
    EXPECT_LE((run.constraint_force(pin, load, i) - Vec<2>(6.0, 0.0)).norm(), 6.0 * round_off);
  }
}

/// Of r - r nothing is left, whatever the scene is redundant in besides.
TEST(Coincident, OfOneParticleTwiceIsNamed) {
  for (const bool redundant : {false, true}) {
    Scene<2> scene;
    const auto a = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
    scene.add(Coincident{a, a}, "pin");
    if (redundant)
      for (int i = 0; i < 2; ++i) scene.add(Distance{Fixed<2>{}, a, 1.0});
    EXPECT_THAT([&] { (void)simulate(scene, {.t_end = 1.0}); },
                ThrowsMessage<InconsistentStart>(
                    AllOf(HasSubstr("Coincident \"pin\""), HasSubstr("same point twice"))));
  }
}

}  // namespace
}  // namespace dalembert::coincident_test
