#include <dalembert/dalembert.h>
#include <dalembert/tests/both_steppers.h>

#include <gtest/gtest.h>

#include <cmath>

namespace dalembert {
namespace {

constexpr double g = 9.81, tolerance = 1e-10;
/// A run of a few seconds errs by some tens of its tolerance, and so do the times at which it gets anywhere.
constexpr double met = 100.0 * tolerance;

/// Contacts that touch, close and open at the limits of what round-off can tell.
class ContactsAtRoundOff : public testing::TestWithParam<Stepper> {
 protected:
  [[nodiscard]] static Options options(double t_end) {
    return {.t_end = t_end, .samples = 11, .tolerance = tolerance, .stepper = GetParam()};
  }
};
INSTANTIATE_TEST_SUITE_P(Steppers, ContactsAtRoundOff, both_steppers, stepper_name);

TEST_P(ContactsAtRoundOff, OnBothSidesPushOnTheSideThatIsPressed) {
  // A slot without play, gravity across it: the floor bears, the ceiling does nothing, from the first sample.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto ball = scene.add_particle({.mass = 1.0});
  const auto floor = scene.add(unilateral(holonomic(points(ball), [](auto r) { return r.y(); })));
  const auto ceiling = scene.add(unilateral(holonomic(points(ball), [](auto r) { return -r.y(); })));
  const auto run = simulate(scene, options(1.0));
  for (std::size_t i = 0; i < run.size(); ++i) {
    EXPECT_NEAR(run.multiplier(floor, i), g, met);
    EXPECT_NEAR(run.multiplier(ceiling, i), 0.0, met);
  }
}

TEST_P(ContactsAtRoundOff, OpenWhereTheirForceVanishesAmongImpacts) {
  // A force on a block fades, 1 - t, while a ball beside it bounces, at any phase: the floor lets go at 1.
  for (const double height : {0.3, 0.31, 0.32, 0.33, 0.34}) {
    Scene<2> scene;
    const auto block = scene.add_particle({.mass = 1.0}, "block");
    const auto ball = scene.add_particle({.mass = 1.0, .position = {1.0, height}}, "ball");
    scene.add(force_law(points(block),
                        [](auto t, auto, auto v) { return (0.0 * v + vec(0.0, 1.0) * (t - 1.0)).eval(); }));
    scene.add(UniformGravity<2>{{0.0, -1.0}});
    scene.add(force_law(points(block), [](auto, auto, auto v) { return (0.0 * v + vec(0.0, 1.0)).eval(); }));
    const auto floor = scene.add(unilateral(holonomic(points(block), [](auto r) { return r.y(); })), "floor");
    scene.add(unilateral(holonomic(points(ball), [](auto r) { return r.y(); }), {.restitution = 0.9}));
    const auto run = simulate(scene, options(2.0));
    std::size_t opened = 0;
    for (const Occurrence& it : run.events()) {
      if (it.what != Happened::opened) continue;
      ++opened;
      EXPECT_NEAR(it.time, 1.0, met) << height;
    }
    EXPECT_EQ(opened, 1U) << height;
    EXPECT_EQ(run.multiplier(floor, 10), 0.0);
    EXPECT_NEAR(run.position(block, 10).y(), 1.0 / 6.0, met);
  }
}

}  // namespace
}  // namespace dalembert
