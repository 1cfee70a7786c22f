#include <dalembert/constraints/distance.h>
#include <dalembert/constraints/holonomic.h>
#include <dalembert/constraints/on_surface.h>
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

/// A number that its derivatives do not see.
double hidden(const auto& x) {
  if constexpr (requires { x.value; })
    return static_cast<double>(x.value);
  else
    return static_cast<double>(x);
}

/// y = x^2/l at x = l, right or with one factor hidden, so that W = -1 in place of -2.
std::string parabola(double l, bool hides) {
  Scene<2> scene;
  const auto bead = scene.add_particle({.mass = 0.2, .position = {l, l}});
  if (hides)
    scene.add(holonomic(points(bead), [l](const auto& r) { return r.y() - hidden(r.x()) * r.x() / l; }));
  else
    scene.add(holonomic(points(bead), [l](const auto& r) { return r.y() - r.x() * r.x() / l; }));
  return broken_laws(scene);
}

/// F = k x r, right or with x hidden.
std::string quadratic_force(double k, bool hides) {
  Scene<2> scene;
  const auto bead = scene.add_particle({.mass = 1.0, .position = {1.0, 1.0}});
  if (hides)
    scene.add(force_law(points(bead), [k](const auto& r, const auto&) { return k * hidden(r.x()) * r; }));
  else
    scene.add(force_law(points(bead), [k](const auto& r, const auto&) { return k * r.x() * r; }));
  return broken_laws(scene);
}

/// A millionth of a micrometre and a thousand kilometres, in metres.
TEST(BrokenLaws, AreTheSameInAllUnits) {
  for (const double size : {1e-12, 1e-9, 1e-3, 1.0, 1e3, 1e6}) {
    EXPECT_EQ(parabola(size, false), "") << size;
    EXPECT_THAT(parabola(size, true), HasSubstr("W = dg/dq")) << size;
    EXPECT_EQ(quadratic_force(size, false), "") << size;
    EXPECT_THAT(quadratic_force(size, true), HasSubstr("d(F + W^T lambda)/dq")) << size;
  }
}

/// A rod and a rod of which half the gradient is hidden: where it is does not matter.
TEST(BrokenLaws, AreTheSameFarFromTheOrigin) {
  for (const double far : {0.0, 1e3, 1e4, 1e6}) {
    for (const double length : {1e-2, 1.0, 1e3}) {
      Scene<2> right, wrong;
      for (Scene<2>* scene : {&right, &wrong}) {
        const auto a = scene->add_particle({.mass = 1.0, .position = {far, far}});
        const auto b = scene->add_particle({.mass = 1.0, .position = {far + length, far}});
        if (scene == &right)
          scene->add(Distance{a, b, length});
        else
          scene->add(holonomic(points(a, b), [length](const auto& p, const auto& q) {
            return hidden((q - p).norm()) / length * (q - p).norm() - length;
          }));
      }
      EXPECT_EQ(broken_laws(right), "") << far << ", " << length;
      EXPECT_THAT(broken_laws(wrong), HasSubstr("W = dg/dq")) << far << ", " << length;
    }
  }
}

/// The centre of the sphere is a constant of 1e9, which neither a coordinate nor g shows: a rounding of it
/// is 1e-7.
TEST(BrokenLaws, SurfaceOfAFarCentreBreaksNone) {
  Scene<3> scene;
  const auto bead = scene.add_particle({.mass = 1.0, .position = {0.3, 0.2, 0.0}});
  scene.add(OnSurface{bead, Sphere<3>{.centre = {0.0, 0.0, -1e9}, .radius = 1e9}});
  EXPECT_EQ(broken_laws(scene), "");
}

/// A hill a hundredth wide beside the bead: long steps jump over it, and see no slope.
TEST(BrokenLaws, NarrowHillBreaksNone) {
  Scene<2> scene;
  const auto bead = scene.add_particle({.mass = 1.0, .position = {5.0, 1.0}});
  scene.add(force_law(points(bead), [](const auto& r, const auto&) {
    const auto x = (r.x() - 5.005) / 0.01;
    return exp(-x * x) * r;
  }));
  EXPECT_EQ(broken_laws(scene), "");
}

}  // namespace
}  // namespace dalembert::laws_of_users_test
