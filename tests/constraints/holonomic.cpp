#include "dalembert/constraints/holonomic.h"

#include "../equations.h"
#include <dalembert/constraints/distance.h>
#include <dalembert/solvers/simulation.h>

#include <Eigen/Core>
#include <gmock/gmock.h>

namespace dalembert::holonomic_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// g = x y - t at (2, 3), t = 1, v = (4, 5): g = 5, psi = 3*4 + 2*5 - 1, gamma = 2*4*5, W = (3, 2).
TEST(Holonomic, ResidualsGradientAndBiasAreThoseByHand) {
  Scene<2> scene;
  const auto p = scene.add_particle({.mass = 1.0});
  scene.add(holonomic(points(p), [](auto t, auto r) { return r.x() * r.y() - t; }));
  const Values now = values(scene.system(), {1.0, Eigen::Vector2d(2.0, 3.0), Eigen::Vector2d(4.0, 5.0)});
  EXPECT_EQ(now.g[0], 5.0);
  EXPECT_EQ(now.psi[0], 21.0);
  EXPECT_EQ(now.gamma[0], 40.0);
  EXPECT_EQ(now.W, Eigen::RowVector2d(3.0, 2.0));
}

/// A pendulum of two bobs whose upper rod is written in one way or another.
struct DoublePendulum {
  Scene<2> scene;
  Particle<2> upper = scene.add_particle({.mass = 1.0, .position = {0.6, -0.8}, .velocity = {0.8, 0.6}});
  Particle<2> lower = scene.add_particle({.mass = 2.0, .position = {1.6, -0.8}, .velocity = {0.8, -1.0}});
  Constraint<1> lower_rod = scene.add(Distance{upper, lower, 1.0});
  Constraint<1> upper_rod;

  template <class C>
  explicit DoublePendulum(C rod_of) {
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    upper_rod = scene.add(rod_of(upper));
  }
  [[nodiscard]] Trajectory<2> run() const {
    return simulate(scene, {.t_end = 1.0, .samples = 11, .tolerance = 1e-8});
  }
};

/// Largest differences of position and of any force of constraint between two runs.
std::pair<double, double> differences(const DoublePendulum& one, const DoublePendulum& two) {
  const auto a = one.run();
  const auto b = two.run();
  double position = 0.0, force = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    position = std::max(position, (a.position(one.upper, i) - b.position(two.upper, i)).norm());
    position = std::max(position, (a.position(one.lower, i) - b.position(two.lower, i)).norm());
    force = std::max(force, (a.constraint_force(one.upper_rod, one.upper, i) -
                             b.constraint_force(two.upper_rod, two.upper, i))
                                .norm());
    force = std::max(force, (a.constraint_force(one.lower_rod, one.upper, i) -
                             b.constraint_force(two.lower_rod, two.upper, i))
                                .norm());
  }
  return {position, force};
}

TEST(Holonomic, AUsersRodIsADistanceToTheLastBit) {
  const DoublePendulum ours([](auto bob) { return Distance{Fixed<2>{}, bob, 1.0}; });
  const DoublePendulum users([](auto bob) {
    return holonomic(points(Fixed<2>{}, bob), [](auto r_a, auto r_b) { return (r_b - r_a).norm() - 1.0; });
  });
  const auto [position, force] = differences(ours, users);
  EXPECT_EQ(position, 0.0);  // the same operations in the same order
  EXPECT_EQ(force, 0.0);
}

// A power of two scales without rounding, so that only the pivoting of the factorisation may differ:
// round-off of two runs of about `steps` steps. 1000 itself rounds the equation anew at each evaluation,
// within Newton's tolerance: the two runs agree to the tolerance of a step times the number of steps.
TEST(Holonomic, RescalingAnEquationChangesNoForce) {
  const DoublePendulum plain(
      [](auto bob) { return holonomic(points(bob), [](auto r) { return r.norm() - 1.0; }); });
  const DoublePendulum scaled(
      [](auto bob) { return holonomic(points(bob), [](auto r) { return 1000.0 * (r.norm() - 1.0); }); });
  const auto start = Simulation<2>(plain.scene, {.t_end = 1.0});
  const auto start_scaled = Simulation<2>(scaled.scene, {.t_end = 1.0});
  const double weight = 3.0 * 9.81;
  EXPECT_LE((start.constraint_force(plain.upper) - start_scaled.constraint_force(scaled.upper)).norm(),
            64.0 * epsilon * weight);
  EXPECT_NEAR(start.multiplier(plain.upper_rod), 1000.0 * start_scaled.multiplier(scaled.upper_rod),
              64.0 * epsilon * weight);
  const auto steps = static_cast<double>(plain.run().statistics().steps);
  const auto [position, force] = differences(plain, scaled);
  EXPECT_LE(position, 1e-8 * 2.0 * steps);
  EXPECT_LE(force, 1e-8 * 2.0 * steps * weight);
}

// The multipliers are the force in the rod either way round.
TEST(Holonomic, ReversingTheOrderOfPointsChangesNoForce) {
  const DoublePendulum forth([](auto bob) { return Distance{Fixed<2>{}, bob, 1.0}; });
  const DoublePendulum back([](auto bob) { return Distance{bob, Fixed<2>{}, 1.0}; });
  const auto [position, force] = differences(forth, back);
  EXPECT_EQ(position, 0.0);  // every number but a sign is the same
  EXPECT_EQ(force, 0.0);
  EXPECT_EQ(Simulation<2>(forth.scene, {.t_end = 1.0}).multiplier(forth.upper_rod),
            Simulation<2>(back.scene, {.t_end = 1.0}).multiplier(back.upper_rod));
}

// Two equations in one: a particle held at (1, 2) in the plane.
TEST(Holonomic, HasAMultiplierForEachOfItsEquations) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -10.0}});
  const auto p = scene.add_particle({.mass = 2.0, .position = {1.0, 2.0}});
  const auto held =
      scene.add(holonomic(points(p), [](auto r) { return vec(r.x() - 1.0, 2.0 * (r.y() - 2.0)); }));
  const Simulation<2> simulation(scene, {.t_end = 1.0});
  // Its second gradient is (0, 2): the multiplier is half the force.
  EXPECT_LE((simulation.multiplier(held) - Vec<2>(0.0, 10.0)).norm(), 16.0 * epsilon * 20.0);
  EXPECT_LE((simulation.constraint_force(held, p) - Vec<2>(0.0, 20.0)).norm(), 16.0 * epsilon * 20.0);
}

TEST(Holonomic, AnEquationThatThrowsAtTheStartIsNamed) {
  Scene<2> scene;
  const auto p = scene.add_particle({.mass = 1.0});
  scene.add(holonomic(points(p),
                      [](auto r) {
                        if (r.x() < 1.0) throw std::domain_error("left of the track");
                        return r.y() - 1.0;
                      }),
            "track");
  EXPECT_THAT([&] { (void)simulate(scene, {.t_end = 1.0}); },
              ThrowsMessage<InconsistentStart>(AllOf(HasSubstr("Holonomic \"track\""),
                                                     HasSubstr("threw \"left of the track\""),
                                                     HasSubstr("correct the equation"))));
}

TEST(Holonomic, AnEquationThatIsNoNumberAtTheStartIsNamed) {
  Scene<2> scene;
  const auto p = scene.add_particle({.mass = 1.0});
  scene.add(holonomic(points(p), [](auto r) { return sqrt(r.y() - 1.0); }), "track");
  EXPECT_THAT([&] { (void)simulate(scene, {.t_end = 1.0}); },
              ThrowsMessage<InconsistentStart>(AllOf(HasSubstr("Holonomic \"track\""),
                                                     HasSubstr("not a finite number"),
                                                     HasSubstr("start where it is defined"))));
}

TEST(Holonomic, AnEquationThatDependsOnNothingIsNamed) {
  Scene<2> scene;
  const auto p = scene.add_particle({.mass = 1.0});
  scene.add(holonomic(points(p), [](auto r) { return 0.0 * r.x(); }), "nothing");
  EXPECT_THAT(
      [&] { (void)simulate(scene, {.t_end = 1.0}); },
      ThrowsMessage<InconsistentStart>(AllOf(HasSubstr("Holonomic \"nothing\""), HasSubstr("no gradient"))));
}

TEST(Holonomic, BetweenOneParticleAndItselfIsNamed) {
  Scene<2> scene;
  const auto p = scene.add_particle({.mass = 1.0});
  scene.add(holonomic(points(p, p), [](auto r, auto s) { return r.x() - s.x(); }), "slip");
  EXPECT_THAT([&] { (void)simulate(scene, {.t_end = 1.0}); },
              ThrowsMessage<InconsistentStart>(
                  AllOf(HasSubstr("Holonomic \"slip\""), HasSubstr("same point twice"))));
}

}  // namespace
}  // namespace dalembert::holonomic_test
