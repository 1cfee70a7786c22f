#include "dalembert/constraints/compliant.h"

#include <dalembert/constraints/distance.h>
#include <dalembert/core/analysis/virtual_work.h>
#include <dalembert/solvers/simulation.h>

#include <gmock/gmock.h>

#include <cmath>

namespace dalembert::compliant_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double g = 9.81;
/// Errors of a run, in units of the scene, against the tolerance asked for: what the catalogue shows.
constexpr double of_a_run = 1000.0;

struct SpringPendulum {
  Scene<2> scene;
  Particle<2> bob;
  Constraint<1> rod;

  SpringPendulum(double stiffness, Vec<2> position) {
    scene.add(UniformGravity<2>{{0.0, -g}});
    bob = scene.add_particle({.mass = 1.0, .position = position}, "bob");
    rod = scene.add(compliant(Distance{Fixed<2>{}, bob, 1.0}, 1.0 / stiffness), "spring");
  }
};

// m z'' = m g - k z from rest at z = 0: z = m g/k (1 - cos w t), w^2 = k/m; the multiplier is -k z.
TEST(Compliant, HangingSpringOscillatesAboutItsEquilibrium) {
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    for (const double k : {10.0, 1000.0}) {
      SpringPendulum s(k, {0.0, -1.0});
      constexpr double tolerance = 1e-9;
      const auto run = simulate(s.scene, {.t_end = 3.0, .tolerance = tolerance, .stepper = stepper});
      for (std::size_t i = 0; i < run.size(); ++i) {
        const double z = g / k * (1.0 - std::cos(std::sqrt(k) * run.times()[i]));
        EXPECT_NEAR(run.position(s.bob, i).y(), -1.0 - z, of_a_run * tolerance);
        EXPECT_NEAR(run.multiplier(s.rod, i), -k * z, k * of_a_run * tolerance);
        EXPECT_NEAR(run.energy(i), -g, g * of_a_run * tolerance);
      }
    }
  }
}

// Energy gives the rigid pendulum's tension at any height: T = -3 m g y/L. A spring's differs by its
// stretch T/k and by m r'', r'' = -T''/k: together below 100 (m g)^2/(k L), as T'' is at most about 9 g T/L.
TEST(Compliant, StiffSpringsTensionIsThatOfARodUpToOneOverStiffness) {
  for (const double tolerance : {1e-6, 1e-8}) {
    SpringPendulum rigid(std::numeric_limits<double>::infinity(), {1.0, 0.0});
    const long rigid_steps =
        simulate(rigid.scene, {.t_end = 10.0, .tolerance = tolerance}).statistics().steps;
    for (const double k : {1e8, 1e10, 1e12}) {
      SpringPendulum s(k, {1.0, 0.0});
      const auto run = simulate(s.scene, {.t_end = 10.0, .tolerance = tolerance});
      EXPECT_LE(run.statistics().steps, 1.5 * static_cast<double>(rigid_steps)) << "stiffness " << k;
      for (std::size_t i = 0; i < run.size(); ++i) {
        const double tension = -3.0 * g * run.position(s.bob, i).y();
        EXPECT_NEAR(-run.multiplier(s.rod, i), tension, 100.0 * g * g / k + g * of_a_run * tolerance);
      }
    }
  }
}

// The explicit stepper reads it from positions, in whose round-off a vibration accumulates: right to the root
// of the tolerance, of forces up to 3 m g, or not at all. What round-off adds up to is told by its standard
// deviation; of some samples one is three of these off.
TEST(Compliant, AForceThatPositionsDoNotTellCannotBeRead) {
  const double tolerance = 1e-8;
  for (const double k : {1e6, 1e8, 1e10, 1e12}) {
    SpringPendulum s(k, {1.0, 0.0});
    const auto run =
        simulate(s.scene, {.t_end = 0.1, .samples = 11, .tolerance = tolerance, .stepper = Stepper::erk});
    for (const auto& now : run) {
      if (!now.is_determined(s.rod)) {
        EXPECT_GE(k, 1e10) << "told to 2e-16 sqrt(2e3 steps) k, 1e-6 N";
        EXPECT_THROW((void)now.acceleration(s.bob), UndeterminedForce);
        continue;
      }
      EXPECT_TRUE(k < 1e12 || now.time() == 0.0);
      const double tension = -3.0 * g * now.position(s.bob).y();
      EXPECT_NEAR(-now.multiplier(s.rod), tension, 100.0 * g * g / k + 3.0 * std::sqrt(tolerance) * 3.0 * g);
    }
  }
}

TEST(Compliant, ZeroComplianceIsTheRigidConstraint) {
  SpringPendulum s(std::numeric_limits<double>::infinity(), {1.0, 0.0});
  Scene<2> plain;
  plain.add(UniformGravity<2>{{0.0, -g}});
  const auto bob = plain.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  plain.add(Distance{Fixed<2>{}, bob, 1.0});
  const auto a = simulate(s.scene, {.t_end = 2.0});
  const auto b = simulate(plain, {.t_end = 2.0});
  EXPECT_EQ(a.position(s.bob, 100), b.position(bob, 100));
  EXPECT_EQ(a.statistics().degrees_of_freedom, 1);
}

// Two parallel springs share the load as their stiffnesses, 1 to 3; a rod beside a spring takes all.
TEST(Compliant, SpringsSideBySideShareTheLoad) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const double stretch = g / 400.0;
  const auto bob = scene.add_particle({.mass = 1.0, .position = {0.0, -1.0 - stretch}});
  const auto soft = scene.add(compliant(Distance{Fixed<2>{}, bob, 1.0}, 1.0 / 100.0));
  const auto hard = scene.add(compliant(Distance{Fixed<2>{}, bob, 1.0}, 1.0 / 300.0));
  const auto lamp = scene.add_particle({.mass = 2.0, .position = {5.0, -1.0}});
  const auto idle = scene.add(compliant(Distance{Fixed<2>{{5.0, 0.0}}, lamp, 1.0}, 1e-3));
  const auto rod = scene.add(Distance{Fixed<2>{{5.0, 0.0}}, lamp, 1.0});
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    const auto run = simulate(scene, {.t_end = 1.0, .tolerance = 1e-8, .stepper = stepper});
    EXPECT_EQ(run.statistics().redundant_equations, 0);
    EXPECT_EQ(run.statistics().singular_positions, 0);
    EXPECT_EQ(run.statistics().degrees_of_freedom, 3);
    const std::size_t last = run.size() - 1;
    EXPECT_NEAR(run.multiplier(soft, last), -0.25 * g, g * of_a_run * 1e-8);
    EXPECT_NEAR(run.multiplier(hard, last), -0.75 * g, g * of_a_run * 1e-8);
    EXPECT_NEAR(run.multiplier(idle, last), 0.0, g * of_a_run * 1e-8);
    EXPECT_NEAR(run.multiplier(rod, last), -2.0 * g, g * of_a_run * 1e-8);
  }
}

// A bob amid three stiff springs, whose gradients cannot be independent in the plane, against the same
// springs as forces. Started with an energy of about 1 at rest in their centre; the stiffest vibrates at 100.
TEST(Compliant, SpringsMoreThanTheirBobHasFreedomVibrateAsForcesDo) {
  const Vec<2> feet[] = {{1.0, 0.0}, {-0.5, 0.8}, {-0.3, -0.9}};
  Scene<2> as_constraints, as_forces;
  const ParticleState<2> middle{.mass = 1.0, .position = {0.0, 0.0}, .velocity = {1.0, 0.5}};
  const auto bob = as_constraints.add_particle(middle);
  const auto same = as_forces.add_particle(middle);
  for (int k = 0; k < 3; ++k) {
    const double stiffness = 2500.0 * (k + 1), length = feet[k].norm();
    as_constraints.add(compliant(Distance{Fixed<2>{feet[k]}, bob, length}, 1.0 / stiffness));
    as_forces.add(Spring{Fixed<2>{feet[k]}, same, stiffness, length});
  }
  const auto exact = simulate(as_forces, {.t_end = 0.5, .tolerance = 1e-12, .stepper = Stepper::erk});
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    const auto run = simulate(as_constraints, {.t_end = 0.5, .tolerance = 1e-8, .stepper = stepper});
    EXPECT_EQ(run.statistics().singular_positions, 0);
    for (std::size_t i = 0; i < run.size(); ++i)
      EXPECT_LT((run.position(bob, i) - exact.position(same, i)).norm(), of_a_run * 1e-8);
  }
}

TEST(Compliant, SaysWhatIsWrongWithIt) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0});
  for (const double compliance : {-1e-3, std::nan("")}) {
    EXPECT_THAT(
        [&] {
          scene.add(compliant(Distance{Fixed<2>{}, bob, 1.0}, compliance), "s");
        },
        ThrowsMessage<InvalidScene>(AllOf(HasSubstr("\"s\""), HasSubstr("compliance = "))));
  }
  EXPECT_THAT(
      [&] {
        scene.add(compliant(Distance{Fixed<2>{}, bob, -1.0}, 0.0));
      },
      ThrowsMessage<InvalidScene>(HasSubstr("length = -1")));
}

/// A user's own constraint with a compliance.
struct Bar {
  Particle<2> end;
  double compliance;
  auto points() const { return std::tie(end); }
  auto operator()(const auto& r) const { return r.norm() - 1.0; }
};

TEST(Compliant, TheComplianceOfAUsersOwnConstraintIsCheckedToo) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  EXPECT_THAT(
      [&] {
        scene.add(Bar{bob, -1.0}, "bar");
      },
      ThrowsMessage<InvalidScene>(AllOf(HasSubstr("\"bar\""), HasSubstr("compliance = -1"))));
  EXPECT_NO_THROW(scene.add(Bar{bob, 1e-3}));
}

// A stiff spring written as a force: its vibration lies beyond the steps, and the advice says what to do.
TEST(Compliant, IsTheAdviceForAStiffSpringGivenAsAForce) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  scene.add(Spring{Fixed<2>{}, bob, 1e7, 1.0}, "stiff one");
  const auto run = simulate(scene, {.t_end = 0.5, .tolerance = 1e-4});
  EXPECT_THAT(run.statistics().advice, AllOf(HasSubstr("Spring \"stiff one\""), HasSubstr("compliant(")));
}

}  // namespace
}  // namespace dalembert::compliant_test
