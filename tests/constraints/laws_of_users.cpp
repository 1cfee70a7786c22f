#include <dalembert/constraints/holonomic.h>
#include <dalembert/testing/laws.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

namespace dalembert::laws_of_users_test {
namespace {

using testing::HasSubstr;

/// A bead on y = x^2, as a user states it.
TEST(BrokenLaws, SmoothEquationBreaksNone) {
  Scene<2> scene;
  const auto bead = scene.add_particle({.mass = 1.0, .position = {0.5, 0.25}});
  scene.add(holonomic(points(bead), [](const auto& r) { return r.y() - r.x() * r.x(); }));
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  EXPECT_EQ(broken_laws(scene), "");
}

/// |x| has no derivative at 0: the quotient of both sides is 0.
TEST(BrokenLaws, AKinkIsNamed) {
  Scene<2> scene;
  const auto bead = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}});
  scene.add(holonomic(points(bead), [](const auto& r) { return r.y() - abs(r.x()); }), "roof");
  EXPECT_THAT(broken_laws(scene), HasSubstr("W = dg/dq"));
  EXPECT_THAT(broken_laws(scene), HasSubstr("\"roof\""));
}

/// An equation that counts its calls.
TEST(BrokenLaws, EquationWithAMemoryIsFound) {
  Scene<2> scene;
  const auto bead = scene.add_particle({.mass = 1.0, .position = {0.5, 1.0}});
  scene.add(holonomic(points(bead),
                      [calls = std::make_shared<int>(0)](const auto& r) { return r.y() + 1e-3 * ++*calls; }));
  EXPECT_THAT(broken_laws(scene), HasSubstr("a second evaluation gives other numbers"));
}

}  // namespace
}  // namespace dalembert::laws_of_users_test
