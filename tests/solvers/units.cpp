#include "scenes.h"

#include <gtest/gtest.h>

namespace dalembert::units_test {
namespace {

struct Units {
  double length, time, mass;
};

constexpr Units nano{1e9, 1e9, 1e6};             // nanometres, nanoseconds, milligrams
constexpr Units giga{1e-9, 1.0 / 3600.0, 1e-3};  // gigametres, hours, tonnes

/// Two bobs with a rod, a spring and a damper, in units other than metres, seconds and kilograms.
Scene<2> damped_scene(const Units& u) {
  Scene<2> scene;
  const double speed = u.length / u.time, acceleration = speed / u.time, force = u.mass * acceleration;
  scene.add(UniformGravity<2>{{0.0, -9.81 * acceleration}});
  const auto a = scene.add_particle(
      {.mass = 1.0 * u.mass, .position = {1.0 * u.length, 0.0}, .velocity = {0.0, 0.5 * speed}});
  const auto b = scene.add_particle({.mass = 2.0 * u.mass, .position = {1.5 * u.length, 0.5 * u.length}});
  scene.add(Distance{Fixed<2>{}, a, 1.0 * u.length});
  scene.add(Spring{a, b, 40.0 * force / u.length, 0.5 * u.length});
  scene.add(Damper{Fixed<2>{}, b, 2.0 * force / speed});
  return scene;
}

/// At this tolerance round-off has no say in the choice of steps. (At 1e-8 it has, through the
/// multipliers: the scene with springs takes 665 steps or 748 according to how its numbers round, also
/// for a change of the mass unit by 1.1.)
long steps(const Scene<2>& scene, double t_end) {
  return simulate(scene, {.t_end = t_end, .tolerance = 1e-6}).statistics().steps;
}

/// Within 5 %: units change no number but for its rounding.
void expect_as_many(long actual, long expected) {
  EXPECT_NEAR(static_cast<double>(actual), static_cast<double>(expected),
              0.05 * static_cast<double>(expected));
}

TEST(Units, PendulumTakesAsManyStepsInAnyUnits) {
  const long metres = steps(Pendulum().scene, 3.0);
  for (const Units& u : {nano, giga}) {
    expect_as_many(steps(Pendulum(u.length, u.time, u.mass).scene, 3.0 * u.time), metres);
  }
}

TEST(Units, SpringAndDamperTakeAsManyStepsInAnyUnits) {
  const long metres = steps(damped_scene({1.0, 1.0, 1.0}), 3.0);
  for (const Units& u : {nano, giga}) expect_as_many(steps(damped_scene(u), 3.0 * u.time), metres);
}

// A thrown stone has no length of its own but that of its path.
TEST(Units, ThrownStoneTakesAsManyStepsInAnyUnits) {
  const auto thrown = [](const Units& u) {
    Scene<2> scene;
    const double speed = u.length / u.time;
    scene.add(UniformGravity<2>{{0.0, -9.81 * speed / u.time}});
    scene.add_particle({.mass = u.mass, .velocity = {3.0 * speed, 4.0 * speed}});
    return scene;
  };
  const long metres = steps(thrown({1.0, 1.0, 1.0}), 1.0);
  for (const Units& u : {nano, giga}) expect_as_many(steps(thrown(u), 1.0 * u.time), metres);
}

TEST(Units, BeadOnASphereTakesAsManyStepsInAnyUnits) {
  const auto on_sphere = [](const Units& u) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -9.81 * u.length / (u.time * u.time)}});
    const auto bead = scene.add_particle({.mass = u.mass, .position = {1.0 * u.length, 0.0}});
    scene.add(OnCurve{bead, Sphere<2>{{0.0, 0.0}, 1.0 * u.length}});
    return scene;
  };
  const long metres = steps(on_sphere({1.0, 1.0, 1.0}), 3.0);
  for (const Units& u : {nano, giga}) expect_as_many(steps(on_sphere(u), 3.0 * u.time), metres);
}

// Powers of two round nothing: the same scene to the last bit.
TEST(Units, PowersOfTwoChangeNothingAtAll) {
  const double u = 0x1p30;
  const Pendulum metres, doubled(u, u, 0x1p20);
  const auto run = simulate(metres.scene, {.t_end = 3.0, .tolerance = 1e-8});
  const auto other = simulate(doubled.scene, {.t_end = 3.0 * u, .tolerance = 1e-8});
  EXPECT_EQ(run.statistics().steps, other.statistics().steps);
  for (std::size_t i = 0; i < run.size(); ++i) {
    EXPECT_EQ(Vec<2>(run.position(metres.bob, i) * u), other.position(doubled.bob, i));
  }
}

// A pendulum a thousand lengths away is the same pendulum: same steps, same forces.
TEST(Units, TheOriginIsOfNoAccount) {
  const auto hung_at = [](double x) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    const auto bob = scene.add_particle({.mass = 1.0, .position = {x + 1.0, 0.0}});
    scene.add(Distance{Fixed<2>{{x, 0.0}}, bob, 1.0});
    return scene;
  };
  expect_as_many(steps(hung_at(1000.0), 3.0), steps(hung_at(0.0), 3.0));
}

// Two slopes of 45 degrees meet in an arc of 1e-6 m; where the bead is let go, at x = 1, the curve's radius
// is 1e12 m, which it never sees. It slides sqrt 2 at g/sqrt 2 in 2/sqrt g and as far up again, but for what
// the arc takes, 1e-6 ln 1e6. The scene is as long as its weight could carry it, g t^2 = 16, in at most 1000
// steps.
TEST(Units, ARadiusFarBeyondTheWayOfABeadIsNotItsLength) {
  constexpr double tolerance = 1e-8, arc = 1e-6;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bead = scene.add_particle({.mass = 1.0, .position = {1.0, 1.0}});
  scene.add(OnCurve{bead, [](auto r) {
                      using std::sqrt;
                      return r.y() - sqrt(r.x() * r.x() + arc * arc);
                    }});
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    const auto run =
        simulate(scene, {.t_end = 4.0 / std::sqrt(9.81), .tolerance = tolerance, .stepper = stepper});
    EXPECT_NEAR(run.position(bead, run.size() - 1).x(), -1.0, 1000.0 * 16.0 * tolerance + 14.0 * arc);
    EXPECT_LE(run.statistics().steps, 1000);
  }
}

// Nor has a charge that starts at the cusp of a cycloid.
TEST(Units, CycloidTakesAsManyStepsInAnyUnits) {
  const auto charge = [](const Units& u) {
    Scene<2> scene;
    const double acceleration = u.length / (u.time * u.time), B = 3.0 * u.mass / u.time;
    scene.add(UniformGravity<2>{{0.0, -9.81 * acceleration}});
    const auto p = scene.add_particle({.mass = u.mass});
    scene.add(force_law(points(p), [B](auto, auto v) { return vec(B * v.y(), -B * v.x()); }));
    return scene;
  };
  const long metres = steps(charge({1.0, 1.0, 1.0}), 10.0);
  for (const Units& u : {nano, giga}) expect_as_many(steps(charge(u), 10.0 * u.time), metres);
}

}  // namespace
}  // namespace dalembert::units_test
