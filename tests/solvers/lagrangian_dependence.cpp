#include <dalembert/dalembert.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace dalembert::lagrangian_dependence_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Cyclic, IsNoCoordinateThatDecidesAComparison) {
  // A comparison with NaN has an outcome too. (Where q[0] <= 1 the first L depends on no q[1].)
  const LagrangianSystem<2> step({.position = {0.0, 0.0}, .velocity = {1.0, 0.0}},
                                 [](const auto& q, const auto& v) {
                                   auto L = 0.5 * (v[0] * v[0] + v[1] * v[1]);
                                   if (q[0] > 1.0) L -= 3.0 * q[1];
                                   return L;
                                 });
  EXPECT_THAT(step.cyclic(), ElementsAre(1));
  EXPECT_THROW((void)reduced(step, 0), InvalidArgument);
  const LagrangianSystem<2> band({.position = {5.0, 0.0}}, [](const auto& q, const auto& v) {
    auto L = 0.5 * (v[0] * v[0] + v[1] * v[1]) - q[1] * q[1];
    if (abs(q[0]) < 1.0) L -= 3.0 * q[1];
    return L;
  });
  EXPECT_THAT(band.cyclic(), IsEmpty());
  const LagrangianSystem<2> other({.position = {0.0, 1.0}, .velocity = {1.0, 0.0}},
                                  [](const auto& q, const auto& v) {
                                    auto L = 0.5 * (v[0] * v[0] + v[1] * v[1]) - q[1] * q[1];
                                    if (q[1] > 0.5) L -= 3.0 * (q[1] - 0.5) * (q[1] - 0.5);
                                    return L;
                                  });
  EXPECT_THAT(other.cyclic(), ElementsAre(0));
}

TEST(Reduced, StopsWhereItsLagrangianDependsOnWhatWasLeftOut) {
  // Not at the start, but beyond q[1] = 0.5.
  const LagrangianSystem<2> system({.position = {0.0, 0.0}, .velocity = {1.0, 1.0}},
                                   [](const auto& q, const auto& v) {
                                     auto L = 0.5 * (v[0] * v[0] + v[1] * v[1]);
                                     if (q[1] > 0.5) L -= (q[1] - 0.5) * (q[1] - 0.5) * q[0];
                                     return L;
                                   });
  ASSERT_THAT(system.cyclic(), ElementsAre(0));
  const auto routh = reduced(system, 0);
  try {
    (void)simulate(routh.system, {.t_end = 1.0, .samples = 3});
    FAIL();
  } catch (const IntegrationFailure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("left out as cyclic"));
  }
}

TEST(CrossCheck, FindsASpringThatTheMotionNeverFeels) {
  // Two pendulums of length 1 released alike, coupled by a spring that the Lagrangian lacks or has.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const double c = std::cos(0.5), s = std::sin(0.5);
  const auto a = scene.add_particle({.mass = 1.0, .position = {s, -c}}, "a"),
             b = scene.add_particle({.mass = 1.0, .position = {2.0 + s, -c}}, "b");
  scene.add(Distance{Fixed<2>{}, a, 1.0});
  scene.add(Distance{Fixed<2>{{2.0, 0.0}}, b, 1.0});
  scene.add(Spring{a, b, 3.0, 2.0});
  Embedding<2, 2> embedding;
  embedding.add(a, [](const auto& q) { return vec(sin(q[0]), -cos(q[0])); });
  embedding.add(b, [](const auto& q) { return vec(2.0 + sin(q[1]), -cos(q[1])); });
  const auto with = [](double k) {
    return LagrangianSystem<2>({.position = {0.5, 0.5}}, [k](const auto& q, const auto& v) {
      const auto x = 2.0 + sin(q[1]) - sin(q[0]), y = cos(q[0]) - cos(q[1]);
      const auto stretch = sqrt(x * x + y * y) - 2.0;
      return 0.5 * (v[0] * v[0] + v[1] * v[1]) + 9.81 * (cos(q[0]) + cos(q[1])) - 0.5 * k * stretch * stretch;
    });
  };
  const Options options{.t_end = 1.0, .samples = 5, .tolerance = 1e-8};
  const auto right = cross_check(scene, with(3.0), embedding, options);
  EXPECT_EQ(right.states, 10);
  EXPECT_LE(right.acceleration.relative(), 1e-12);  // both are solved for at the same state
  EXPECT_LE(right.reaction.relative(), 1e-12);
  EXPECT_LE(right.embedded.relative(), 1e-12);
  const auto wrong = cross_check(scene, with(0.0), embedding, options);
  EXPECT_LE(wrong.position.relative(), 1e-6);
  EXPECT_GT(wrong.acceleration.relative(), 1e-3);
  EXPECT_THAT(wrong.report(), HasSubstr("accelerations differ by"));
}

TEST(CrossCheck, FindsAnEmbeddingThatIsRightAtTheStartOnly) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0, .position = {0.0, -1.0}}, "bob");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  scene.add(Distance{Fixed<2>{}, bob, 1.0});
  Embedding<2, 1> embedding;
  embedding.add(bob, [](const auto& q) { return vec(sin(q[0]), -cos(0.9 * q[0])); });
  const LagrangianSystem<1> system({.position = Vec<1>(0.0)}, [](const auto& q, const auto& v) {
    return 0.5 * v[0] * v[0] + 9.81 * cos(q[0]);
  });
  const auto check = cross_check(scene, system, embedding, {.t_end = 1.0, .samples = 3});
  EXPECT_GT(check.embedded.relative(), 1e-3);
}

}  // namespace
}  // namespace dalembert::lagrangian_dependence_test
