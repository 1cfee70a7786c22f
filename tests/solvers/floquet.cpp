#include <dalembert/dalembert.h>
#include <dalembert/models/driven_pivot.h>
#include <dalembert/models/plane_pendulum.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace dalembert::floquet_test {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// The monodromy matrix is known to 1e-11 of itself and 1 (see floquet); it may be non-normal, a few times 1.
constexpr double known = 1e-10;

struct Hung {
  Scene<2> scene{"hung"};
  Particle<2> bob = scene.add_particle({.mass = 2.0, .position = {0.0, -1.0}}, "bob");

  explicit Hung(double drag = 0.0) {
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");
    if (drag > 0.0) scene.add(LinearDrag{bob, drag});
  }
};

TEST(Floquet, RestingSceneHasTheMultipliersOfItsModes) {
  // u'' + (d/m) u' + (g/l) u = 0 over T: exp(s T).
  for (const double drag : {0.0, 1.2}) {
    const Hung hung(drag);
    const auto found = floquet(hung.scene, 0.7);
    ASSERT_EQ(found.multipliers.size(), 2U);
    const double decay = drag / 4.0, omega = std::sqrt(9.81 - decay * decay);
    const auto expected = std::polar(std::exp(-0.7 * decay), 0.7 * omega);
    EXPECT_NEAR(found.multipliers[0].real(), expected.real(), known);
    EXPECT_NEAR(std::abs(found.multipliers[0].imag()), expected.imag(), known);
    EXPECT_EQ(found.stability(), drag > 0.0 ? Stability::stable : Stability::undecided);
  }
}

/// Springs at their natural lengths exert round-off, and a pin what balances it. The body vibrates about its
/// pin with omega^2 = k b^2 / I, b the arm of the spring's force.
TEST(Floquet, UnloadedSpringsOfWhatRestsHaveNoPeriodToMiss) {
  constexpr double k = 1e4, mass = 1.0, inertia = 0.3, period = 0.05;
  const Vec<2> centre{0.3, 0.7}, pin{0.2, 0.1}, foot{1.3, -0.9};
  for (int i = 0; i < 40; ++i) {
    const Vec<2> hook{0.1 * i - 2.1, 1.1};
    Scene<2> scene("pinned");
    const auto body = add_body(
        scene, BodyState<2>{.mass = mass, .inertia = inertia, .centre = centre, .angle = 0.3}, "body");
    scene.add(Coincident{Fixed<2>{pin}, body.point_at(pin)}, "pin");
    scene.add(Spring{Fixed<2>{foot}, body.point_at(hook), k, (hook - foot).norm()}, "spring");
    const Vec<2> r = hook - pin, along = (hook - foot).normalized();
    const double arm = r.x() * along.y() - r.y() * along.x();
    const double omega = std::abs(arm) * std::sqrt(k / (inertia + mass * (centre - pin).squaredNorm()));
    const auto found = floquet(scene, period);
    ASSERT_EQ(found.multipliers.size(), 2U) << i;
    // Rates far above 1/period amplify what is known, of the matrix, by as much.
    EXPECT_NEAR((found.multipliers[0] + found.multipliers[1]).real(), 2.0 * std::cos(omega * period),
                known * std::max(1.0, omega))
        << i;
  }
}

TEST(Floquet, RepeatedAndCompliantConstraintsChangeNoMultiplier) {
  Hung twice;
  twice.scene.add(Distance{twice.bob, Fixed<2>{}, 1.0});
  EXPECT_NEAR(floquet(twice.scene, 0.7).multipliers[0].real(), std::cos(0.7 * std::sqrt(9.81)), known);

  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 2.0, .position = {0.0, -1.0}});
  scene.add(compliant(Distance{Fixed<2>{}, bob, 1.0}, 0.01));
  // Along the spring omega^2 = k/m = 50; across there is no force: the pair 1, 1.
  const auto found = floquet(scene, 0.3);
  ASSERT_EQ(found.multipliers.size(), 4U);
  std::complex<double> trace = 0.0;
  for (const auto& m : found.multipliers) trace += m;
  EXPECT_NEAR(trace.real(), 2.0 + 2.0 * std::cos(0.3 * std::sqrt(50.0)), known);
}

TEST(Floquet, SkateHasNoMultiplierForWhatItsBladeForbids) {
  // Along the blade a spring, w^2 = k/m; across, displacement stays as it is: 1. No velocity across.
  Scene<2> scene;
  const auto skate = scene.add_particle({.mass = 2.0});
  scene.add(nonholonomic(points(skate), [](auto, auto v) { return v.y(); }));
  scene.add(potential(points(skate), [](auto r) { return 5.0 * r.x() * r.x(); }));
  const auto found = floquet(scene, 0.4);
  ASSERT_EQ(found.multipliers.size(), 3U);
  std::complex<double> trace = 0.0;
  for (const auto& m : found.multipliers) trace += m;
  EXPECT_NEAR(trace.real(), 1.0 + 2.0 * std::cos(0.4 * std::sqrt(5.0)), known);
}

/// A pendulum upright on a pivot that vibrates vertically, x = g/(l omega^2), omega = 10 and l = 1.
models::DrivenPivot upright(double amplitude, double x) {
  auto pivot = models::DrivenPivot::vertical(amplitude);
  pivot.gravity = 100.0 * x;
  pivot.angle = pi;
  return pivot;
}

TEST(Floquet, ProductOfMultipliersMatchesDrag) {
  // Liouville: det of the monodromy matrix is exp of the integral of the divergence, -(drag/mass) T.
  auto built = upright(0.1, 0.004).scene();
  built.scene.add(force_law(points(built.bob), [](auto t, auto, auto v) {
    return (-0.3 * (v - vec(0.0 * t, sin(10.0 * t)))).eval();  // against what moves with the pivot
  }));
  const auto found = floquet(built.scene, 2.0 * pi / 10.0);
  ASSERT_EQ(found.multipliers.size(), 2U);
  EXPECT_NEAR((found.multipliers[0] * found.multipliers[1]).real(), std::exp(-0.3 * 2.0 * pi / 10.0), known);
  EXPECT_EQ(found.stability(), Stability::stable);
}

TEST(Floquet, MultipliersMeetAtOneOnKapitzasBoundary) {
  // g/(l omega^2) at A/l = 0.05, 0.1, 0.2: -a_0(q)/4 of Mathieu's equation, q = 2 A/l, to the digits
  // published. There the multipliers meet at 1; their sum changes by about (2 pi)^2 per unit of x, so that x
  // is known to 1e-10/40.
  const double amplitudes[] = {0.05, 0.1, 0.2},
               published[] = {0.00124863595013, 0.00497832408961, 0.0196623219494};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto excess = [&](double x) {
      const auto found = floquet(upright(amplitudes[i], x).scene().scene, 2.0 * pi / 10.0);
      return (found.multipliers[0] + found.multipliers[1]).real() - 2.0;
    };
    const double x = published[i];
    EXPECT_NEAR(excess(x), 0.0, known + 40.0 * 1e-14);
    EXPECT_GT(excess(x + 1e-11), known);
    EXPECT_LT(excess(x - 1e-11), -known);
  }
}

TEST(Floquet, LibrationHasTheMultiplierOneTwice) {
  // Along the motion nothing changes, and another amplitude has another period: a Jordan block, whose
  // eigenvalues are known to the square root.
  const models::PlanePendulum pendulum;
  const auto found = floquet(pendulum.scene().scene, pendulum.period());
  ASSERT_EQ(found.multipliers.size(), 2U);
  for (const auto& m : found.multipliers) EXPECT_NEAR(std::abs(m - 1.0), 0.0, 10 * std::sqrt(known));
  EXPECT_EQ(found.stability(), Stability::undecided);
}

TEST(Floquet, MultipliersDoNotDependOnTheUnitOfTime) {
  // A bob goes round on a turntable's rod without gravity, at one turn in a time unit of any size: its
  // distance and its turning are 1 and 1, coupled. (In small units velocity rows are far longer than position
  // rows.)
  for (const double unit : {1.0, 1e-12, 1e12}) {
    const double rate = 2.0 * pi / unit;
    Scene<2> scene;
    const auto bob = scene.add_particle({.mass = 2.0, .position = {1.0, 0.0}, .velocity = {0.0, rate}});
    scene.add(Distance{Fixed<2>{}, bob, 1.0});
    const auto found = floquet(scene, unit);
    ASSERT_EQ(found.multipliers.size(), 2U) << unit;
    // A double multiplier is known to the square root.
    for (const auto& m : found.multipliers) EXPECT_NEAR(std::abs(m - 1.0), 0.0, std::sqrt(known)) << unit;
  }
}

TEST(Floquet, MotionThatDoesNotReturnIsRefused) {
  const models::PlanePendulum pendulum;
  EXPECT_THAT([&] { (void)floquet(pendulum.scene().scene, 1.0); },
              ThrowsMessage<NoEquilibrium>(HasSubstr("is not periodic")));
  const Hung hung;
  EXPECT_THAT([&] { (void)floquet(hung.scene, -1.0); }, ThrowsMessage<InvalidArgument>(HasSubstr("period")));
}

TEST(Floquet, WheelThatTurnsRoundHasMultipliers) {
  // The wheel alone has the double multiplier 1; beside it a bead of omega = 2, cos(2) +- i sin(2).
  Scene<2> scene;
  const auto wheel = scene.add_rotor({.inertia = 1.0, .angular_velocity = 2.0 * pi});
  const auto bead = scene.add_particle({.mass = 1.0});
  scene.add(
      potential(points(bead, Fixed<2>{{1.0, 0.0}}), [](auto r, auto) { return 2.0 * r.squaredNorm(); }));
  const auto found = floquet(scene, 1.0);
  ASSERT_EQ(found.multipliers.size(), 6U);
  std::complex<double> trace = 0.0;
  for (const auto& m : found.multipliers) trace += m;
  EXPECT_NEAR(trace.real(), 2.0 + 4.0 * std::cos(2.0), 10 * known);
  EXPECT_THROW((void)floquet(scene, 0.9), NoEquilibrium);
  // Wound up against a spring it turns round too, but more slowly.
  scene.add(potential(points(wheel), [](auto phi) { return 1e-3 * phi[0] * phi[0]; }));
  EXPECT_THROW((void)floquet(scene, 1.0), NoEquilibrium);
}

TEST(Floquet, PeriodOtherThanThatOfTheForcesIsRefused) {
  // Upright on its pivot, at rest in any case; the pivot's period is 2 pi/10.
  auto built = upright(0.1, 0.004).scene();
  EXPECT_THROW((void)floquet(built.scene, 0.5), NoEquilibrium);
}

TEST(Floquet, FixedSceneHasNoMultipliers) {
  Scene<2> scene;
  const auto held = scene.add_particle({.mass = 1.0, .position = {0.0, -1.0}});
  scene.add(Coincident{Fixed<2>{{0.0, -1.0}}, held});
  EXPECT_TRUE(floquet(scene, 1.0).multipliers.empty());
}

/// Neighbours of a vibration in |x| + x^2/2 are periodic, too: the multipliers are 1, 1. A disturbance jumps
/// where the force does.
TEST(Floquet, StiffnessThatSwitchesWithTimeIsRefusedAsSuch) {
  // At rest, and so smooth: the spring is 5 and 1 by turns of 1.
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0});
  scene.add(OnCurve{bob, Plane<2>{}});
  scene.add(potential(points(bob), [](auto t, auto r) {
    const auto since = t - 2.0 * floor(t / 2.0);
    return 0.5 * (since < 1.0 ? 5.0 : 1.0) * r.x() * r.x();
  }));
  EXPECT_THAT([&] { (void)floquet(scene, 2.0); },
              ThrowsMessage<NoEquilibrium>(HasSubstr("or the stiffness of its forces, is not smooth")));
}

TEST(Floquet, ForceThatJumpsIsRefused) {
  constexpr double a = 1.0;
  Scene<2> scene;
  const auto body = scene.add_particle({.mass = 1.0, .position = {a, 0.0}}, "body");
  scene.add(OnCurve{body, Plane<2>{}});
  scene.add(potential(points(body), [](auto r) { return abs(r.x()) + 0.5 * r.x() * r.x(); }));
  EXPECT_THAT([&] { (void)floquet(scene, 4.0 * std::acos(1.0 / (1.0 + a))); },
              ThrowsMessage<NoEquilibrium>(HasSubstr("forces jump at t = ")));
}

}  // namespace
}  // namespace dalembert::floquet_test
