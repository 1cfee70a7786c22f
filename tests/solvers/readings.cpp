#include "readings.h"

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace dalembert::readings_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

TEST(Readings, FixedAndDrivenPointsAreReadLikeParticles) {
  const Pendulum pendulum;
  const auto shaker = driven([](auto t) { return vec(0.1 * sin(5.0 * t), t * t); });
  const Fixed<2> nail{{1.0, 2.0}};
  const auto run = simulate(pendulum.scene, {.t_end = 1.0});
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i];
    EXPECT_EQ(run.position(nail, i), nail.position);
    EXPECT_EQ(run.velocity(nail, i), Vec<2>::Zero());
    EXPECT_EQ(run.acceleration(nail, i), Vec<2>::Zero());
    EXPECT_LT((run.position(shaker, i) - Vec<2>{0.1 * std::sin(5.0 * t), t * t}).norm(), 4.0 * epsilon);
    EXPECT_LT((run.velocity(shaker, i) - Vec<2>{0.5 * std::cos(5.0 * t), 2.0 * t}).norm(), 4.0 * epsilon);
    EXPECT_LT((run.acceleration(shaker, i) - Vec<2>{-2.5 * std::sin(5.0 * t), 2.0}).norm(), 8.0 * epsilon);
  }
}

TEST(Readings, APathWithoutAValueCannotBeRead) {
  const auto run = simulate(Pendulum().scene, {.t_end = 1.0, .samples = 3});
  const auto away = driven([](auto t) { return vec(1.0 / t, 0.0); });
  const auto kinked =
      driven([](auto t) { return vec(t * sqrt(t), 0.0); });  // its second derivative begins at infinity
  const auto refused =
      ThrowsMessage<EquationFault>(HasSubstr("driven point has no finite value or derivative at t = 0"));
  EXPECT_THAT([&] { (void)run.position(away, 0); }, refused);
  EXPECT_THAT([&] { (void)run.acceleration(kinked, 0); }, refused);
  EXPECT_EQ(run.position(away, 1), Vec<2>(2.0, 0.0));
}

TEST(Readings, AllTimesAreTheSamplesOneByOne) {
  const EachKind each;
  const auto run = simulate(each.scene, {.t_end = 1.0, .samples = 11});
  const auto pin = each.scene.constraint<2>("pin");
  ASSERT_EQ(run.positions(each.bead).cols(), 11);
  std::size_t column = 0;
  for (const auto& now : run) {
    EXPECT_EQ(now.time(), run.times()[column]);
    EXPECT_EQ(run.positions(each.bead).col(column), now.position(each.bead));
    EXPECT_EQ(run.velocities(each.bead).col(column), now.velocity(each.bead));
    EXPECT_EQ(run.accelerations(each.skate).col(column), now.acceleration(each.skate));
    EXPECT_EQ(run.multipliers(each.upper_rod)[column], now.multiplier(each.upper_rod));
    EXPECT_EQ(run.multipliers(pin).col(column), now.multiplier(pin));
    ++column;
  }
  EXPECT_EQ(column, 11u);
  EXPECT_THROW((void)run.positions(Pendulum().bob), InvalidArgument);
}

TEST(Readings, RotorsHaveAllTimesToo) {
  Scene<2> scene;
  const auto wheel = scene.add_rotor({.inertia = 0.5, .angle = 1.0, .angular_velocity = 2.0}, "wheel");
  const auto run = simulate(scene, {.t_end = 1.0, .samples = 3});
  EXPECT_DOUBLE_EQ(run.angles(wheel)[1], 2.0);
  EXPECT_DOUBLE_EQ(run.angular_velocities(wheel)[2], 2.0);
  EXPECT_EQ(run.angular_accelerations(wheel).maxCoeff(), 0.0);
}

/// What can be read of a sample can be read of a run and of a simulation, and is the same.
TEST(Readings, SampleTrajectoryAndSimulationReadTheSame) {
  const CompoundPendulum p;
  const Options options{.t_end = 1.0, .samples = 3};
  const auto run = simulate(p.scene, options);
  Simulation<2> simulation(p.scene, options);
  const auto gravity = p.scene.force("UniformGravity0");
  for (std::size_t i = 0; i < run.size(); ++i) {
    simulation.advance_to(run.times()[i]);
    const auto now = run.sample(i);
    const auto same = [](const auto& a, const auto& b, const auto& c) { EXPECT_TRUE(a == b && b == c); };
    same(now.energy(), run.energy(i), simulation.energy());
    same(now.position(p.tip), run.position(p.tip, i), simulation.position(p.tip));
    same(now.velocity(p.tip), run.velocity(p.tip, i), simulation.velocity(p.tip));
    same(now.acceleration(p.tip), run.acceleration(p.tip, i), simulation.acceleration(p.tip));
    same(now.multiplier(p.hinge), run.multiplier(p.hinge, i), simulation.multiplier(p.hinge));
    same(now.is_determined(p.hinge), run.is_determined(p.hinge, i), simulation.is_determined(p.hinge));
    same(now.is_unique(p.hinge), run.is_unique(p.hinge, i), simulation.is_unique(p.hinge));
    same(now.is_unique(p.hinge, 1), run.is_unique(p.hinge, 1, i), simulation.is_unique(p.hinge, 1));
    same(now.constraint_force(p.body), run.constraint_force(p.body, i), simulation.constraint_force(p.body));
    const auto particle = p.body.particles[0];
    same(now.constraint_force(p.hinge, particle), run.constraint_force(p.hinge, particle, i),
         simulation.constraint_force(p.hinge, particle));
    same(now.constraint_moment(p.hinge, p.body, {1.0, 0.0}),
         run.constraint_moment(p.hinge, p.body, {1.0, 0.0}, i),
         simulation.constraint_moment(p.hinge, p.body, {1.0, 0.0}));
    same(now.constraint_moment(p.body, {1.0, 0.0}), run.constraint_moment(p.body, {1.0, 0.0}, i),
         simulation.constraint_moment(p.body, {1.0, 0.0}));
    same(now.ground_force(p.hinge), run.ground_force(p.hinge, i), simulation.ground_force(p.hinge));
    same(now.ground_moment(p.hinge, {1.0, 0.0}), run.ground_moment(p.hinge, {1.0, 0.0}, i),
         simulation.ground_moment(p.hinge, {1.0, 0.0}));
    same(now.force(gravity, p.body), run.force(gravity, p.body, i), simulation.force(gravity, p.body));
  }
}

/// In a chain two rods touch a bead, four slots for its two coordinates, however long the chain is.
TEST(Readings, TheForceOnAParticleLooksAtWhatTouchesItOnly) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  std::vector<Particle<2>> beads;
  std::vector<Constraint<1>> rods;
  for (int i = 0; i < 50; ++i) {
    const Vec<2> r{0.0, -0.1 * (i + 1)};
    beads.push_back(scene.add_particle({.mass = 0.1, .position = r, .velocity = {0.01 * (i + 1), 0.0}}));
    rods.push_back(i == 0 ? scene.add(Distance{Fixed<2>{}, beads[0], 0.1})
                          : scene.add(Distance{beads[beads.size() - 2], beads.back(), 0.1}));
  }
  const auto run = simulate(scene, {.t_end = 0.1, .samples = 2});
  const auto now = run.sample(1);
  for (std::size_t i = 0; i < beads.size(); ++i) {
    EXPECT_EQ(now.layout().touching_slots(beads[i].coordinate).size(), i + 1 < beads.size() ? 2U : 1U);
    Vec<2> all = Vec<2>::Zero();
    for (const auto& rod : rods) all += now.constraint_force(rod, beads[i]);
    EXPECT_EQ(now.constraint_force(beads[i]), all);
  }
}

}  // namespace
}  // namespace dalembert::readings_test
