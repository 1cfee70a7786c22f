#include "../finite_differences.h"
#include <dalembert/dalembert.h>
#include <dalembert/models/cone.h>
#include <dalembert/models/hoop_about_diameter.h>
#include <dalembert/models/sliding_pivot.h>
#include <dalembert/solvers/equilibrium/linear_terms.h>
#include <dalembert/solvers/equilibrium/lowest_modes.h>
#include <dalembert/solvers/equilibrium/tangent_modes.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <vector>

namespace dalembert::normal_modes_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Terms of size 1 to 100 known to some roundings, over matrices of a few rows.
constexpr double rounding = 1e3 * epsilon;

struct Bob {
  Scene<2> scene{"bob"};
  Particle<2> bob;

  explicit Bob(double height) {
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    bob = scene.add_particle({.mass = 2.0, .position = {0.0, height}}, "bob");
    scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");
  }
  [[nodiscard]] NormalModes<2> modes() const { return normal_modes(scene, equilibrium(scene)); }
};

TEST(NormalModes, PendulumVibratesAsTheRootOfGravityOverLength) {
  const Bob pendulum(-1.0);
  const auto modes = pendulum.modes();
  ASSERT_EQ(modes.size(), 1U);
  EXPECT_NEAR(modes.frequency(0), std::sqrt(9.81), rounding);
  EXPECT_EQ(modes.damping(0), 0.0);
  EXPECT_EQ(modes.stability(), Stability::stable);
  EXPECT_NEAR(std::abs(modes.shape(0, pendulum.bob).x()), 1.0, rounding);
  EXPECT_NEAR(std::abs(modes.shape(0, pendulum.bob).y()), 0.0, rounding);
}

TEST(NormalModes, PendulumUpsideDownIsUnstable) {
  const auto modes = Bob(1.0).modes();
  EXPECT_NEAR(modes.damping(0), -std::sqrt(9.81), rounding);
  EXPECT_EQ(modes.stability(), Stability::unstable);
}

TEST(NormalModes, DecayAtHalfTheDragOverTheMass) {
  // 2 u'' + 1.2 u' + 2 (9.81) u = 0: s = -0.3 +- i sqrt(9.81 - 0.09).
  Bob damped(-1.0);
  damped.scene.add(LinearDrag{damped.bob, 1.2});
  const auto modes = damped.modes();
  ASSERT_EQ(modes.size(), 1U);
  EXPECT_NEAR(modes.damping(0), 0.3, rounding);
  EXPECT_NEAR(modes.frequency(0), std::sqrt(9.72), rounding);
  EXPECT_EQ(modes.stability(), Stability::stable);
}

TEST(NormalModes, OverdampedModesAreTwoDecays) {
  // s^2 + 8 s + 9.81 = 0.
  Bob damped(-1.0);
  damped.scene.add(LinearDrag{damped.bob, 16.0});
  const auto modes = damped.modes();
  ASSERT_EQ(modes.size(), 2U);
  EXPECT_NEAR(modes.damping(0), 4.0 - std::sqrt(16.0 - 9.81), 10 * rounding);
  EXPECT_NEAR(modes.damping(1), 4.0 + std::sqrt(16.0 - 9.81), 10 * rounding);
}

TEST(NormalModes, CompliantRodHasTheModesOfPendulumAndSpring) {
  for (const double k : {1e4, 1e8}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    const auto bob = scene.add_particle({.mass = 2.0, .position = {0.0, -1.0}});
    scene.add(compliant(Distance{Fixed<2>{}, bob, 1.0}, 1.0 / k));
    const auto modes = normal_modes(scene, equilibrium(scene));
    ASSERT_EQ(modes.size(), 2U);
    // Of a matrix with entries to k/m each eigenvalue omega^2 is known to roundings of that.
    EXPECT_NEAR(modes.frequency(0), std::sqrt(9.81 / (1.0 + 19.62 / k)), rounding + 10 * epsilon * k);
    EXPECT_NEAR(modes.frequency(1), std::sqrt(k / 2.0), std::sqrt(k) * rounding);
  }
}

/// Of three rigid masses on rods of stiffness k, each along n at the arm b about their centre, the sum of
/// omega^2 is the trace of K/M: of k (1/(3 m) + b^2/I) for each rod. What the rods exert is round-off.
TEST(NormalModes, ATriangleOnUnloadedRodsIsInItsOwnEquilibrium) {
  constexpr double k = 1e6;
  for (int i = 0; i < 200; ++i) {
    Scene<2> scene("triangle");
    const std::array<Vec<2>, 3> corners{Vec<2>{0.0, 0.0}, {1.0, 0.01 * i - 0.7}, {0.4, 0.9}},
        feet{Vec<2>{-1.1, 0.3}, {2.3, 0.4}, {0.5, 2.2}};
    const Vec<2> centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    std::vector<Particle<2>> all;
    for (const auto& r : corners) all.push_back(scene.add_particle({.mass = 1.0, .position = r}));
    double moment = 0.0, trace = 0.0;
    for (const auto& r : corners) moment += (r - centre).squaredNorm();
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t next = (j + 1) % 3;
      scene.add(Distance{all[j], all[next], (corners[j] - corners[next]).norm()});
      const Vec<2> rod = corners[j] - feet[j], arm = corners[j] - centre;
      scene.add(compliant(Distance{Fixed<2>{feet[j]}, all[j], rod.norm()}, 1.0 / k));
      const double b = (arm.x() * rod.y() - arm.y() * rod.x()) / rod.norm();
      trace += k * (1.0 / 3.0 + b * b / moment);
    }
    const auto rest = equilibrium(scene);
    const auto modes = normal_modes(scene, rest);
    ASSERT_EQ(modes.size(), 3U) << i;
    double sum = 0.0;
    for (std::size_t m = 0; m < 3; ++m) sum += modes.frequency(m) * modes.frequency(m);
    EXPECT_NEAR(sum, trace, trace * rounding) << i;
    // A force of 1e-5 is a hundred times the round-off of these rods.
    scene.add(force_law(points(all[0]), [](auto t, auto, auto) { return vec(1e-5 + 0.0 * t, 0.0 * t); }));
    EXPECT_THROW((void)normal_modes(scene, rest), InvalidArgument) << i;
  }
}

TEST(NormalModes, RepeatedConstraintsChangeNoMode) {
  Bob twice(-1.0);
  twice.scene.add(Distance{twice.bob, Fixed<2>{}, 1.0});
  EXPECT_NEAR(twice.modes().frequency(0), std::sqrt(9.81), rounding);
}

TEST(NormalModes, NameFreeMotionsAndDoNotCallThemUnstable) {
  // mex24: the block slides with its bob; omega^2 = (g/L)(1 + m/M).
  const auto built = models::SlidingPivot{.block_mass = 2.0, .bob_mass = 1.0, .angle = 0.3}.scene();
  const auto modes = normal_modes(built.scene, equilibrium(built.scene));
  ASSERT_EQ(modes.size(), 2U);
  EXPECT_TRUE(modes.is_free(0));
  EXPECT_EQ(modes.eigenvalue(0), 0.0);
  EXPECT_FALSE(modes.is_free(1));
  EXPECT_NEAR(modes.frequency(1), std::sqrt(9.81 * 1.5), 10 * rounding);
  EXPECT_EQ(modes.stability(), Stability::stable);
  EXPECT_THAT(modes.describe(), HasSubstr("free motion of \"particle0\" \"particle1\""));
}

TEST(NormalModes, DoNotDecideWhereTermsOfHigherOrderDo) {
  for (const double quartic : {1.0, -1.0}) {
    Scene<2> scene;
    const auto bead = scene.add_particle({.mass = 2.0});
    scene.add(potential(points(bead), [quartic](auto r) {
      const auto y2 = r.y() * r.y();
      return 5.0 * r.x() * r.x() + quartic * y2 * y2;
    }));
    const auto modes = normal_modes(scene, equilibrium(scene));
    EXPECT_EQ(modes.stability(), Stability::undecided);
    EXPECT_FALSE(modes.is_free(0));
    EXPECT_NEAR(modes.frequency(1), std::sqrt(5.0), rounding);
  }
}

TEST(NormalModes, BeadHeldUpByAHoopVibrates) {
  // mex39: omega = Omega sin phi0, cos phi0 = g/(R Omega^2).
  const auto built = models::HoopAboutDiameter{.spin = 4.5}.scene();
  const auto modes =
      normal_modes(built.scene, equilibrium(built.scene, {.turning = {.rate = {0.0, 0.0, 4.5}}}));
  const double cosine = 9.81 / 20.25;
  ASSERT_EQ(modes.size(), 1U);
  EXPECT_NEAR(modes.frequency(0), 4.5 * std::sqrt(1.0 - cosine * cosine), 10 * rounding);
  EXPECT_EQ(modes.stability(), Stability::stable);
}

TEST(NormalModes, CircularOrbitIsHeldByGyroscopicForces) {
  // mex133: omega^2 = 3 Omega^2 sin^2 a, and the bead goes round freely. The centrifugal potential has its
  // maximum at the orbit: without Coriolis forces it would be unstable.
  const double Omega = std::sqrt(9.81 / std::tan(0.6));
  const auto built = models::ConeSlide{.half_angle = 0.6, .start_radius = 1.1}.scene();
  const auto modes =
      normal_modes(built.scene, equilibrium(built.scene, {.turning = {.rate = {0.0, 0.0, Omega}}}));
  ASSERT_EQ(modes.size(), 2U);
  EXPECT_TRUE(modes.is_free(0));
  EXPECT_NEAR(modes.frequency(1), std::sqrt(3.0) * Omega * std::sin(0.6), 1e2 * rounding);
  EXPECT_EQ(modes.stability(), Stability::stable);
}

TEST(NormalModes, VibrationsInATurningFrameHaveEnergyOfEitherSign) {
  // x'' - 2 W y' = (W^2 - k) x, y'' + 2 W x' = (W^2 - k) y for a bead of mass 1 on a spring k < W^2:
  // frequencies W +- sqrt(k). The centre is a maximum of the centrifugal and elastic potential: what goes
  // round more slowly than the frame has negative energy, and drag against the frame would make it grow.
  Scene<2> scene;
  const auto bead = scene.add_particle({.mass = 1.0, .position = {1e-3, 0.0}}, "bead");
  scene.add(potential(points(bead), [](auto r) { return 0.5 * 0.16 * r.squaredNorm(); }));
  const auto found = equilibrium(scene, {.turning = {.rate = 1.0}});
  const auto modes = normal_modes(scene, found);
  ASSERT_EQ(modes.size(), 2U);
  EXPECT_NEAR(modes.frequency(0), 0.6, 10 * rounding);
  EXPECT_NEAR(modes.frequency(1), 1.4, 10 * rounding);
  EXPECT_EQ(modes.stability(), Stability::undecided);
}

TEST(NormalModes, RollingBallInABowlHasTheInertiaOfItsSpin) {
  // A wheel of mass m, radius r, inertia I rolls along the bottom of a valley V = k x^2/2 without slipping,
  // v_x = r w: (m + I/r^2) x'' = -k x; the constraint is of velocities, and turning it is no vibration.
  Scene<2> scene;
  const auto centre = scene.add_particle({.mass = 2.0});
  const auto wheel = scene.add_rotor({.inertia = 0.25});
  scene.add(OnCurve{centre, Plane<2>{}});
  scene.add(
      nonholonomic(points(centre, wheel), [](auto, auto, auto v, auto w) { return v.x() - 0.5 * w[0]; }));
  scene.add(potential(points(centre), [](auto r) { return 6.0 * r.x() * r.x(); }));
  const auto modes = normal_modes(scene, equilibrium(scene));
  ASSERT_EQ(modes.size(), 2U);
  EXPECT_EQ(modes.eigenvalue(0), 0.0);  // where the wheel stands when it is in the middle
  EXPECT_NEAR(modes.frequency(1), std::sqrt(12.0 / 3.0), 10 * rounding);
  EXPECT_EQ(modes.stability(), Stability::stable);
}

TEST(NormalModes, EquationsThatChangeWithTimeAreRefused) {
  // At the bottom of a turning hoop the bead rests, but the plane it can move in does not.
  const auto built = models::HoopAboutDiameter{.spin = 2.0, .angle = 0.0}.scene();
  const auto at_rest = equilibrium(built.scene);
  EXPECT_THAT([&] { (void)normal_modes(built.scene, at_rest); },
              ThrowsMessage<InvalidScene>(HasSubstr("change with time")));
  const auto turning = equilibrium(built.scene, {.turning = {.rate = {0.0, 0.0, 2.0}}});
  EXPECT_NEAR(normal_modes(built.scene, turning).frequency(0), std::sqrt(9.81 - 4.0), 10 * rounding);
}

TEST(NormalModes, MoreModesThanThereAreIsRefused) {
  EXPECT_THAT([] { (void)Bob(-1.0).modes().frequency(1); },
              ThrowsMessage<InvalidArgument>(HasSubstr("no mode 1")));
}

/// A chain in space of equal beads of total length, mass and g 1, hung or with springs for rods.
Scene<3> chain(std::size_t beads, double stiffness = 0.0) {
  Scene<3> scene("chain");
  const double l = 1.0 / static_cast<double>(beads);
  scene.add(UniformGravity<3>{{0.0, 0.0, -1.0}});
  std::vector<Particle<3>> all;
  for (std::size_t i = 0; i < beads; ++i) {
    const double depth = l * static_cast<double>(i + 1);
    all.push_back(scene.add_particle({.mass = l, .position = {0.0, 0.0, -depth}}));
    const auto hang = [&](const auto& from) {
      if (stiffness > 0.0) {
        scene.add(compliant(Distance{from, all[i], l}, l / stiffness));
      } else {
        scene.add(Distance{from, all[i], l});
      }
    };
    i == 0 ? hang(Fixed<3>{}) : hang(all[i - 1]);
  }
  return scene;
}

TEST(LowestModes, EqualThoseOfTheDenseMatrix) {
  // Two methods that share the terms alone. Every frequency of a chain in space is double. Either knows
  // omega^2 to roundings of the highest, 4 g N^2 of rods and 4 k N^2 of springs.
  constexpr std::size_t beads = 40;
  for (const double stiffness : {0.0, 1e3}) {
    const Scene<3> scene = chain(beads, stiffness);
    const auto rest = equilibrium(scene);
    const FlatSample at = rest.sample().flat();
    const System system = scene.system();
    const LinearTerms terms =
        linear_terms(system, RotatingFrame(*system.layout(), {}), {at.time, at.q, at.v}, at.lambda);
    const Modes dense = dense_modes(system, terms), sparse = lowest_modes(system, terms, 10);
    ASSERT_EQ(sparse.modes.size(), 10U);
    EXPECT_EQ(sparse.stability, Stability::stable);
    const double highest = 4.0 * beads * beads * std::max(1.0, stiffness);
    for (std::size_t k = 0; k < 10; ++k) {
      const double omega = dense.modes[k].eigenvalue.imag();
      EXPECT_NEAR(sparse.modes[k].eigenvalue.imag(), omega, 100 * epsilon * highest / omega) << k;
    }
  }
}

TEST(LowestModes, FindFreeMotionsAndWhatGrows) {
  // Beads on a wire with springs between them slide freely together; of many pendulums one stands on its
  // head.
  Scene<2> train("train");
  std::vector<Particle<2>> beads;
  for (int i = 0; i < 301; ++i) {
    beads.push_back(train.add_particle({.mass = 1.0, .position = {static_cast<double>(i), 0.0}}));
    train.add(OnCurve{beads.back(), Plane<2>{}});
    if (i > 0) train.add(Spring{beads[beads.size() - 2], beads.back(), 1.0, 1.0});
  }
  const auto modes = normal_modes(train, equilibrium(train), {.lowest = 3});
  EXPECT_TRUE(modes.is_free(0));
  // Free ends: omega_k = 2 sin(k pi/(2 N)).
  for (std::size_t k : {1U, 2U})
    EXPECT_NEAR(modes.frequency(k), 2.0 * std::sin(static_cast<double>(k) * std::acos(-1.0) / 602.0), 1e-10);

  Scene<2> standing("standing");
  standing.add(UniformGravity<2>{{0.0, -1.0}});
  for (int i = 0; i < 301; ++i) {
    const auto bob =
        standing.add_particle({.mass = 1.0, .position = {static_cast<double>(i), i < 300 ? -1.0 : 1.0}});
    standing.add(Distance{Fixed<2>{{static_cast<double>(i), 0.0}}, bob, 1.0});
  }
  const auto unstable = normal_modes(standing, equilibrium(standing), {.lowest = 2});
  EXPECT_NE(unstable.stability(), Stability::stable);
}

TEST(LowestModes, NeedANumberAndHolonomicRows) {
  Scene<3> scene = chain(201);
  const auto rest = equilibrium(scene);
  EXPECT_THAT([&] { (void)normal_modes(scene, rest); }, ThrowsMessage<InvalidScene>(HasSubstr("lowest")));
  const auto skate = scene.add_particle({.mass = 1.0});
  scene.add(Distance{Fixed<3>{{0.0, 0.0, 1.0}}, skate, 1.0});
  scene.add(nonholonomic(points(skate), [](auto, auto v) { return v.y(); }));
  EXPECT_THAT([&] { (void)normal_modes(scene, equilibrium(scene), {.lowest = 3}); },
              ThrowsMessage<InvalidScene>(HasSubstr("nonholonomic")));
}

/// Rotors in a line with springs of stiffness k between them and to the walls, damping a M + b K.
struct DampedLine {
  std::size_t count;
  double k, a, b;

  [[nodiscard]] Scene<2> scene() const {
    Scene<2> line("line");
    std::vector<Rotor> all;
    for (std::size_t i = 0; i < count; ++i) all.push_back(line.add_rotor({.inertia = 1.0}));
    for (std::size_t i = 0; i < count; ++i) {
      const double wall = i == 0 || i + 1 == count ? k : 0.0, d = a + b * wall;
      line.add(force_law(points(all[i]), [=](auto x, auto v) { return vec(-wall * x[0] - d * v[0]); }));
      if (i == 0) continue;
      line.add(force_law(points(all[i - 1], all[i]),
                         [stiffness = k, damper = b * k](auto x, auto y, auto v, auto w) {
                           const auto force = stiffness * (y[0] - x[0]) + damper * (w[0] - v[0]);
                           return std::make_tuple(vec(force), vec(-force));
                         }));
    }
    return line;
  }
  /// omega = 2 sqrt(k) sin(j pi/(2 N + 2)), s^2 + (a + b omega^2) s + omega^2 = 0.
  [[nodiscard]] std::complex<double> eigenvalue(std::size_t j) const {
    const double angle = static_cast<double>(j) * std::acos(-1.0) / (2.0 * static_cast<double>(count) + 2.0);
    const double omega = 2.0 * std::sqrt(k) * std::sin(angle), d = (a + b * omega * omega) / 2.0;
    return -d + std::sqrt(std::complex<double>(d * d - omega * omega));
  }
};

TEST(LowestModes, SolveOneQuadraticEachUnderRayleighDamping) {
  // Either eigenvalue is known to roundings of the largest of K, 4 k, over 2 |s|.
  constexpr std::size_t N = 1000;
  const double n = N + 1.0;
  const DampedLine line{N, n * n, 0.3, 1e-3};
  const auto scene = line.scene();
  const auto modes = normal_modes(scene, equilibrium(scene), {.lowest = 10});
  ASSERT_EQ(modes.size(), 10U);
  EXPECT_EQ(modes.stability(), Stability::stable) << modes.describe();
  for (std::size_t j = 0; j < 10; ++j) {
    const auto s = line.eigenvalue(j + 1);
    EXPECT_LT(std::abs(modes.eigenvalue(j) - s), 100 * epsilon * 4.0 * line.k / std::abs(s)) << j;
  }
}

TEST(LowestModes, NegativeDampingIsUnstable) {
  // Damping of -2 d over a unit of inertia: modes grow as exp(d t), known to roundings of 4 over the lowest
  // |s| = 0.005, 2e-13, and some.
  const DampedLine line{601, 1.0, -0.002, 0.0};
  const auto scene = line.scene();
  const auto modes = normal_modes(scene, equilibrium(scene), {.lowest = 3});
  EXPECT_EQ(modes.stability(), Stability::unstable);
  EXPECT_NEAR(modes.damping(0), -0.001, 1e-11);
}

TEST(LowestModes, TellNothingOfTheOthers) {
  // The springs of a line decay; a lone stiff rotor, which is not among the lowest, grows.
  Scene<2> scene = DampedLine{601, 1.0, 0.01, 0.0}.scene();
  const auto lone = scene.add_rotor({.inertia = 1.0});
  scene.add(force_law(points(lone), [](auto x, auto v) { return vec(-9.0 * x[0] + 0.1 * v[0]); }));
  const auto modes = normal_modes(scene, equilibrium(scene), {.lowest = 3});
  EXPECT_EQ(modes.stability(), Stability::undecided);
  EXPECT_THAT(modes.describe(), HasSubstr("of the 3 modes that were asked for none grows"));
}

/// Both methods, which share the terms alone, on a scene that is small enough for the dense one.
template <int D>
void expect_as_dense(const Scene<D>& scene, const UniformRotation<D>& turning, std::size_t wanted,
                     double highest) {
  const auto state = equilibrium(scene, {.turning = turning});
  const FlatSample at = state.sample().flat();
  const System system = scene.system();
  const LinearTerms terms =
      linear_terms(system, RotatingFrame(*system.layout(), turning), {at.time, at.q, at.v}, at.lambda);
  const Modes dense = dense_modes(system, terms), sparse = lowest_modes(system, terms, wanted);
  ASSERT_EQ(sparse.modes.size(), wanted);
  EXPECT_EQ(sparse.stability, dense.stability) << sparse.reason << " / " << dense.reason;
  for (std::size_t k = 0; k < wanted; ++k) {
    const auto s = dense.modes[k].eigenvalue, found = sparse.modes[k].eigenvalue;
    // Those of equal modulus may stand in another order: the nearest of the dense ones.
    double nearest = std::abs(found - s);
    for (const Mode& other : dense.modes) nearest = std::min(nearest, std::abs(found - other.eigenvalue));
    EXPECT_LE(nearest, 1e3 * epsilon * highest / std::max(std::abs(s), 1e-3)) << k;
    EXPECT_NEAR(std::abs(found), std::abs(s), 1e3 * epsilon * highest / std::max(std::abs(s), 1e-3)) << k;
  }
}

TEST(LowestModes, OneDashpotGivesThoseOfTheDenseMatrix) {
  for (const double damper : {0.5, 50.0}) {
    Scene<3> scene = chain(40);
    const auto extra = scene.add_particle({.mass = 0.1, .position = {0.5, 0.0, -1.0}});
    scene.add(LinearDrag{extra, damper});
    scene.add(Distance{Fixed<3>{{0.5, 0.0, 0.0}}, extra, 1.0});
    expect_as_dense<3>(scene, {}, 8, 4.0 * 40 * 40);
  }
}

TEST(LowestModes, DampingBesideCompliantAndRedundantRowsGivesThoseOfTheDenseMatrix) {
  Scene<3> scene = chain(40);
  const auto held = scene.add_particle({.mass = 0.1, .position = {0.5, 0.0, -1.0}});
  scene.add(LinearDrag{held, 0.2});
  for (int twin = 0; twin < 2; ++twin) scene.add(Distance{Fixed<3>{{0.5, 0.0, 0.0}}, held, 1.0});
  const auto sprung = scene.add_particle({.mass = 0.1, .position = {0.5, 0.0, -2.0}});
  scene.add(compliant(Distance{held, sprung, 1.0}, 1e-2));
  scene.add(LinearDrag{sprung, 0.1});
  expect_as_dense<3>(scene, {}, 8, 4.0 * 40 * 40);
}

TEST(LowestModes, FeelTheCoriolisForcesOfATurningChain) {
  // Beads on a radius, held by springs to the ground of the turning frame and to each other.
  Scene<2> scene("turning");
  std::vector<Particle<2>> beads;
  for (int i = 0; i < 40; ++i) {
    beads.push_back(scene.add_particle({.mass = 1.0, .position = {1.0 + 0.1 * i, 0.0}}));
    scene.add(Spring{Fixed<2>{}, beads.back(), 4.0, 0.0});
    if (i > 0) scene.add(Spring{beads[beads.size() - 2], beads.back(), 100.0, 0.0});
  }
  expect_as_dense<2>(scene, {.rate = 0.3, .centre = {0.0, 0.0}}, 6, 400.0);
}

/// The residual of motion in the rotating frame at displacements u and rates w of it:
/// F + W^T lambda - M (2 A w + A^2 (q + u - p)), and psi of the nonholonomic rows.
Eigen::VectorXd residual(const System& system, const RotatingFrame& frame, const Instant& at,
                         std::span<const double> lambda, const Eigen::VectorXd& u, const Eigen::VectorXd& w) {
  const std::size_t n = at.q.size();
  std::vector<double> q(n), v(n), twice(n), carried(n), inertia(n);
  for (std::size_t i = 0; i < n; ++i) q[i] = at.q[i] + u[static_cast<Eigen::Index>(i)];
  frame.velocity(q, v);
  frame.apply(v, inertia);
  frame.apply(std::span(w.data(), n), twice);
  for (std::size_t i = 0; i < n; ++i) v[i] += w[static_cast<Eigen::Index>(i)];
  auto e = system.evaluation();
  system.evaluate({at.t, q, v}, e);
  Eigen::VectorXd out(static_cast<Eigen::Index>(n + system.rows()));
  out.setZero();
  for (std::size_t i = 0; i < n; ++i)
    out[static_cast<Eigen::Index>(i)] = e.force[i] - system.masses()[i] * (inertia[i] + 2.0 * twice[i]);
  for (std::size_t r = 0; r < system.rows(); ++r) {
    for (const std::size_t k : system.row(r))
      out[static_cast<Eigen::Index>(system.w_columns()[k])] += lambda[r] * e.w[k];
    if (r >= system.holonomic_rows()) out[static_cast<Eigen::Index>(n + r)] = e.psi[r];
  }
  return out;
}

TEST(LinearTerms, EqualTheDerivativesOfTheResidual) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.3, -0.9}});
  const auto a = scene.add_particle({.mass = 1.3, .position = {0.9, 0.2}});
  const auto b = scene.add_particle({.mass = 0.7, .position = {1.1, -0.8}});
  const auto wheel = scene.add_rotor({.inertia = 0.2, .angle = 0.4});
  scene.add(Distance{a, b, 1.0});
  scene.add(OnCurve{a, [](auto r) { return r.y() - 0.3 * r.x() * r.x(); }});
  scene.add(nonholonomic(points(b, wheel), [](auto r, auto phi, auto v, auto w) {
    return v.y() * cos(phi[0]) - sin(r.x()) * v.x() + 0.3 * w[0];
  }));
  scene.add(Spring{Fixed<2>{}, b, 5.0, 0.7});
  scene.add(force_law(points(a), [](auto r, auto v) { return (-0.4 * r.x() * v).eval(); }));
  const System system = scene.system();
  const RotatingFrame frame(*system.layout(), UniformRotation<2>{.rate = 0.8, .centre = {0.2, -0.1}});
  const std::vector<double> q(scene.initial_positions().begin(), scene.initial_positions().end());
  std::vector<double> v(q.size());
  frame.velocity(q, v);
  const std::vector<double> lambda{0.7, -1.1, 0.4};
  const Instant at{0.3, q, v};
  const LinearTerms terms = linear_terms(system, frame, at, lambda);

  const auto n = static_cast<Eigen::Index>(q.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n), C = K;
  for (const auto& k : terms.stiffness)
    K(static_cast<Eigen::Index>(k.row()), static_cast<Eigen::Index>(k.col())) += k.value();
  for (const auto& c : terms.damping)
    C(static_cast<Eigen::Index>(c.row()), static_cast<Eigen::Index>(c.col())) += c.value();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n), unit = Eigen::VectorXd::Unit(n, i);
    Eigen::VectorXd by_position = Eigen::VectorXd::Zero(n + 3), by_rate = by_position;
    by_position.head(n) = -K.col(i);
    by_rate.head(n) = -C.col(i);
    for (const std::size_t k : system.row(2)) {
      if (static_cast<Eigen::Index>(system.w_columns()[k]) != i) continue;
      by_position[n + 2] += terms.e[k];
      by_rate[n + 2] += terms.w[k];
    }
    expect_slope(slope([&](double h) { return residual(system, frame, at, lambda, h * unit, zero); }),
                 by_position, "u" + std::to_string(i));
    expect_slope(slope([&](double h) { return residual(system, frame, at, lambda, zero, h * unit); }),
                 by_rate, "u'" + std::to_string(i));
  }
}

TEST(NormalModes, FixedSceneHasNoModes) {
  // A bob on two rods beside a pendulum: the pendulum's only.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto held = scene.add_particle({.mass = 1.0, .position = {0.0, -1.0}});
  scene.add(Distance{Fixed<2>{{-1.0, 0.0}}, held, std::sqrt(2.0)});
  scene.add(Distance{Fixed<2>{{1.0, 0.0}}, held, std::sqrt(2.0)});
  EXPECT_EQ(normal_modes(scene, equilibrium(scene)).size(), 0U);
  const auto bob = scene.add_particle({.mass = 1.0, .position = {5.0, -1.0}});
  scene.add(Distance{Fixed<2>{{5.0, 0.0}}, bob, 1.0});
  const auto modes = normal_modes(scene, equilibrium(scene));
  ASSERT_EQ(modes.size(), 1U);
  EXPECT_NEAR(modes.frequency(0), std::sqrt(9.81), 10 * rounding);
}

TEST(NormalModes, DoNotDecideWhereTheStiffnessVanishes) {
  // A bead on y = x^3 at its turning point, which Newton's iteration comes close to from one side.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bead = scene.add_particle({.mass = 1.0, .position = {0.01, 1e-6}});
  scene.add(OnCurve{bead, [](const auto& r) {
                      const auto slope = 3.0 * r.x() * r.x();
                      return (r.y() - r.x() * r.x() * r.x()) / sqrt(1.0 + slope * slope);
                    }});
  const auto modes = normal_modes(scene, equilibrium(scene));
  EXPECT_EQ(modes.stability(), Stability::undecided);
  EXPECT_EQ(modes.frequency(0), 0.0);
}

TEST(NormalModes, TouchingConstraintsAreRefused) {
  // On y = 0 and on y = x^2: the bead cannot move, though one equation of two seems to leave it a way. Stated
  // twice, y = x^2 alone leaves that: omega^2 = 2 g.
  const auto stated = [](bool touching) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    const auto bead = scene.add_particle({.mass = 1.0});
    const auto parabola = [](const auto& r) { return r.y() - r.x() * r.x(); };
    scene.add(holonomic(points(bead), parabola));
    if (touching) {
      scene.add(holonomic(points(bead), [](const auto& r) { return r.y(); }));
    } else {
      scene.add(holonomic(points(bead), parabola));
    }
    return scene;
  };
  const auto touching = stated(true), repeated = stated(false);
  EXPECT_THAT([&] { (void)normal_modes(touching, equilibrium(touching)); },
              ThrowsMessage<InvalidScene>(HasSubstr("singular position")));
  EXPECT_NEAR(normal_modes(repeated, equilibrium(repeated)).frequency(0), std::sqrt(2.0 * 9.81),
              10 * rounding);
}

// Planes have no curvature, so the rod's part in their dependence is round-off: no singular position.
TEST(NormalModes, PendulumWithARedundantPlaneHasItsMode) {
  Scene<3> scene("pendulum");
  scene.add(UniformGravity<3>{{0.0, 0.0, -10.0}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {0.6, 0.0, -0.8}});
  scene.add(Distance{Fixed<3>{}, bob, 1.0});
  for (int i = 0; i < 2; ++i) scene.add(OnSurface{bob, Plane<3>{.normal = {0.0, 1.0, 0.0}}});
  EXPECT_NEAR(normal_modes(scene, equilibrium(scene)).frequency(0), std::sqrt(10.0), 1e-9);
}

/// Where it hangs it still hangs; but its multiplier is that of other forces.
TEST(NormalModes, EquilibriumOfOtherForcesOrMassesIsRefused) {
  Scene<2> scene;
  const auto gravity = scene.add(UniformGravity<2>{{0.0, -10.0}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {0.0, -1.0}}, "bob");
  scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");
  const auto rest = equilibrium(scene);
  const auto refused = ThrowsMessage<InvalidArgument>(HasSubstr("relative residual"));
  scene.replace(gravity, UniformGravity<2>{{0.0, -5.0}});
  EXPECT_THAT([&] { (void)normal_modes(scene, rest); }, refused);
  scene.replace(gravity, UniformGravity<2>{{0.0, -10.0}});
  EXPECT_NEAR(normal_modes(scene, rest).frequency(0), std::sqrt(10.0), rounding);
  scene.replace(bob, {.mass = 1.5, .position = {0.0, -1.0}});
  EXPECT_THAT([&] { (void)normal_modes(scene, rest); }, refused);
}

/// A pendulum, hanging or upside down: s^2 = -g or g, of which the one with Re s >= 0 and Im s >= 0 is told.
TEST(NormalModes, AreTheSameBesideAVelocityRowThatRepeatsTheRod) {
  for (const double side : {-1.0, 1.0}) {
    for (const bool repeated : {false, true}) {
      Scene<2> scene("pendulum");
      scene.add(UniformGravity<2>{{0.0, -10.0}});
      const auto bob = scene.add_particle({.mass = 1.0, .position = {0.0, side}}, "bob");
      scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");
      if (repeated) scene.add(nonholonomic(points(bob), [](auto r, auto v) { return r.dot(v); }), "rates");
      const auto modes = normal_modes(scene, equilibrium(scene));
      ASSERT_EQ(modes.size(), 1U) << repeated;
      const std::complex<double> exact = std::sqrt(std::complex<double>(10.0 * side));
      EXPECT_LT(std::abs(modes.eigenvalue(0) - exact), rounding) << side << repeated;
      EXPECT_EQ(modes.stability(), side < 0.0 ? Stability::stable : Stability::unstable);
    }
  }
}

TEST(NormalModes, CanBeReadAfterTheyWereMoved) {
  Scene<2> scene;
  const auto mass = scene.add_particle({.mass = 1.0}, "mass");
  scene.add(Spring{Fixed<2>{}, mass, 1.0});
  auto modes = normal_modes(scene, equilibrium(scene));
  const auto taken = std::move(modes);
  EXPECT_EQ(modes.describe(), taken.describe());  // NOLINT(bugprone-use-after-move)
  EXPECT_EQ(modes.shape(1, mass), taken.shape(1, mass));
}

/// A uniform ball of radius R at rest on a rough table that turns at a rate of its own.
NormalModes<3> modes_of_ball_on_table(double R, double drag, double rate) {
  constexpr double m = 2.0;
  const double I = 0.4 * m * R * R;
  Scene<3> scene("ball");
  scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
  const auto ball = add_body(scene, {.mass = m, .inertia = {I, I, I}, .centre = {0.0, 0.0, R}}, "ball");
  scene.add(OnSurface{ball.centre(), Plane<3>{.point = {0.0, 0.0, R}, .normal = {0.0, 0.0, 1.0}}}, "table");
  const auto x = ball.point({1.0, 0.0, 0.0}), y = ball.point({0.0, 1.0, 0.0}),
             z = ball.point({0.0, 0.0, 1.0});
  const auto rolls = [=](auto c, auto a, auto b, auto d, auto vc, auto va, auto vb, auto vd) {
    const auto w = (0.5 * ((a - c).cross(va - vc) + (b - c).cross(vb - vc) + (d - c).cross(vd - vc))).eval();
    return vec(vc.x() - R * w.y() + rate * c.y(), vc.y() + R * w.x() - rate * c.x());
  };
  scene.add(nonholonomic(points(ball.centre(), x, y, z), rolls), "rolls");
  if (drag > 0.0) scene.add(LinearDrag{ball.centre(), drag});
  return normal_modes(scene, equilibrium(scene));
}

TEST(NormalModes, BallAtRestOnARoughPlaneIsSlowedByDragAlone) {
  // 1.4 m v' = -c v, and neither its place nor its attitude matters. The load of the plane leaves round-off
  // in the forces of rolling, which is no stiffness.
  for (const double drag : {1e-6, 1e-3, 0.1}) {
    const auto modes = modes_of_ball_on_table(0.5, drag, 0.0);
    ASSERT_EQ(modes.size(), 7U);
    for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(modes.eigenvalue(k), 0.0) << drag;
    for (std::size_t k = 5; k < 7; ++k)
      EXPECT_LT(std::abs(modes.eigenvalue(k) + drag / 2.8), rounding * drag) << drag;
    EXPECT_EQ(modes.stability(), Stability::stable) << modes.describe();
  }
}

TEST(NormalModes, BallOnATurntableGoesRoundAtTwoSeventhsOfItsRate) {
  // v' = 2/7 Omega x v. As it is held by no energy, that it does not grow is not proven.
  const auto modes = modes_of_ball_on_table(0.5, 0.0, 1.0);
  for (std::size_t k = 0; k + 1 < modes.size(); ++k) EXPECT_EQ(modes.eigenvalue(k), 0.0);
  EXPECT_NEAR(modes.frequency(modes.size() - 1), 2.0 / 7.0, rounding);
  EXPECT_EQ(modes.stability(), Stability::undecided) << modes.describe();
}

}  // namespace
}  // namespace dalembert::normal_modes_test
