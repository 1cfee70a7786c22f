#include <dalembert/dalembert.h>

#include <gtest/gtest.h>

#include <limits>

namespace dalembert::virtual_work_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// Work and power are sums of at most four products of recovered forces; the KKT solve behind them is
// well conditioned here, so 100 units of round-off of force times speed bound both.
constexpr double operations = 100.0;

TEST(VirtualWork, FindsNoVirtualWorkAndNoPowerInIdealScleronomicConstraints) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto a = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  const auto b = scene.add_particle({.mass = 2.0, .position = {2.0, 0.0}});
  scene.add(Distance{Fixed<2>{}, a, 1.0});
  scene.add(Distance{a, b, 1.0});
  const auto run = simulate(scene, {.t_end = 2.0, .samples = 21});
  for (std::size_t i = 0; i < run.size(); ++i) {
    const VirtualWork at = virtual_work(scene, run.sample(i));
    const double force = at.largest_force;
    const double speed = run.velocity(a, i).norm() + run.velocity(b, i).norm();
    EXPECT_LE(at.largest, operations * epsilon * force);
    for (const auto& constraint : at.constraints) {
      EXPECT_LE(std::abs(constraint.power), operations * epsilon * force * speed) << constraint.name;
    }
  }
}

// A bead on a wire that turns at omega, r = r0 cosh(omega t): the wire's force 2 m omega r' acts at
// right angles to it, and its power 2 m omega^2 r r' is the growth of m (r'^2 + omega^2 r^2)/2.
TEST(VirtualWork, FindsThePowerThatADrivenWirePutsIn) {
  const double omega = 1.5;
  Scene<2> scene;
  const auto bead = scene.add_particle({.mass = 2.0, .position = {1.0, 0.0}, .velocity = {0.0, omega}});
  scene.add(PointLineDistance{bead, Fixed<2>{},
                              driven([omega](auto t) { return vec(cos(omega * t), sin(omega * t)); }), 0.0},
            "wire");
  const auto run = simulate(scene, {.t_end = 1.0, .samples = 2, .tolerance = 1e-10});
  const VirtualWork at = virtual_work(scene, run.sample(1));
  const double r = std::cosh(omega);
  const double rate = omega * std::sinh(omega);
  EXPECT_EQ(at.constraints[0].name, "PointLineDistance \"wire\"");
  // The run errs by at most about a thousand times its tolerance over this growth by cosh(1.5).
  EXPECT_NEAR(at.constraints[0].power, 2.0 * 2.0 * omega * omega * r * rate, 1e-7 * at.constraints[0].power);
  EXPECT_LE(at.largest, operations * epsilon * at.largest_force);
}

TEST(VirtualWork, NamesThePowerOfEachForce) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -10.0}});
  const auto p = scene.add_particle({.mass = 2.0, .position = {3.0, 0.0}, .velocity = {1.0, -1.0}});
  scene.add(Spring{Fixed<2>{}, p, 4.0, 1.0}, "spring");
  scene.add(LinearDrag{p, 0.5}, "air");
  const VirtualWork at = virtual_work(scene, Simulation<2>(scene, {.t_end = 1.0}).sample());
  ASSERT_EQ(at.forces.size(), 3U);
  EXPECT_EQ(at.forces[0].power, 20.0);  // m g . v = 2 (-10) (-1)
  EXPECT_EQ(at.forces[1].power, -8.0);  // -4 (3 - 1) along x, times 1
  EXPECT_EQ(at.forces[2].power, -1.0);  // -0.5 |v|^2
  EXPECT_EQ(at.forces[1].name, "Spring \"spring\"");
}

TEST(VirtualWork, OfAnotherScenesSampleIsRefused) {
  Scene<2> small, large;
  small.add_particle({.mass = 1.0});
  for (int i = 0; i < 3; ++i) large.add_particle({.mass = 1.0});
  const Simulation<2> run(small, {.t_end = 1.0});
  EXPECT_THROW((void)virtual_work(large, run.sample()), InvalidArgument);
}

}  // namespace
}  // namespace dalembert::virtual_work_test
