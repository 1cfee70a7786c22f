#include <dalembert/dalembert.h>
#include <dalembert/models/whipple_bicycle.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace dalembert::steady_branches_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double g = 9.81;

std::vector<double> parameters(const auto& points) {
  std::vector<double> all;
  for (const auto& point : points) all.push_back(point.parameter);
  std::ranges::sort(all);
  return all;
}

TEST(SteadyBranches, TellTheBicyclesWeaveAndCapsizeSpeeds) {
  // As printed, table 2: eigenvalues are round-off of terms of order 1e3 and cross 0 with slopes of 0.2 and
  // more, whatever the step. On the way from rest two real ones become the weave.
  for (const double step : {0.1, 0.5}) {
    const auto diagram = follow_steady<3>(
        [](double v) { return PosedSteady<3>{models::WhippleBicycle{.speed = v}.scene().scene}; },
        {.from = 0.0, .to = 10.0, .step = step});
    EXPECT_THAT(parameters(diagram.flutters),
                testing::ElementsAre(testing::DoubleNear(4.29238253634111, 1e-9)));
    EXPECT_THAT(parameters(diagram.bifurcations),
                testing::ElementsAre(testing::DoubleNear(6.02426201538837, 1e-9)));
    ASSERT_EQ(diagram.branches.size(), 1U);
    EXPECT_EQ(diagram.branches[0].end, BranchEnd::range);
    EXPECT_EQ(diagram.branches[0].why, "");
    EXPECT_GT(diagram.flutters.at(0).frequency, 3.0);
  }
}

/// A disk that rolls upright: m, A about a diameter, C about its axis, r.
struct Disk {
  double m = 2.0, A = 0.2, C = 0.3, r = 0.5;

  [[nodiscard]] Scene<3> scene(double spin) const {
    Scene<3> scene("disk");
    scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
    const auto body = add_body(scene,
                               {.mass = m,
                                .inertia = {A, C, A},
                                .centre = {0.0, 0.0, r},
                                .velocity = {spin * r, 0.0, 0.0},
                                .angular_velocity = {0.0, spin, 0.0}},
                               "disk");
    const auto a = body.point({r, 0.0, 0.0}), b = body.point({0.0, 0.0, r});
    scene.add(DiskContact{body.centre(), a, b, r});
    scene.add(DiskRolling{body.centre(), a, b, r});
    return scene;
  }
  /// Of its lean t, with the rate of turning p: (A + m r^2) t'' = m g r t + (C + m r^2) spin p and
  /// A p' = -C spin t': (A + m r^2) omega^2 = C (C + m r^2) spin^2/A - m g r.
  [[nodiscard]] double square(double spin) const {
    return (C * (C + m * r * r) * spin * spin / A - m * g * r) / (A + m * r * r);
  }
  [[nodiscard]] double critical() const { return std::sqrt(m * g * r * A / (C * (C + m * r * r))); }
};

TEST(SteadyBranches, TellTheRollingDisksCriticalSpin) {
  const Disk disk;
  const auto diagram = follow_steady<3>([&](double spin) { return PosedSteady<3>{disk.scene(spin)}; },
                                        {.from = 1.0, .to = 4.0, .step = 0.1});
  EXPECT_THAT(parameters(diagram.bifurcations),
              testing::ElementsAre(testing::DoubleNear(disk.critical(), 1e-9)));
  EXPECT_TRUE(diagram.flutters.empty());
  for (const double spin : {0.5 * disk.critical(), 0.9 * disk.critical(), 1.5 * disk.critical(), 20.0}) {
    const Scene<3> scene = disk.scene(spin);
    const auto modes = normal_modes(scene, steady(scene));
    const std::complex<double> s = std::sqrt(std::complex<double>(-disk.square(spin)));
    double nearest = 1e9;
    for (std::size_t k = 0; k < modes.size(); ++k)
      nearest = std::min(nearest, std::abs(modes.eigenvalue(k) - s));
    EXPECT_LT(nearest, 1e-10 * std::abs(s)) << spin;
    EXPECT_EQ(modes.stability() == Stability::unstable, spin < disk.critical()) << modes.describe();
  }
}

TEST(SteadyBranches, TellTheSleepingTopsCriticalSpin) {
  // Two vibrations meet: n = sqrt(4 A m g l)/C.
  constexpr double A = 0.3, C = 0.02, mgl = g * 0.5;
  const auto diagram = follow_steady<3>(
      [](double n) {
        Scene<3> scene("top");
        scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
        const auto body = add_body(scene,
                                   {.mass = 1.0,
                                    .inertia = {0.05, 0.05, 0.02},
                                    .centre = {0.0, 0.0, 0.5},
                                    .angular_velocity = {0.0, 0.0, n}},
                                   "top");
        scene.add(Coincident{body.point({0.0, 0.0, -0.5}), Fixed<3>{}}, "point");
        return PosedSteady<3>{std::move(scene)};
      },
      {.from = 80.0, .to = 200.0, .step = 0.1});
  EXPECT_THAT(parameters(diagram.flutters),
              testing::ElementsAre(testing::DoubleNear(std::sqrt(4.0 * A * mgl) / C, 1e-7)));
  EXPECT_TRUE(diagram.bifurcations.empty());
}

/// mex: a conical pendulum of length 1 at the depth p: Omega^2 = g/p. The speed is a poor guess.
PosedSteady<3> conical_pendulum(double p, Particle<3>& bob) {
  Scene<3> scene("conical");
  scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
  bob = scene.add_particle(
      {.mass = 2.0, .position = {std::sqrt(1.0 - p * p), 0.0, -p}, .velocity = {0.0, 2.0, 0.0}}, "bob");
  scene.add(Distance{Fixed<3>{}, bob, 1.0});
  return {std::move(scene), {.keep = {{"height", [bob](const auto& now) { return now.position(bob).z(); }}}}};
}

void expect_speeds_of_conical_pendulums(const Branch<Equilibrium<3>>& branch, Particle<3> bob) {
  for (const auto& point : branch.points) {
    const double p = point.parameter;
    EXPECT_NEAR(point.state.sample().velocity(bob).norm(), std::sqrt((1.0 - p * p) * g / p), 1e-9);
  }
}

TEST(SteadyBranches, KeepWhatIsStatedAtEachValueOfTheParameter) {
  Particle<3> bob;
  const auto diagram =
      follow_steady<3>([&](double p) { return conical_pendulum(p, bob); }, {.from = 0.9, .to = 0.5});
  ASSERT_EQ(diagram.branches.size(), 1U);
  EXPECT_EQ(diagram.branches[0].end, BranchEnd::range) << diagram.branches[0].why;
  expect_speeds_of_conical_pendulums(diagram.branches[0], bob);
  EXPECT_TRUE(diagram.flutters.empty());
  EXPECT_TRUE(diagram.bifurcations.empty());
}

TEST(SteadyBranches, EndWhereTheSceneCannotBeBuilt) {
  Particle<3> bob;
  const auto diagram = follow_steady<3>(
      [&](double p) {
        if (p < 0.7) throw std::runtime_error("mine");
        return conical_pendulum(p, bob);
      },
      {.from = 0.9, .to = 0.5});
  ASSERT_EQ(diagram.branches.size(), 1U);
  EXPECT_EQ(diagram.branches[0].end, BranchEnd::lost);
  EXPECT_THAT(diagram.branches[0].why, HasSubstr("the function that builds the scene threw \"mine\""));
  EXPECT_GT(diagram.branches[0].points.size(), 2U);
  expect_speeds_of_conical_pendulums(diagram.branches[0], bob);
}

TEST(SteadyBranches, NeedASymmetryThatCarriesThemOn) {
  EXPECT_THAT(
      [] {
        (void)follow_steady<3>(
            [](double n) {
              Scene<3> scene("shaft");
              const auto body = add_body(scene,
                                         {.mass = 1.0,
                                          .inertia = {0.1, 0.12, 0.15},
                                          .centre = {0.0, 0.0, 1.0},
                                          .angular_velocity = {0.0, n, 0.0}},
                                         "crooked");
              scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
              add_joint(scene, Revolute{Ground<3>{}, body, {0.1, 0.0, 1.0}, {0.0, 1.0, 0.0}}, "bearing");
              return PosedSteady<3>{std::move(scene)};
            },
            {.from = 3.0, .to = 4.0});
      },
      ThrowsMessage<NoEquilibrium>(testing::AllOf(HasSubstr("crooked"), HasSubstr("floquet"))));
}

}  // namespace
}  // namespace dalembert::steady_branches_test
