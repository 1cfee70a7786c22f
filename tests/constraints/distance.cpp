#include "dalembert/constraints/distance.h"

#include "../equations.h"
#include <dalembert/solvers/simulation.h>

#include <Eigen/Core>
#include <gmock/gmock.h>

namespace dalembert::distance_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double round_off = 16.0 * std::numeric_limits<double>::epsilon();

// a = (1, 1), b = (4, 5): |b - a| = 5, g = 5 - 3, e = (3, 4)/5. With v_b - v_a = (1, 2):
// psi = (3 + 8)/5, gamma = (|v|^2 - psi^2)/5 = (5 - 4.84)/5.
TEST(Distance, ResidualsGradientAndBiasAreThoseByHand) {
  Scene<2> scene;
  const auto a = scene.add_particle({.mass = 1.0});
  const auto b = scene.add_particle({.mass = 1.0});
  scene.add(Distance{a, b, 3.0});
  const Values now = values(scene.system(),
                            {0.0, Eigen::Vector4d(1.0, 1.0, 4.0, 5.0), Eigen::Vector4d(0.0, -1.0, 1.0, 1.0)});
  EXPECT_DOUBLE_EQ(now.g[0], 2.0);
  EXPECT_NEAR(now.psi[0], 2.2, round_off);
  EXPECT_NEAR(now.gamma[0], 0.032, round_off);
  EXPECT_TRUE(now.W.row(0).transpose().isApprox(Eigen::Vector4d(-0.6, -0.8, 0.6, 0.8), round_off));
}

TEST(Distance, TensionOfAHangingBobIsItsWeight) {
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 2.0, .position = {0.0, 0.0, -1.5}});
  const auto rod = scene.add(Distance{Fixed<3>{}, bob, 1.5});
  const Simulation<3> simulation(scene, {.t_end = 1.0});
  EXPECT_NEAR(-simulation.multiplier(rod), 19.62, 19.62 * round_off);
  EXPECT_TRUE(simulation.constraint_force(rod, bob).isApprox(Vec<3>(0.0, 0.0, 19.62), round_off));
}

// A bob on top of a rod: the rod pushes, lambda = +m g.
TEST(Distance, AStrutIsCompressed) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -10.0}});
  const auto bob = scene.add_particle({.mass = 2.0, .position = {0.0, 1.0}});
  const auto rod = scene.add(Distance{Fixed<2>{}, bob, 1.0});
  EXPECT_NEAR(Simulation<2>(scene, {.t_end = 1.0}).multiplier(rod), 20.0, 20.0 * round_off);
}

// A free dumbbell, 1 kg at either end of 2 m, turning at 3 rad/s: m omega^2 r = 9 on each, inwards.
TEST(Distance, TensionOfASpinningDumbbellIsCentripetal) {
  Scene<2> scene;
  const auto a = scene.add_particle({.mass = 1.0, .position = {-1.0, 0.0}, .velocity = {0.0, -3.0}});
  const auto b = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}, .velocity = {0.0, 3.0}});
  const auto rod = scene.add(Distance{a, b, 2.0});
  const Simulation<2> simulation(scene, {.t_end = 1.0});
  EXPECT_NEAR(-simulation.multiplier(rod), 9.0, 9.0 * round_off);
  EXPECT_LE((simulation.constraint_force(rod, a) - Vec<2>(9.0, 0.0)).norm(), 9.0 * round_off);
  EXPECT_LE((simulation.constraint_force(rod, b) + Vec<2>(9.0, 0.0)).norm(), 9.0 * round_off);
}

// A driven end that accelerates at 2 along the rod drags 3 kg after it with 6.
TEST(Distance, ADrivenEndDragsItsLoad) {
  Scene<2> scene;
  const auto load = scene.add_particle({.mass = 3.0, .position = {-1.0, 0.0}});
  const auto rod = scene.add(Distance{load, driven([](auto t) { return vec(t * t, 0.0); }), 1.0});
  EXPECT_NEAR(-Simulation<2>(scene, {.t_end = 1.0}).multiplier(rod), 6.0, 6.0 * round_off);
}

TEST(Distance, RefusesALengthThatIsNotFiniteAndPositive) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double length : {0.0, -1.0, infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
    Scene<2> scene;
    const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
    EXPECT_THAT(
        [&] {
          scene.add(Distance{Fixed<2>{}, bob, length}, "upper rod");
        },
        ThrowsMessage<InvalidScene>(AllOf(HasSubstr("Distance \"upper rod\""), HasSubstr("length = "),
                                          HasSubstr("finite and > 0"), HasSubstr("use Coincident"))))
        << length;
  }
}

// In nanometres and smaller the value must still be one.
TEST(Distance, AWrongLengthIsQuotedWithItsDigits) {
  EXPECT_THAT((Distance{Fixed<2>{}, Particle<2>{}, -2.5e-9}.fault()), HasSubstr("-2.5e-09"));
}

TEST(Distance, CoincidentPointsAreNamed) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  scene.add(Distance{Fixed<2>{{1.0, 0.0}}, bob, 1.0}, "rod");
  for (const bool assemble : {false, true}) {
    EXPECT_THAT([&] { (void)simulate(scene, {.t_end = 1.0, .assemble = assemble}); },
                ThrowsMessage<InconsistentStart>(AllOf(HasSubstr("Distance \"rod\""), HasSubstr("coincide"),
                                                       HasSubstr("use Coincident"))));
  }
}

}  // namespace
}  // namespace dalembert::distance_test
