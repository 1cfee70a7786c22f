#include "dalembert/constraints/bodies/thin_rod.h"

#include <dalembert/constraints/coincident.h>
#include <dalembert/solvers/simulation.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace dalembert::thin_rod_test {
namespace {

constexpr double round_off = 20.0 * std::numeric_limits<double>::epsilon();  // a few operations

TEST(ThinRod, HasItsEndsItsMassAndTheEnergyOfAUniformRod) {
  Scene<3> scene;
  const ThinRodState<3> s{.mass = 3.0,
                          .start = {0.2, -0.1, 0.5},
                          .end = {1.2, 0.9, -0.2},
                          .start_velocity = {1.0, 0.0, 2.0},
                          .end_velocity = {-1.0, 2.0, 2.0}};
  const ThinRod<3> rod = add_thin_rod(scene, s, "rod");
  const auto q = scene.initial_positions(), v = scene.initial_velocities();
  EXPECT_LT((rod.start().gather(q) - s.start).norm(), round_off);
  EXPECT_LT((rod.end().gather(q) - s.end).norm(), round_off);
  EXPECT_LT((rod.point(0.25).gather(v) - (0.75 * s.start_velocity + 0.25 * s.end_velocity)).norm(),
            round_off);
  // m/6 (v^2 + v . v~ + v~^2)
  const Vec<3> a = s.start_velocity, b = s.end_velocity;
  const double T = s.mass / 6.0 * (a.squaredNorm() + a.dot(b) + b.squaredNorm());
  EXPECT_NEAR(scene.system().kinetic_energy(v), T, 10.0 * round_off);
}

// Released from horizontal, pinned at one end: alpha = m g (l/2)/(m l^2/3) = 3 g/(2 l), so the centre falls
// with 3/4 g and the pin carries a quarter of the weight.
TEST(ThinRod, PinCarriesAQuarterOfTheWeightReleasedFromHorizontal) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto rod = add_thin_rod<2>(scene, {.mass = 2.0, .start = {1.0, 0.5}, .end = {2.5, 0.5}}, "rod");
  const auto pin = scene.add(Coincident{Fixed<2>{{1.0, 0.5}}, rod.start()});
  const auto run = simulate(scene, {.t_end = 1e-3, .samples = 2});
  EXPECT_LT((run.multiplier(pin, 0) - Vec<2>(0.0, 2.0 * 9.81 / 4.0)).norm(), 100.0 * round_off);
}

TEST(ThinRod, SaysWhatIsWrong) {
  const auto fault = [](const ThinRodState<2>& state) -> std::string {
    Scene<2> scene;
    try {
      (void)add_thin_rod(scene, state, "bar");
    } catch (const InvalidScene& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(fault({.mass = 0.0, .end = {1.0, 0.0}}).find("\"bar\": mass"), std::string::npos);
  EXPECT_NE(fault({.mass = 1.0}).find("ends"), std::string::npos);
  EXPECT_NE(fault({.mass = 1.0, .end = {NAN, 0.0}}).find("ends"), std::string::npos);
}

}  // namespace
}  // namespace dalembert::thin_rod_test
