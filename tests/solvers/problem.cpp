#include <dalembert/constraints/coincident.h>
#include <dalembert/constraints/distance.h>
#include <dalembert/constraints/nonholonomic.h>
#include <dalembert/core/scene/scene.h>
#include <dalembert/models/chain.h>
#include <dalembert/solvers/integration.h>
#include <dalembert/solvers/opening.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

namespace dalembert::problem_test {
namespace {

/// Of a run with 20 outputs: start, projections, both steppers, recovery of forces.
template <int D>
SaddlePattern::Analyses analyses(const Scene<D>& scene, Stepper stepper) {
  const Options options{.t_end = 0.2, .stepper = stepper};
  const auto system = std::make_shared<const System>(scene.system());
  const Opening opening = open_run(system, scene.initial_positions(), scene.initial_velocities(), options);
  Integration integration(opening.problem, opening.start, opening.sides, options);
  OutputState moment(*system, integration.start());
  for (int i = 1; i <= 20; ++i) {
    const double t = options.t_end * i / 20;
    while (integration.time() < t) integration.step(t);
    integration.read(t, moment);
  }
  return integration.problem().analyses();
}

void expect(const SaddlePattern::Analyses& found, int ldl, int klu) {
  EXPECT_EQ(found.ldl, ldl);
  EXPECT_EQ(found.klu, klu);
}

TEST(Problem, AnalysesOfAChainAreOneWhateverTheStepper) {
  const Scene<2> chain = models::Chain{.beads = 5}.scene().scene;
  expect(analyses(chain, Stepper::erk), 1, 0);
  expect(analyses(chain, Stepper::ida), 1, 0);
}

/// A bob on a rod, and whatever a test adds to it.
struct Bob {
  Scene<2> scene;
  Particle<2> bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});

  Bob() {
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    scene.add(Distance{Fixed<2>{}, bob, 1.0});
  }
};

/// With its H Newton's matrix is not symmetric.
TEST(Problem, AForceThatVariesTakesOneMoreOfTheImplicitStepper) {
  Bob own;
  own.scene.add(Spring{Fixed<2>{{2.0, 0.0}}, own.bob, 5.0, 0.5});
  expect(analyses(own.scene, Stepper::erk), 1, 0);
  expect(analyses(own.scene, Stepper::ida), 1, 1);
}

/// Velocities are then found by the holonomic rows alone, see NewtonMatrix (7): a second choice of rows.
TEST(Problem, ANonholonomicRowTakesOneMoreOfTheImplicitStepper) {
  Scene<2> blade;
  const auto p = blade.add_particle({.mass = 1.0, .velocity = {1.0, 0.0}});
  blade.add(UniformGravity<2>{{0.0, -9.81}});
  blade.add(nonholonomic(points(p), [](auto r, auto v) { return v.y() - r.x() * v.x(); }));
  expect(analyses(blade, Stepper::erk), 1, 0);
  expect(analyses(blade, Stepper::ida), 2, 1);
}

/// Explicitly its matrix holds dF_f/dlambda, implicitly H and D as well: two patterns.
TEST(Problem, AForceThatReadsMultipliersTakesOneOfEachKind) {
  Bob own;
  const auto q = own.scene.add_particle({.mass = 1.0, .position = {2.0, 0.0}, .velocity = {0.0, 1.0}});
  const auto rod = own.scene.add(Distance{own.bob, q, 1.0});
  own.scene.add(friction_law(rod, points(q), [](auto lambda, auto, auto v) {
    return std::tuple{(-0.1 * sqrt(lambda * lambda + 1.0) * v).eval()};
  }));
  expect(analyses(own.scene, Stepper::erk), 1, 1);
  expect(analyses(own.scene, Stepper::ida), 1, 2);
}

/// 60 rods from one hub, whose complement would be full.
TEST(Problem, NoComplementIsAnalysedWhereManyConstraintsShareAParticle) {
  Scene<2> star;
  const auto hub = star.add_particle({.mass = 1.0});
  star.add(UniformGravity<2>{{0.0, -9.81}});
  for (int i = 0; i < 60; ++i) {
    const double phi = 0.1 * i;
    const auto p = star.add_particle({.mass = 0.1, .position = {std::cos(phi), std::sin(phi)}});
    star.add(Distance{hub, p, 1.0});
  }
  expect(analyses(star, Stepper::erk), 0, 1);
  expect(analyses(star, Stepper::ida), 0, 1);
}

/// A rod stated twice: one of the two is chosen at the start, and stays.
TEST(Problem, RedundantRowsTakeNoMore) {
  Bob own;
  own.scene.add(Distance{Fixed<2>{}, own.bob, 1.0}, "again");
  expect(analyses(own.scene, Stepper::erk), 1, 0);
}

/// Of a star with more rods than patterns are kept, each choice leaves another rod out.
TEST(Problem, KeepsTheLastOfManyChoicesOfRows) {
  Scene<2> star;
  for (int i = 0; i < 20; ++i)
    star.add(Distance{Fixed<2>{}, star.add_particle({.mass = 1.0, .position = {1.0, 0.1 * i}}), 1.0});
  const Problem problem(star.system());
  const auto without = [&](std::size_t left_out) {
    std::vector<std::size_t> rows;
    for (std::size_t r = 0; r < 20; ++r) {
      if (r != left_out) rows.push_back(r);
    }
    return problem.pattern(rows);
  };
  const auto first = without(0);
  std::vector<std::weak_ptr<const SaddlePattern>> others;
  for (std::size_t i = 1; i < 20; ++i) {
    others.push_back(without(i));
    EXPECT_EQ(without(0), first);  // what is asked for again and again stays
  }
  EXPECT_TRUE(others.front().expired());
  EXPECT_FALSE(others.back().expired());
}

}  // namespace
}  // namespace dalembert::problem_test
