#include <dalembert/dalembert.h>
#include <dalembert/models/chain.h>
#include <dalembert/models/governor.h>
#include <dalembert/models/hoop_about_diameter.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace dalembert::equilibrium_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Property;
using testing::ThrowsMessage;

/// Newton's iteration goes on until the residual no longer falls, at some roundings of terms of size 1 to
/// 100; the equilibria here are conditioned like 1.
constexpr double rounding = 1e3 * std::numeric_limits<double>::epsilon();

struct Hung {
  Scene<2> scene{"hung"};
  Particle<2> bob;
  Constraint<1> rod;

  explicit Hung(double angle) {
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    bob = scene.add_particle({.mass = 2.0, .position = {std::sin(angle), -std::cos(angle)}}, "bob");
    rod = scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");
  }
};

TEST(Equilibrium, PendulumHangsBelowItsPivotAndTheRodCarriesItsWeight) {
  const Hung hung(1.0);
  const auto found = equilibrium(hung.scene);
  EXPECT_NEAR(found.sample().position(hung.bob).x(), 0.0, rounding);
  EXPECT_NEAR(found.sample().position(hung.bob).y(), -1.0, rounding);
  EXPECT_EQ(found.sample().velocity(hung.bob), Vec<2>(Vec<2>::Zero()));
  EXPECT_NEAR(found.sample().multiplier(hung.rod), -19.62, 19.62 * rounding);
  EXPECT_NEAR(found.sample().constraint_force(hung.rod, hung.bob).y(), 19.62, 19.62 * rounding);
  EXPECT_NEAR(found.sample().energy(), -19.62, 19.62 * rounding);
}

TEST(Equilibrium, StaysAtTheUnstableOneNearby) {
  const Hung hung(3.0);
  const auto found = equilibrium(hung.scene);
  EXPECT_NEAR(found.sample().position(hung.bob).y(), 1.0, rounding);
  EXPECT_NEAR(found.sample().multiplier(hung.rod), 19.62, 19.62 * rounding);
}

TEST(Equilibrium, IsFoundFromWhereNewtonsMatrixIsSingular) {
  // Horizontal: the stiffness (m g/l) cos phi of the pendulum is 0, so that Newton's iteration does not
  // begin.
  const Hung hung(std::acos(0.0));
  const auto found = equilibrium(hung.scene);
  EXPECT_NEAR(found.sample().position(hung.bob).y(), -1.0, rounding);
}

TEST(Equilibrium, ChainThrownFarHangsPlumb) {
  const auto chain = models::Chain{.beads = 20}.scene();  // released from horizontal
  const auto found = equilibrium(chain.scene);
  for (std::size_t i = 0; i < 20; ++i) {
    const double depth = static_cast<double>(i + 1) / 20.0;
    EXPECT_NEAR(found.sample().position(chain.beads[i]).y(), -depth, 20 * rounding);
    EXPECT_NEAR(-found.sample().multiplier(chain.rods[i]), 9.81 * (1.05 - depth), 9.81 * 20 * rounding);
  }
}

TEST(Equilibrium, PutsAGuessThatViolatesTheConstraintsOntoThem) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 2.0, .position = {0.3, -0.5}});
  scene.add(Distance{Fixed<2>{}, bob, 1.0});
  const auto found = equilibrium(scene);
  EXPECT_NEAR(found.sample().position(bob).y(), -1.0, rounding);
}

TEST(Equilibrium, WeightStretchesItsSpring) {
  // A rod of compliance C = 1/k, and a spring of stiffness k in its place: l + m g/k.
  for (const double k : {1e2, 1e12}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    const auto bob = scene.add_particle({.mass = 2.0, .position = {0.6, -0.8}});
    const auto rod = scene.add(compliant(Distance{Fixed<2>{}, bob, 1.0}, 1.0 / k));
    const auto found = equilibrium(scene);
    EXPECT_NEAR(found.sample().position(bob).y(), -1.0 - 19.62 / k, rounding);
    EXPECT_NEAR(found.sample().multiplier(rod), -19.62, 19.62 * rounding) << k;
  }
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 2.0, .position = {0.6, -0.8}});
  scene.add(Spring{Fixed<2>{}, bob, 1e2, 1.0});
  const auto found = equilibrium(scene);
  EXPECT_NEAR(found.sample().position(bob).y(), -1.1962, rounding);
}

TEST(Equilibrium, TwoEqualRodsShareTheLoadAndSaySo) {
  Hung hung(1.0);
  const auto other = hung.scene.add(Distance{hung.bob, Fixed<2>{}, 1.0}, "other rod");
  const auto found = equilibrium(hung.scene);
  EXPECT_NEAR(found.sample().multiplier(hung.rod), -9.81, 9.81 * rounding);
  EXPECT_NEAR(found.sample().multiplier(other), -9.81, 9.81 * rounding);
  EXPECT_FALSE(found.sample().is_unique(hung.rod));
}

TEST(Equilibrium, SkateReachesItAlongItsBlade) {
  // A blade along x: a spring to the origin draws it to x = 0, and the blade takes up the force along y.
  Scene<2> scene;
  const auto skate = scene.add_particle({.mass = 2.0, .position = {0.6, -0.8}});
  const auto blade = scene.add(nonholonomic(points(skate), [](auto, auto v) { return v.y(); }));
  scene.add(potential(points(skate), [](auto r) { return 5.0 * r.squaredNorm(); }));
  const auto found = equilibrium(scene);
  EXPECT_NEAR(found.sample().position(skate).x(), 0.0, rounding);
  EXPECT_NEAR(found.sample().position(skate).y(), -0.8, rounding);
  EXPECT_NEAR(found.sample().multiplier(blade), -8.0, 8.0 * rounding);
}

TEST(RelativeEquilibrium, ConicalPendulumsTensionIsItsWeightOverTheCosine) {
  // m l Omega^2 sin cos = m g sin: cos = g/(l Omega^2), tension m l Omega^2.
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 2.0, .position = {0.6, 0.0, -0.8}});
  const auto rod = scene.add(Distance{Fixed<3>{}, bob, 1.0});
  const auto found = equilibrium(scene, {.turning = {.rate = {0.0, 0.0, 4.0}}});
  EXPECT_NEAR(found.sample().position(bob).z(), -9.81 / 16.0, rounding);
  EXPECT_NEAR(found.sample().multiplier(rod), -32.0, 32.0 * rounding);
  const Vec<3> r = found.sample().position(bob), v = found.sample().velocity(bob);
  EXPECT_NEAR((v - Vec<3>(0.0, 0.0, 4.0).cross(r)).norm(), 0.0, rounding);
  const Vec<3> towards_the_axis = found.sample().acceleration(bob);
  EXPECT_NEAR((towards_the_axis + 16.0 * Vec<3>(r.x(), r.y(), 0.0)).norm(), 0.0, 16.0 * rounding);
}

TEST(RelativeEquilibrium, TurnsAboutAnyAxis) {
  // The same pendulum, tilted: gravity along -e, turning about the parallel of e through the pivot p.
  const Vec<3> e = Vec<3>(1.0, 2.0, 2.0) / 3.0, across = Vec<3>(2.0, -2.0, 1.0) / 3.0, p(1.0, 5.0, -2.0);
  Scene<3> scene;
  scene.add(UniformGravity<3>{-9.81 * e});
  const auto bob = scene.add_particle({.mass = 2.0, .position = p + 0.6 * across - 0.8 * e});
  scene.add(Distance{Fixed<3>{p}, bob, 1.0});
  const auto found = equilibrium(scene, {.turning = {.rate = 4.0 * e, .centre = p + e}, .time = 3.0});
  EXPECT_NEAR(e.dot(found.sample().position(bob) - p), -9.81 / 16.0, 10 * rounding);
}

TEST(RelativeEquilibrium, HoldsASpringStretchedInThePlane) {
  // k (x - l) = m Omega^2 x about a centre that is not the origin.
  Scene<2> scene;
  const auto bead = scene.add_particle({.mass = 1.0, .position = {2.1, 3.0}});
  scene.add(Spring{Fixed<2>{{1.0, 3.0}}, bead, 10.0, 1.0});
  const auto found = equilibrium(scene, {.turning = {.rate = -2.0, .centre = {1.0, 3.0}}});
  EXPECT_NEAR((found.sample().position(bead) - Vec<2>(1.0, 3.0)).norm(), 10.0 / 6.0, 10 * rounding);
}

TEST(RelativeEquilibrium, PullsAtABearingThatDoesNotTurnWithIt) {
  // A mass on a rod goes round a hub that planes x = 0 and y = 0 hold: now one has the load, now the other.
  Scene<3> scene;
  const auto hub = scene.add_particle({.mass = 1.0}),
             mass = scene.add_particle({.mass = 2.0, .position = {1.0, 0.0, 0.0}});
  const auto wall = scene.add(OnSurface{hub, Plane<3>{.normal = Vec<3>::UnitX()}});
  scene.add(OnSurface{hub, Plane<3>{.normal = Vec<3>::UnitY()}});
  for (const auto& one : {hub, mass}) scene.add(OnSurface{one, Plane<3>{}});
  const auto rod = scene.add(Distance{hub, mass, 1.0});
  const auto found = equilibrium(scene, {.turning = {.rate = {0.0, 0.0, 3.0}}});
  EXPECT_NEAR(found.sample().multiplier(rod), -18.0, 18.0 * rounding);
  EXPECT_NEAR(std::abs(found.sample().multiplier(wall)), 18.0, 18.0 * rounding);
}

TEST(RelativeEquilibrium, RunsOnAsItBegan) {
  // As a second proof that knows no rotation: a run from the governor's state keeps its angle.
  models::Governor governor{.angle = 0.7};
  auto built = governor.scene();
  const auto found = equilibrium(built.scene, {.turning = {.rate = {0.0, 0.0, governor.spin}}});
  governor.angle = std::acos(-found.sample().position(built.parts.masses[0]).z());
  const auto begun = governor.scene();
  const double tolerance = 1e-9;
  const auto run = simulate(begun.scene, {.t_end = 5.0, .samples = 11, .tolerance = tolerance});
  // The largest errors over 10 s at tolerance 1e-8 are below 100 times the tolerance (docs/accuracy.md).
  for (std::size_t i = 0; i < run.size(); ++i)
    EXPECT_NEAR(run.position(begun.parts.sleeve, i).z(), found.sample().position(built.parts.sleeve).z(),
                100 * tolerance);
}

template <int D>
auto refusal(const Scene<D>& scene, const EquilibriumOptions<D>& options = {}) {
  return [&scene, options] { (void)equilibrium(scene, options); };
}

TEST(Equilibrium, FallingBodyHasNone) {
  Scene<2> scene("drop");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  scene.add_particle({.mass = 2.0, .position = {0.0, 1.0}}, "stone");
  EXPECT_THAT(refusal(scene), ThrowsMessage<NoEquilibrium>(
                                  AllOf(HasSubstr("\"drop\""), HasSubstr("\"stone\""), HasSubstr("9.81"))));
}

/// A repulsion that dies away is balanced nowhere, however small it has become.
TEST(Equilibrium, RepulsionThatDiesAwayHasNone) {
  const auto repelled = [](auto V) {
    Scene<2> scene("repelled");
    const auto rotor = scene.add_rotor({.inertia = 1.0, .angle = 1.0}, "charge");
    scene.add(potential(points(rotor), [V](auto x) { return V(x[0]); }));
    return scene;
  };
  const auto none = ThrowsMessage<NoEquilibrium>(HasSubstr("\"charge\""));
  EXPECT_THAT(refusal(repelled([](auto x) { return 1.0 / x; })), none);
  EXPECT_THAT(refusal(repelled([](auto x) { return 1.0 / (1.0 + x * x); })), none);
  EXPECT_THAT(refusal(repelled([](auto x) { return exp(-x); })), none);
  Scene<3> pair("pair");
  const auto a = pair.add_particle({.mass = 1.0}, "a"),
             b = pair.add_particle({.mass = 1e-3, .position = {1.0, 0.5, 0.0}}, "b");
  pair.add(potential(points(a, b), [](auto p, auto q) { return 1.0 / (p - q).norm(); }));
  EXPECT_THAT(refusal(pair), ThrowsMessage<NoEquilibrium>(HasSubstr("\"b\"")));
}

TEST(Equilibrium, IsNoneAtACornerOfAPotential) {
  // V = |x| + y^2/2: wherever it starts, a force of size 1 drives it back to x = 0, where it jumps.
  for (const double x : {0.0, 0.3}) {
    Scene<2> scene;
    const auto bead = scene.add_particle({.mass = 1.0, .position = {x, 0.2}}, "bead");
    scene.add(potential(points(bead), [](auto r) { return abs(r.x()) + 0.5 * r.y() * r.y(); }), "groove");
    EXPECT_THAT(refusal(scene), ThrowsMessage<NoEquilibrium>(HasSubstr("Potential \"groove\" jumps there")));
  }
}

TEST(Equilibrium, NamesTheForceBeyondWhoseRangeItLies) {
  Scene<2> scene("range");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 1.0}, "bob");
  scene.add(force_law(points(bob),
                      [](auto r, auto) {
                        if (r.y() < -0.2) throw std::runtime_error("beyond the table");
                        return (-1.0 * r).eval();
                      }),
            "table");
  EXPECT_THAT(refusal(scene),
              ThrowsMessage<NoEquilibrium>(AllOf(HasSubstr("\"table\""), HasSubstr("beyond the table"))));
}

TEST(Equilibrium, IsNotThatOfFriction) {
  Scene<2> scene("rough");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto block = scene.add_particle({.mass = 1.0}, "block");
  const auto floor = scene.add(OnCurve{block, Plane<2>{}}, "floor");
  scene.add(coulomb(floor, Slip{block, Plane<2>{}, {0.0, 0.0}}, 0.3), "rough floor");
  EXPECT_THAT(refusal(scene), ThrowsMessage<NoEquilibrium>(
                                  AllOf(HasSubstr("\"rough floor\""), HasSubstr("up to its limit"))));
}

TEST(Equilibrium, EndlessSlopeHasNone) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto block = scene.add_particle({.mass = 2.0}, "block");
  scene.add(OnCurve{block, Plane<2>{.normal = {0.6, 0.8}}});
  EXPECT_THAT(refusal(scene), ThrowsMessage<NoEquilibrium>(HasSubstr("\"block\"")));
}

TEST(Equilibrium, DrivenSceneIsRefusedByItsDrive) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0, .position = {0.0, -1.0}});
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  scene.add(Distance{driven([](auto t) { return vec(0.0, 0.1 * sin(t)); }), bob, 1.0}, "crank");
  EXPECT_THAT(refusal(scene), ThrowsMessage<NoEquilibrium>(HasSubstr("Distance \"crank\" moves")));
}

TEST(Equilibrium, OfATowedCasterStartsWhereItRolls) {
  // On a rail along y, towed along x by V as in a frame that moves with it; its wheel does not slip across:
  // y' cos th - L th' = V sin th. That is at rest at th = 0 only, which is not looked for.
  const auto towed = [](double angle) {
    Scene<2> scene;
    const auto pin = scene.add_particle({.mass = 2.0}, "pin");
    const auto caster = scene.add_rotor({.inertia = 0.3, .angle = angle}, "caster");
    scene.add(OnCurve{pin, Plane<2>{.normal = {1.0, 0.0}}});
    scene.add(Spring{Fixed<2>{}, pin, 500.0});
    scene.add(nonholonomic(points(pin, caster),
                           [](auto, auto th, auto v, auto spin) {
                             return v.y() * cos(th[0]) - 0.4 * spin[0] - 1.5 * sin(th[0]);
                           }),
              "wheel");
    return scene;
  };
  const auto scene = towed(0.0);
  const auto found = equilibrium(scene);
  EXPECT_EQ(found.sample().multiplier(scene.constraint<1>("wheel")), 0.0);
  EXPECT_THAT(refusal(towed(0.1)), ThrowsMessage<NoEquilibrium>(AllOf(HasSubstr("\"wheel\" moves"),
                                                                      HasSubstr("is not 0 at rest there"))));
}

TEST(Equilibrium, MustLastLongerThanAnInstant) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0, .position = {0.0, -1.0}});
  scene.add(potential(points(bob),
                      [](auto t, auto r) { return 0.5 * (r - vec(0.0 * t, -1.0 + t * t)).squaredNorm(); }));
  EXPECT_THAT(refusal(scene), ThrowsMessage<NoEquilibrium>(HasSubstr("change with time")));
}

TEST(RelativeEquilibrium, RotationMustBeThatOfTheDrives) {
  const auto built = models::HoopAboutDiameter{.spin = 4.5}.scene();
  EXPECT_THAT(refusal(built.scene, {.turning = {.rate = {0.0, 0.0, 4.4}}}),
              ThrowsMessage<NoEquilibrium>(HasSubstr("RotatingPlane")));
}

TEST(RelativeEquilibrium, SceneMustBeSymmetricAboutTheAxis) {
  // A wall of the bowl that is oval: in balance at the start, no longer a quarter turn on.
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
  const auto bead = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0, 0.5}});
  scene.add(OnSurface{bead, [](auto r) { return r.z() - 0.5 * r.x() * r.x() - 0.6 * r.y() * r.y(); }});
  EXPECT_THROW((void)equilibrium(scene, {.turning = {.rate = {0.0, 0.0, std::sqrt(9.81)}}}), NoEquilibrium);
}

TEST(Equilibrium, RefusesFrictionByName) {
  Hung hung(1.0);
  hung.scene.add(friction_law(hung.rod, points(hung.bob),
                              [](auto lambda, auto, auto v) { return (-0.1 * lambda * lambda * v).eval(); }),
                 "bearing");
  EXPECT_THAT(refusal(hung.scene), ThrowsMessage<NoEquilibrium>(HasSubstr("\"bearing\"")));
}

TEST(Equilibrium, RefusesOptionsThatMakeNoSense) {
  const Hung hung(1.0);
  EXPECT_THAT(refusal(hung.scene, {.time = NAN}), ThrowsMessage<InvalidArgument>(HasSubstr("time")));
  EXPECT_THAT(refusal(hung.scene, {.turning = {.rate = INFINITY}}),
              ThrowsMessage<InvalidArgument>(HasSubstr("turning")));
}

TEST(Equilibrium, RefusesHandlesOfAnotherScene) {
  const Hung hung(1.0), other(1.0);
  const auto found = equilibrium(hung.scene);
  EXPECT_THROW((void)found.sample().position(other.bob), InvalidArgument);
  EXPECT_THROW((void)normal_modes(hung.scene, equilibrium(other.scene)), InvalidArgument);
}

TEST(Equilibrium, IsTheSameBitForBit) {
  const auto chain = models::Chain{.beads = 20}.scene();
  const auto one = equilibrium(chain.scene), two = equilibrium(chain.scene);
  for (const auto& bead : chain.beads) EXPECT_EQ(one.sample().position(bead), two.sample().position(bead));
}

TEST(Equilibrium, IsFoundWhereOneForceAloneActs) {
  // V = -x^2/2 + x^4/4: from 0.9 to 1, whose V_xx = 2, though no other force tells what is small.
  Scene<2> scene;
  const auto bead = scene.add_particle({.mass = 1.0, .position = {0.9, 0.0}});
  scene.add(potential(points(bead), [](auto r) {
    const auto square = r.x() * r.x();
    return 0.25 * square * square - 0.5 * square + 0.5 * r.y() * r.y();
  }));
  const auto found = equilibrium(scene);
  EXPECT_NEAR(found.sample().position(bead).x(), 1.0, 1e-10);
}

TEST(Equilibrium, LightParticleIsNotAtRestBesideAStiffSpring) {
  // A bead of 1e-6 kg that falls, held sideways by 1e10 N/m.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bead = scene.add_particle({.mass = 1e-6, .position = {1.0, 0.0}});
  scene.add(potential(points(bead), [](auto r) { return 0.5e10 * (r.x() - 1.0) * (r.x() - 1.0); }));
  EXPECT_THROW((void)equilibrium(scene), NoEquilibrium);
}

}  // namespace
}  // namespace dalembert::equilibrium_test
