#include <dalembert/dalembert.h>
#include <dalembert/models/heavy_top.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <tuple>

/// Scenes whose linear terms have an energy > 0 that nothing changes: what changes it at higher order
/// decides. Averaged over a vibration of frequency 1, x = a cos t, with a force f beside the spring,
///
///   a' = -<f sin t>,    <sin^4> = 3/8,   <cos^2 sin^2> = 1/8,                                         (1)
///
/// so that v^3 gives a' = 3 a^3/8 and x^2 v gives a' = a^3/8: both grow, without end.

namespace dalembert::higher_order_test {
namespace {

using testing::HasSubstr;

template <int D>
NormalModes<D> modes_of(const Scene<D>& scene, const ModesOptions& options = {}) {
  return normal_modes(scene, equilibrium(scene), options);
}

void expect(Stability stability, const auto& modes) {
  EXPECT_EQ(modes.stability(), stability) << modes.describe();
}

auto cube(const auto& x) { return x * x * x; }

/// A rotor on a spring of its own frequency 1, with another torque f(x, v).
Stability of_rotor(const auto& f) {
  Scene<2> scene;
  const auto rotor = scene.add_rotor({.inertia = 1.0}, "rotor");
  scene.add(force_law(points(rotor), [f](auto x, auto v) { return vec(-x[0] + f(x[0], v[0])); }));
  return modes_of(scene).stability();
}

/// A particle with this force, which contains what holds it.
Stability of_particle(const auto& f) {
  Scene<2> scene;
  const auto particle = scene.add_particle({.mass = 1.0});
  scene.add(force_law(points(particle), f));
  return modes_of(scene).stability();
}

TEST(HigherOrder, CubicDrivingOfAVibrationIsNotCalledStable) {
  EXPECT_EQ(of_rotor([](auto, auto v) { return cube(v); }), Stability::undecided);
  EXPECT_EQ(of_rotor([](auto, auto v) { return 1e-3 * cube(v); }), Stability::undecided);
  EXPECT_EQ(of_rotor([](auto, auto v) { return v * v * cube(v); }), Stability::undecided);
  EXPECT_EQ(of_rotor([](auto x, auto v) { return x * x * v; }), Stability::undecided);
  EXPECT_NE(of_rotor([](auto, auto v) { return v * sqrt(v * v + 1e-300); }), Stability::stable);
}

TEST(HigherOrder, GrowthByCubicDrivingIsThatOfItsAverage) {
  // The truth that the verdict is about, by (1): 1/a^2 = 1/a0^2 - 3 t/4, to a^2 of itself.
  Scene<2> scene;
  const double a0 = 0.1, t = 90.0;
  const auto rotor = scene.add_rotor({.inertia = 1.0, .angle = a0}, "rotor");
  scene.add(force_law(points(rotor), [](auto x, auto v) { return vec(-x[0] + cube(v[0])); }));
  const auto run = simulate(scene, {.t_end = t, .samples = 2, .tolerance = 1e-9});
  const double a = 1.0 / std::sqrt(1.0 / (a0 * a0) - 0.75 * t);
  EXPECT_NEAR(std::hypot(run.angle(rotor, 1), run.angular_velocity(rotor, 1)), a, a * a * a);
}

TEST(HigherOrder, DampingAndWhatDoesNoWorkStayStable) {
  EXPECT_EQ(of_rotor([](auto, auto v) { return -cube(v); }), Stability::stable);
  EXPECT_EQ(of_rotor([](auto, auto v) { return v * v * cube(v) - 0.1 * cube(v); }), Stability::stable);
  EXPECT_EQ(of_rotor([](auto x, auto v) { return -x * x * v; }), Stability::stable);
  // Of one degree of freedom a position alone has a potential; and x'' = -x + v^2 has, run backwards, the
  // same motions: its orbits close.
  EXPECT_EQ(of_rotor([](auto x, auto) { return x * x - 3.0 * cube(x); }), Stability::stable);
  EXPECT_EQ(of_rotor([](auto, auto v) { return v * v; }), Stability::stable);
}

TEST(HigherOrder, LinearDampingDecidesHoweverItIsDriven) {
  EXPECT_EQ(of_rotor([](auto, auto v) { return -1e-6 * v + cube(v); }), Stability::stable);
}

TEST(HigherOrder, CirculationOfThirdOrderIsNotCalledStable) {
  // On the circular orbit r = a the force a^3 along it turns: r^2 theta'' = a^4, and a grows.
  EXPECT_EQ(of_particle([](auto r, auto) {
              const auto q = r.squaredNorm();
              return vec(-r.x() - r.y() * q, -r.y() + r.x() * q);
            }),
            Stability::undecided);
}

TEST(HigherOrder, ForcesWithACurlOfZeroStayStable) {
  // V = |r|^2/2 + |r|^4/4, and x^2/2 + y^2 + x^3 y.
  EXPECT_EQ(of_particle([](auto r, auto) {
              const auto q = r.squaredNorm();
              return vec(-r.x() - r.x() * q, -r.y() - r.y() * q);
            }),
            Stability::stable);
  EXPECT_EQ(of_particle([](auto r, auto) {
              return vec(-r.x() - 3.0 * r.x() * r.x() * r.y(), -2.0 * r.y() - cube(r.x()));
            }),
            Stability::stable);
}

/// A field of 3 + x + x y across the plane, and a drag of c v^3.
Stability in_magnetic_field(double c) {
  return of_particle([c](auto r, auto v) {
    const auto B = 3.0 + r.x() + r.x() * r.y(), drag = c * v.squaredNorm();
    return vec(-r.x() + B * v.y() - drag * v.x(), -2.0 * r.y() - B * v.x() - drag * v.y());
  });
}

TEST(HigherOrder, MagneticForceStaysStable) {
  EXPECT_EQ(in_magnetic_field(0.0), Stability::stable);
  EXPECT_EQ(in_magnetic_field(1.0), Stability::stable);
  EXPECT_EQ(in_magnetic_field(-1.0), Stability::undecided);
}

TEST(HigherOrder, StrongDampingOfAnotherCoordinateHidesNoDriving) {
  for (const double damping : {1.0, 1e4}) {
    EXPECT_EQ(of_particle([damping](auto r, auto v) {
                return vec(-r.x() + cube(v.x()), -2.0 * r.y() - damping * v.y());
              }),
              Stability::undecided);
    EXPECT_EQ(of_particle([damping](auto r, auto v) {
                return vec(-r.x() - cube(v.x()), -2.0 * r.y() - damping * v.y());
              }),
              Stability::stable);
  }
}

TEST(HigherOrder, FreeMotionBesideDecayAsksForNoEnergy) {
  // x'' = -x' + y/2, y'' = -y - y': K is not symmetric, but all but x decays, and x rests wherever it is.
  Scene<2> scene;
  const auto x = scene.add_rotor({.inertia = 1.0}), y = scene.add_rotor({.inertia = 1.0});
  scene.add(force_law(points(x, y), [](auto, auto b, auto v, auto w) {
    return std::make_tuple(vec(-v[0] + 0.5 * b[0]), vec(-b[0] - w[0]));
  }));
  expect(Stability::stable, modes_of(scene));
  // Without drag it moves on, and v^3 drives that.
  for (const double c : {1.0, -1.0}) {
    Scene<2> free;
    const auto rotor = free.add_rotor({.inertia = 1.0});
    free.add(force_law(points(rotor), [c](auto, auto v) { return vec(c * cube(v[0])); }));
    expect(c > 0.0 ? Stability::undecided : Stability::stable, modes_of(free));
  }
}

/// A pendulum of length 1 with a force on its bob.
Stability of_pendulum(const auto& f) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {0.0, -1.0}});
  scene.add(Distance{Fixed<2>{}, bob, 1.0});
  scene.add(force_law(points(bob), f));
  return modes_of(scene).stability();
}

TEST(HigherOrder, WorkIsThatOfMotionsWhichConstraintsAllow) {
  EXPECT_EQ(of_pendulum([](auto, auto v) { return (v.squaredNorm() * v).eval(); }), Stability::undecided);
  EXPECT_EQ(of_pendulum([](auto, auto v) { return (-v.squaredNorm() * v).eval(); }), Stability::stable);
  // Circulatory in the plane, it has a potential on the circle: -x^3/3 along the arc, to lowest order.
  EXPECT_EQ(of_pendulum([](auto r, auto) {
              const auto q = r.x() * r.x();
              return vec(-r.y() * q, r.x() * q);
            }),
            Stability::stable);
}

TEST(HigherOrder, DrivingInSpaceIsNamed) {
  for (const double c : {1.0, -1.0}) {
    Scene<3> scene;
    const auto particle = scene.add_particle({.mass = 1.0});
    scene.add(potential(points(particle), [](auto r) { return 0.5 * r.squaredNorm(); }));
    scene.add(force_law(points(particle), [c](auto, auto v) { return (c * v.squaredNorm() * v).eval(); }),
              "wind");
    const auto modes = modes_of(scene);
    expect(c > 0.0 ? Stability::undecided : Stability::stable, modes);
    if (c > 0.0) {
      EXPECT_THAT(modes.describe(), HasSubstr("\"wind\", which has no potential, does work"));
    }
  }
}

TEST(HigherOrder, WorkIsThatOfVelocitiesRelativeToASteadyMotion) {
  for (const double c : {1.0, -1.0}) {
    Scene<2> scene;
    const auto rotor = scene.add_rotor({.inertia = 1.0}, "rotor");
    scene.add(force_law(points(rotor), [c](auto x, auto v) { return vec(-x[0] + c * cube(v[0])); }));
    (void)scene.add_rotor({.inertia = 1.0, .angular_velocity = 3.0}, "spin");
    expect(c > 0.0 ? Stability::undecided : Stability::stable, normal_modes(scene, steady(scene)));

    Scene<2> governed;
    const auto spin = governed.add_rotor({.inertia = 1.0, .angular_velocity = 3.0}, "spin");
    governed.add(force_law(points(spin), [c](auto, auto v) { return vec(c * cube(v[0] - 3.0)); }));
    expect(c > 0.0 ? Stability::undecided : Stability::stable, normal_modes(governed, steady(governed)));
  }
}

TEST(HigherOrder, WorkIsThatOfVelocitiesRelativeToATurningFrame) {
  const double rate = 5.0;
  for (const double c : {1.0, -1.0}) {
    Scene<3> scene("bead on a turning hoop");
    scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
    const auto bead = scene.add_particle({.mass = 0.1, .position = {0.6, 0.0, -0.8}});
    scene.add(OnSurface{bead, Sphere<3>{.radius = 1.0}});
    scene.add(RotatingPlane{bead, Axis{}, [=](auto t) { return rate * t; }});
    scene.add(force_law(points(bead),
                        [c](auto, auto v) { return vec(0.0 * v.z(), 0.0 * v.z(), c * cube(v.z())); }));
    const auto found = equilibrium(scene, {.turning = {.rate = {0.0, 0.0, rate}}});
    expect(c > 0.0 ? Stability::undecided : Stability::stable, normal_modes(scene, found));
  }
}

TEST(HigherOrder, TopThatSleepsByItsMomentumIsNotCalledStableWithDrag) {
  // Where H + c J is the energy, a loss of H proves nothing.
  for (const double c : {1.0, 0.0, -1.0}) {
    const auto built = models::HeavyTop{.spin = 1.2 * models::HeavyTop::critical_spin()}.scene();
    Scene<3> scene = built.scene;
    scene.add(force_law(points(built.top.point({0.0, 0.0, 0.0})),
                        [c](auto, auto v) { return (c * v.squaredNorm() * v).eval(); }));
    expect(c == 0.0 ? Stability::stable : Stability::undecided, normal_modes(scene, steady(scene)));
  }
}

/// 700 rotors on springs, apart or each tied to the last; one is driven, or damped, by c v^3.
Scene<2> many_rotors(bool tied, double c) {
  Scene<2> scene;
  std::optional<Rotor> last;
  for (int i = 0; i < 700; ++i) {
    const auto rotor = scene.add_rotor({.inertia = 1.0});
    scene.add(potential(points(rotor), [k = 1.0 + i](auto x) { return 0.5 * k * x[0] * x[0]; }));
    if (tied && last)
      scene.add(
          potential(points(*last, rotor), [](auto x, auto y) { return 0.005 * (x - y).squaredNorm(); }));
    if (tied && i % 10 == 0)
      scene.add(force_law(points(rotor), [](auto, auto v) { return vec(-0.1 * v[0]); }));
    if (i == 633) scene.add(force_law(points(rotor), [c](auto, auto v) { return vec(c * cube(v[0])); }));
    last = rotor;
  }
  return scene;
}

TEST(HigherOrder, DrivingAmongManyCoordinatesIsFoundOutsideOfTheLowestModes) {
  for (const bool tied : {true, false}) {
    expect(Stability::undecided, modes_of(many_rotors(tied, 1.0), {.lowest = 3}));
    expect(Stability::stable, modes_of(many_rotors(tied, -1.0), {.lowest = 3}));
  }
}

}  // namespace
}  // namespace dalembert::higher_order_test
