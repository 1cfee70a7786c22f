#include "lagrangians.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

namespace dalembert::cross_check_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A pendulum of length 1 as a particle on a rod, and by its angle.
struct Twofold {
  Scene<2> scene;
  Particle<2> bob;
  Constraint<1> rod;
  LagrangianSystem<1> system = by_angle();
  Embedding<2, 1> embedding;

  Twofold() {
    scene.add(UniformGravity<2>{{0.0, -g}});
    bob = scene.add_particle({.mass = 1.0, .position = {std::sin(1.0), -std::cos(1.0)}}, "bob");
    rod = scene.add(Distance{Fixed<2>{}, bob, 1.0});
  }
  void embed() {
    embedding.add(bob, [](const auto& q) { return vec(sin(q[0]), -cos(q[0])); });
  }
};

TEST(EmbeddedMotion, HasTheForcesOfConstraintThatNewtonsLawAsksFor) {
  Twofold pendulum;
  pendulum.embed();
  const auto motion = simulate(pendulum.system, {.t_end = 2.0, .samples = 9, .tolerance = tolerance});
  const EmbeddedMotion<2> embedded(pendulum.scene, pendulum.embedding, motion);
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const double angle = motion.position(i)[0], rate = motion.velocity(i)[0];
    const Vec<2> along(-std::sin(angle), std::cos(angle));
    const Vec<2> force = (rate * rate + g * std::cos(angle)) * along;
    EXPECT_LE((embedded.constraint_force(pendulum.bob, i) - force).norm(), 1e-13 * g);
    EXPECT_LE((embedded.velocity(pendulum.bob, i) - rate * Vec<2>(std::cos(angle), std::sin(angle))).norm(),
              1e-14 * g);
  }
  EXPECT_THROW((void)embedded.position(pendulum.bob, 9), InvalidArgument);
}

TEST(CrossCheck, ReportsTheLargestDifferences) {
  Twofold pendulum;
  pendulum.embed();
  const auto check = cross_check(pendulum.scene, pendulum.system, pendulum.embedding,
                                 {.t_end = 2.0, .samples = 21, .tolerance = 1e-8});
  EXPECT_LE(check.position.relative(), 1e-6);
  EXPECT_LE(check.force.relative(), 1e-6);
  EXPECT_THAT(check.report(), AllOf(HasSubstr("forces of constraint differ by"), HasSubstr("\"bob\"")));
}

TEST(CrossCheck, FindsAWrongLagrangian) {
  Twofold pendulum;
  pendulum.embed();
  const LagrangianSystem<1> wrong({.position = Vec<1>(1.0)}, [](const auto& q, const auto& v) {
    return 0.5 * v[0] * v[0] + 1.01 * g * cos(q[0]);
  });
  const auto check = cross_check(pendulum.scene, wrong, pendulum.embedding, {.t_end = 2.0, .samples = 21});
  EXPECT_GT(check.position.relative(), 1e-3);
}

TEST(CrossCheck, SaysWhatDoesNotFitTogether) {
  const Options options{.t_end = 1.0, .samples = 3};
  Twofold pendulum;
  const auto check = [&] {
    return cross_check(pendulum.scene, pendulum.system, pendulum.embedding, options);
  };
  EXPECT_THAT(check, ThrowsMessage<InvalidArgument>(AllOf(HasSubstr("embedding"), HasSubstr("\"bob\""))));
  pendulum.embedding.add(pendulum.bob, [](const auto& q) { return vec(sin(q[0]), cos(q[0])); });
  EXPECT_THAT(check, ThrowsMessage<InvalidArgument>(HasSubstr("do not begin in the same state")));
  pendulum.embed();
  EXPECT_NO_THROW((void)check());  // what is added last holds
  pendulum.scene.add(friction_law(pendulum.rod, points(pendulum.bob),
                                  [](auto lambda, auto, auto v) { return (0.01 * lambda * v).eval(); }));
  EXPECT_THAT(check, ThrowsMessage<InvalidArgument>(HasSubstr("reads a multiplier")));
  Scene<2> other;
  const auto stranger = other.add_particle({.mass = 1.0});
  Twofold again;
  again.embed();
  again.embedding.add(stranger, [](const auto& q) { return vec(q[0], q[0]); });
  EXPECT_THROW((void)cross_check(again.scene, again.system, again.embedding, options), InvalidArgument);
}

TEST(CrossCheck, NamesWhatItsEmbeddingFailsToPlace) {
  const auto fails = [](const auto& place, const std::string& why) {
    Twofold pendulum;
    pendulum.embedding.add(pendulum.bob, place);
    EXPECT_THAT(
        [&] {
          (void)cross_check(pendulum.scene, pendulum.system, pendulum.embedding,
                            {.t_end = 1.0, .samples = 3});
        },
        ThrowsMessage<EquationFault>(AllOf(HasSubstr("particle \"bob\""), HasSubstr(why))));
  };
  fails([](const auto& q) { return vec(sin(q[0]), -sqrt(q[0] - 5.0)); }, "no finite value");
  fails(
      [](const auto& q) {
        if (q[0] < 5.0) throw std::runtime_error("mine");
        return vec(sin(q[0]), -cos(q[0]));
      },
      "threw \"mine\"");
  fails(
      [](const auto& q) {
        if (q[0] < 5.0) throw 3;
        return vec(sin(q[0]), -cos(q[0]));
      },
      "no std::exception");
}

TEST(EmbeddedMotion, CanBeReadAfterItWasMoved) {
  Twofold pendulum;
  pendulum.embed();
  const auto motion = simulate(pendulum.system, {.t_end = 1.0, .samples = 3});
  EmbeddedMotion<2> first(pendulum.scene, pendulum.embedding, motion);
  const auto taken = std::move(first);
  EXPECT_EQ(first.constraint_force(pendulum.bob, 2),  // NOLINT(bugprone-use-after-move)
            taken.constraint_force(pendulum.bob, 2));
}

}  // namespace
}  // namespace dalembert::cross_check_test
