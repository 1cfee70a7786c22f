#include "dalembert/core/scene/scene.h"
#include <dalembert/constraints/coincident.h>
#include <dalembert/constraints/distance.h>
#include <dalembert/constraints/holonomic.h>
#include <dalembert/constraints/on_curve.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace dalembert::scene_values_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// The path of a drive; one type, whatever the amplitude.
auto shaken(double amplitude) {
  return driven([amplitude](auto t) { return vec(amplitude * sin(3.0 * t), 0.0); });
}
auto wind(const Particle<2>& on, double speed) {
  return force_law(points(on), [speed](auto, auto v) { return (Vec<2>{speed, 0.0} - v).eval(); });
}
auto rough(Constraint<1> of, const Particle<2>& on, double mu) {
  return friction_law(of, points(on), [mu](auto lambda, auto, auto v) { return (-mu * lambda * v).eval(); });
}

auto turning(const Rotor& wheel, double rate) {
  return holonomic(points(wheel), [rate](auto t, auto phi) { return phi[0] - rate * t; });
}

/// Every parameter that a scene has.
struct Parameters {
  double mass = 1.0, x = 0.8, g = 9.81, length = 1.0, amplitude = 0.1, stiffness = 5.0, speed = 2.0, mu = 0.3;
  double fixed = 3.0, inertia = 0.2, rate = 2.0;
};
constexpr Parameters others{2.0, 0.7, 1.62, 1.1, 0.2, 6.0, 3.0, 0.4, 9.0, 0.3, 4.0};

/// One of each kind, and all handles.
struct All {
  Scene<2> scene{"all"};
  Particle<2> bob, bead;
  Rotor wheel;
  Constraint<1> rod, wire, turn;
  Force gravity, spring, breeze, friction;

  explicit All(const Parameters& p) {
    bob = scene.add_particle({.mass = p.mass, .position = {p.x, -0.6}}, "bob");
    bead = scene.add_particle({.mass = 1.0, .position = {2.0, 0.0}, .velocity = {1.0, 0.0}}, "bead");
    wheel = scene.add_rotor({.inertia = p.inertia, .angular_velocity = p.rate}, "wheel");
    gravity = scene.add(UniformGravity<2>{{0.0, -p.g}}, "gravity");
    rod = scene.add(Distance{shaken(p.amplitude), bob, p.length}, "rod");
    wire = scene.add(OnCurve{bead, Plane<2>{{0.0, 0.0}, {0.0, 1.0}}}, "wire");
    turn = scene.add(turning(wheel, p.rate), "turn");
    spring = scene.add(Spring{Fixed<2>{{p.fixed, 0.0}}, bob, p.stiffness}, "spring");
    breeze = scene.add(wind(bead, p.speed), "breeze");
    friction = scene.add(rough(wire, bead, p.mu), "friction");
  }
  /// Through handles.
  static void replace(Scene<2>& in, const All& a, const Parameters& p) {
    in.replace(a.bob, {.mass = p.mass, .position = {p.x, -0.6}});
    in.replace(a.wheel, {.inertia = p.inertia, .angular_velocity = p.rate});
    in.replace(a.gravity, UniformGravity<2>{{0.0, -p.g}});
    in.replace(a.rod, Distance{shaken(p.amplitude), a.bob, p.length});
    in.replace(a.turn, turning(a.wheel, p.rate));
    in.replace(a.spring, Spring{Fixed<2>{{p.fixed, 0.0}}, a.bob, p.stiffness});
    in.replace(a.breeze, wind(a.bead, p.speed));
    in.replace(a.friction, rough(a.wire, a.bead, p.mu));
  }
};

/// All that the equations of a scene say at its start, 0.2 later, and how large it is.
std::vector<double> equations(const Scene<2>& scene) {
  const System system = scene.system();
  auto e = system.evaluation();
  const Instant at{0.2, scene.initial_positions(), scene.initial_velocities()};
  system.evaluate(at, e);
  std::vector<double> lambda(system.rows());
  for (std::size_t r = 0; r < lambda.size(); ++r) lambda[r] = 1.0 + static_cast<double>(r);
  system.forces().add_friction(at, lambda, e.force);
  std::vector<double> gamma(system.rows());
  system.bias(at, gamma);
  std::vector<double> all{system.extent(0.2)};
  for (const auto& part : {e.force, e.g, e.psi, e.w, gamma}) all.insert(all.end(), part.begin(), part.end());
  const auto append = [&all](std::span<const double> more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  append(system.masses());
  append(at.q);
  append(at.v);
  return all;
}

TEST(SceneValues, ACopySaysWhatItsOriginalSays) {
  const All all{Parameters{}};
  const Scene<2> copy = all.scene;
  EXPECT_EQ(equations(copy), equations(all.scene));
  EXPECT_EQ(copy.describe(0.2), all.scene.describe(0.2));
}

TEST(SceneValues, ACopyOutlivesItsOriginal) {
  auto all = std::make_unique<All>(Parameters{});
  const auto before = equations(all->scene);
  const Scene<2> copy = all->scene;
  all.reset();
  EXPECT_EQ(equations(copy), before);
}

TEST(SceneValues, ReplacedParametersAreThoseOfASceneBuiltAnew) {
  const All all{Parameters{}};
  Scene<2> changed = all.scene;
  All::replace(changed, all, others);
  EXPECT_EQ(equations(changed), equations(All{others}.scene));
  EXPECT_EQ(equations(all.scene), equations(All{Parameters{}}.scene)) << "the original must not follow";
  All::replace(changed, all, Parameters{});
  EXPECT_EQ(equations(changed), equations(all.scene)) << "and back: nothing of it is left";
}

TEST(SceneValues, AnAssignedSceneIsACopyToo) {
  const All all{Parameters{}};
  Scene<2> other("other");
  const auto old = other.add_particle({.mass = 1.0}, "old");
  other = all.scene;
  EXPECT_EQ(equations(other), equations(all.scene));
  EXPECT_THROW(other.replace(old, {.mass = 1.0}), InvalidArgument);
  EXPECT_NO_THROW(other.replace(all.bob, {.mass = 1.0}));
}

TEST(SceneValues, WhatIsAddedAfterCopyingIsOnesOwn) {
  All all{Parameters{}};
  Scene<2> copy = all.scene;
  const auto mine = all.scene.add_particle({.mass = 1.0}, "mine");
  const auto its = copy.add_particle({.mass = 1.0}, "its");
  EXPECT_EQ(mine.index, its.index);
  EXPECT_NE(mine, its);
  const auto foreign = ThrowsMessage<InvalidArgument>(HasSubstr("belongs to another scene"));
  EXPECT_THAT([&] { copy.replace(mine, {.mass = 1.0}); }, foreign);
  EXPECT_THAT([&] { all.scene.replace(its, {.mass = 1.0}); }, foreign);
  EXPECT_THAT([&] { copy.add(Distance{mine, all.bob, 1.0}, "link"); }, foreign);
  EXPECT_NO_THROW(copy.add(Distance{its, all.bob, 1.0}, "link"));

  const auto my_rod = all.scene.add(Distance{Fixed<2>{}, all.bob, 1.0});
  const auto my_spring = all.scene.add(Spring{Fixed<2>{}, all.bob, 1.0});
  copy.add(Spring{Fixed<2>{}, all.bob, 1.0});
  EXPECT_THAT([&] { copy.replace(my_rod, Distance{Fixed<2>{}, all.bob, 2.0}); }, foreign);
  EXPECT_THAT([&] { copy.replace(my_spring, Spring{Fixed<2>{}, all.bob, 2.0}); }, foreign);
}

TEST(SceneValues, ASceneThatWasMovedFromStartsAnew) {
  Scene<2> first;
  const auto bob = first.add_particle({.mass = 1.0});
  Scene<2> second = std::move(first);
  first = Scene<2>("again");
  const auto other = first.add_particle({.mass = 1.0});
  EXPECT_NE(bob, other);
  EXPECT_THROW(first.replace(bob, {.mass = 1.0}), InvalidArgument);
  EXPECT_NO_THROW(second.replace(bob, {.mass = 1.0}));
}

TEST(SceneValues, WhatIsRefusedAsAddedIsRefusedAsReplacedAndLeavesNoTrace) {
  All all{Parameters{}};
  Scene<2>& scene = all.scene;
  const auto before = equations(scene);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto invalid = [](const char* label, const char* what) {
    return ThrowsMessage<InvalidScene>(AllOf(HasSubstr(label), HasSubstr(what)));
  };
  EXPECT_THAT([&] { scene.replace(all.bob, {.mass = -1.0}); }, invalid("Particle \"bob\"", "mass = -1"));
  EXPECT_THAT(
      [&] {
        scene.replace(all.bob, {.mass = 1.0, .position = {nan, 0.0}});
      },
      invalid("Particle \"bob\"", "position"));
  EXPECT_THAT([&] { scene.replace(all.wheel, {.inertia = 0.0}); }, invalid("Rotor \"wheel\"", "inertia = 0"));
  EXPECT_THAT(
      [&] {
        scene.replace(all.rod, Distance{shaken(0.1), all.bob, -1.0});
      },
      invalid("Distance \"rod\"", "length = -1"));
  EXPECT_THAT(
      [&] {
        scene.replace(all.spring, Spring{Fixed<2>{}, all.bob, -1.0});
      },
      invalid("Spring \"spring\"", "stiffness = -1"));
  EXPECT_THAT(
      [&] {
        scene.replace(all.spring, Spring{Fixed<2>{{nan, 0.0}}, all.bob, 1.0});
      },
      invalid("Spring \"spring\"", "fixed point"));
  EXPECT_THAT(
      [&] {
        scene.replace(all.gravity, UniformGravity<2>{{nan, 0.0}});
      },
      invalid("UniformGravity", "must be finite"));
  const auto wrong = [](const char* label, const char* what) {
    return ThrowsMessage<InvalidArgument>(AllOf(HasSubstr(label), HasSubstr(what)));
  };
  EXPECT_THAT(
      [&] {
        scene.replace(all.rod, Distance{shaken(0.1), Particle<2>{}, 1.0});
      },
      wrong("Distance \"rod\"", "was never added"));
  EXPECT_THAT([&] { scene.replace(all.friction, rough({}, all.bead, 0.1)); },
              wrong("FrictionLaw \"friction\"", "was never added"));
  EXPECT_THAT(
      [&] {
        scene.replace(Force{}, Spring{Fixed<2>{}, all.bob, 1.0});
      },
      wrong("\"all\"", "or to none"));
  EXPECT_EQ(equations(scene), before);
}

TEST(SceneValues, OnlyOneOfTheSameTypeTakesAPlace) {
  All all{Parameters{}};
  const auto before = equations(all.scene);
  const auto refused = [](const char* label) {
    return ThrowsMessage<InvalidArgument>(AllOf(HasSubstr(label), HasSubstr("only by one of its own type")));
  };
  EXPECT_THAT([&] { all.scene.replace(all.rod, Distance{Fixed<2>{}, all.bob, 1.0}); }, refused("\"rod\""));
  EXPECT_THAT([&] { all.scene.replace(all.spring, Spring{all.bead, all.bob, 1.0}); }, refused("\"spring\""));
  EXPECT_THAT(
      [&] {
        all.scene.replace(all.gravity, Spring{Fixed<2>{}, all.bob, 1.0});
      },
      refused("\"gravity\""));
  EXPECT_THAT([&] { all.scene.replace(all.spring, UniformGravity<2>{}); }, refused("\"spring\""));
  EXPECT_THAT([&] { all.scene.replace(all.spring, rough(all.wire, all.bead, 0.1)); }, refused("\"spring\""));
  EXPECT_THAT([&] { all.scene.replace(all.friction, wind(all.bead, 0.1)); }, refused("\"friction\""));
  EXPECT_EQ(equations(all.scene), before);
}

/// Among several of a type the right one changes, and it may act on other points.
TEST(SceneValues, AReplacedElementMayActOnOtherPoints) {
  const auto scene = [](bool second) {
    Scene<2> s;
    const auto a = s.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "a");
    const auto b = s.add_particle({.mass = 1.0, .position = {2.0, 0.0}}, "b");
    const auto c = s.add_particle({.mass = 1.0, .position = {4.0, 0.0}}, "c");
    s.add(Distance{a, b, 1.0}, "ab");
    const auto middle = s.add(Distance{a, second ? c : b, second ? 3.0 : 1.0}, "middle");
    s.add(Distance{b, c, 2.0}, "bc");
    if (!second) s.replace(middle, Distance{a, c, 3.0});
    return s;
  };
  EXPECT_EQ(equations(scene(false)), equations(scene(true)));
  const Scene<2> replaced = scene(false), stated = scene(true);
  const System by_replacing = replaced.system(), by_stating = stated.system();
  EXPECT_TRUE(std::ranges::equal(by_replacing.w_columns(), by_stating.w_columns()));
}

TEST(SceneValues, CanBeFoundByName) {
  const All all{Parameters{}};
  const Scene<2> copy = all.scene;
  EXPECT_EQ(copy.particle("bob"), all.bob);
  EXPECT_EQ(copy.rotor("wheel"), all.wheel);
  EXPECT_EQ(copy.constraint("wire"), all.wire);
  EXPECT_EQ(copy.force("gravity"), all.gravity);
  EXPECT_EQ(copy.force("friction"), all.friction);
}

TEST(SceneValues, AnUnknownNameIsAnErrorThatSaysWhatItIs) {
  Scene<2> scene("mine");
  const auto bob = scene.add_particle({.mass = 1.0}, "bob");
  scene.add(Coincident{Fixed<2>{}, bob}, "pin");
  const auto refused = [](const char* what) {
    return ThrowsMessage<InvalidArgument>(AllOf(HasSubstr("\""), HasSubstr(what)));
  };
  EXPECT_THAT([&] { (void)scene.particle("bop"); }, refused("has no particle \"bop\""));
  EXPECT_THAT([&] { (void)scene.particle("pin"); }, refused("that is a constraint"));
  EXPECT_THAT([&] { (void)scene.force("bob"); }, refused("that is a particle"));
  EXPECT_THAT([&] { (void)scene.constraint("pin"); }, refused("ask for constraint<2>"));
  EXPECT_EQ(scene.constraint<2>("pin").index, 0);
}

/// Gravities have names of their own, and leave those of forces what they were.
TEST(SceneValues, GravityIsAForceWithAName) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0}, "bob");
  const auto first = scene.add(UniformGravity<2>{{0.0, -1.0}});
  const auto second = scene.add(UniformGravity<2>{{0.0, -2.0}}, "more");
  const auto spring = scene.add(Spring{Fixed<2>{}, bob, 1.0});
  EXPECT_EQ(scene.force("UniformGravity0"), first);
  EXPECT_EQ(scene.force("more"), second);
  EXPECT_EQ(scene.force("Spring0"), spring);
  EXPECT_THROW(scene.add(UniformGravity<2>{}, "bob"), InvalidScene);
}

}  // namespace
}  // namespace dalembert::scene_values_test
