#include <dalembert/solvers/base/numbers.h>
#include <dalembert/tests/solvers/with_events.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

namespace dalembert::coulomb_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class CoulombFriction : public WithEvents {};
INSTANTIATE_TEST_SUITE_P(Runs, CoulombFriction, at_tolerances, tolerance_name);

/// A block of mass 2 on a line at this angle.
struct Incline {
  Scene<2> scene{"incline"};
  Particle<2> block;
  Constraint<1> floor, rough;
  Vec<2> up;

  Incline(double angle, double speed, double mu, double mu_static) : up(std::cos(angle), std::sin(angle)) {
    scene.add(UniformGravity<2>{{0.0, -g}});
    block = scene.add_particle({.mass = 2.0, .velocity = speed * up}, "block");
    const Plane<2> plane{{0.0, 0.0}, {-std::sin(angle), std::cos(angle)}};
    floor = scene.add(OnCurve{block, plane}, "floor");
    rough = scene.add(coulomb(floor, Slip{block, plane}, mu, mu_static), "rough");
  }
};

TEST_P(CoulombFriction, BringsABlockToRestThatStays) {
  // v' = -g (sin a + mu cos a); at rest sigma = m g sin a < mu_static m g cos a.
  const double angle = 0.3, mu = 0.4, v0 = 2.0;
  const Incline scene(angle, v0, mu, mu);
  const double slows = g * (std::sin(angle) + mu * std::cos(angle)), rests = v0 / slows;
  const auto run = simulate(scene.scene, options(1.0));
  ASSERT_EQ(run.events().size(), 1U);
  EXPECT_EQ(run.events()[0].kind, EventKind::sticks);
  EXPECT_EQ(run.events()[0].source, static_cast<std::size_t>(scene.rough.index));
  EXPECT_NEAR(run.events()[0].time, rests, bound);
  EXPECT_NEAR(run.multiplier(scene.rough, 0), -mu * 2.0 * g * std::cos(angle), bound * g);
  EXPECT_NEAR(run.constraint_force(scene.rough, scene.block, 0).dot(scene.up),
              -mu * 2.0 * g * std::cos(angle), bound * g);
  EXPECT_NEAR(run.multiplier(scene.rough, 10), 2.0 * g * std::sin(angle), bound * g);
  EXPECT_NEAR(run.position(scene.block, 10).dot(scene.up), v0 * v0 / (2.0 * slows), bound);
  EXPECT_NEAR(run.velocity(scene.block, 10).norm(), 0.0, tolerance);
}

TEST_P(CoulombFriction, LetsABlockSlideBackWhereItIsSteep) {
  const double angle = 0.6, mu = 0.4, v0 = 2.0;
  const Incline scene(angle, v0, mu, mu);
  const double turns = v0 / (g * (std::sin(angle) + mu * std::cos(angle)));
  const auto run = simulate(scene.scene, options(1.0));
  ASSERT_EQ(run.events().size(), 1U);
  EXPECT_EQ(run.events()[0].kind, EventKind::slides);
  EXPECT_NEAR(run.events()[0].time, turns, bound);
  const double back = g * (std::sin(angle) - mu * std::cos(angle));
  EXPECT_NEAR(run.velocity(scene.block, 10).dot(scene.up), -back * (1.0 - turns), bound * g);
  EXPECT_NEAR(run.multiplier(scene.rough, 10), mu * 2.0 * g * std::cos(angle), bound * g);
}

// m x'' = -k x -+ mu m g: it turns every half period pi/w, 2 mu m g/k closer to 0, until k |x| < mu m g. The
// friction there has its new direction as soon as velocities are known to have theirs: taken over 1e4
// roundings late, it was refused by the audit from 1e-12 on.
TEST_P(CoulombFriction, ReversesOnASpringAtTightTolerances) {
  const double k = 20.0, mu = 0.2, half = std::numbers::pi / std::sqrt(k), loss = 2.0 * mu * g / k;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto block = scene.add_particle({.mass = 1.0, .position = {0.8, 0.0}});
  const auto floor = scene.add(OnCurve{block, Plane<2>{}});
  scene.add(coulomb(floor, Slip{block, Plane<2>{}}, mu));
  scene.add(Spring{Fixed<2>{{-1.0, 0.0}}, block, k, 1.0});
  for (const double tight : {1e-11, 1e-12, 1e-13}) {
    Options options = this->options(3.0);
    options.tolerance = tight;
    const auto run = simulate(scene, options);
    ASSERT_EQ(run.events().size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto turns = static_cast<double>(i + 1);
      const double x = (i % 2 == 0 ? -1.0 : 1.0) * (0.8 - turns * loss);
      // Where speeds are known to u, a turn is known to u/a, a = k |x| + mu g; u is 1.8 m sqrt(k) accuracy.
      const double a = k * std::abs(x) + mu * g, accuracy = run.statistics().accuracy;
      EXPECT_NEAR(run.events()[i].time, turns * half, 2.0 * 1.8 * std::sqrt(k) / a * accuracy);
      EXPECT_NEAR(run.event_sample(i).position(block).x(), x, 2.0 * 1.8 * accuracy);
    }
  }
}

// Held up to mu m g against a pull that grows as k t: it goes as soon as forces are
// known to exceed that. Ten thousand roundings later the audit refused it at 1e-13.
TEST_P(CoulombFriction, LetsGoInTimeAtTightTolerances) {
  constexpr double mu = 0.3, k = 4.0;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto block = scene.add_particle({.mass = 2.0});
  const auto floor = scene.add(OnCurve{block, Plane<2>{}});
  scene.add(coulomb(floor, Slip{block, Plane<2>{}}, mu));
  scene.add(force_law(points(block), [](auto t, auto, auto) { return vec(k * t, 0.0 * t); }));
  for (const double tight : {1e-11, 1e-12, 1e-13}) {
    Options options = this->options(2.0);
    options.tolerance = tight;
    const auto run = simulate(scene, options);
    ASSERT_EQ(run.events().size(), 1U);
    EXPECT_NEAR(run.events()[0].time, mu * 2.0 * g / k, 10.0 * tight);
  }
}

TEST_P(CoulombFriction, HoldsFromTheStartOrLetsGo) {
  const Incline held(0.3, 0.0, 0.2, 0.4), slides(0.3, 0.0, 0.2, 0.25);
  const auto stays = simulate(held.scene, options(1.0));
  EXPECT_TRUE(stays.events().empty());
  EXPECT_NEAR(stays.velocity(held.block, 10).norm(), 0.0, tolerance);
  EXPECT_NEAR(stays.multiplier(held.rough, 10), 2.0 * g * std::sin(0.3), bound * g);
  const auto goes = simulate(slides.scene, options(1.0));
  EXPECT_NEAR(goes.position(slides.block, 10).dot(slides.up),
              -g * (std::sin(0.3) - 0.2 * std::cos(0.3)) / 2.0, bound * g);
}

TEST_P(CoulombFriction, LetsGoWhereItsBoundIsReached) {
  // A force that grows as k t pulls at a block: it goes at k t = mu_static m g, and then m v' = k t - mu m g.
  constexpr double k = 5.0, mu = 0.3, mu_static = 0.5;
  Incline scene(0.0, 0.0, mu, mu_static);
  scene.scene.add(force_law(points(scene.block), [](auto t, auto, auto) { return vec(k * t, 0.0); }));
  const double goes = mu_static * 2.0 * g / k, t = goes + 1.0;
  const auto run = simulate(scene.scene, options(t));
  ASSERT_EQ(run.events().size(), 1U);
  EXPECT_EQ(run.events()[0].kind, EventKind::slides);
  EXPECT_NEAR(run.events()[0].time, goes, bound);
  const double v = (k * (t * t - goes * goes) / 2.0 - mu * 2.0 * g * (t - goes)) / 2.0;
  EXPECT_NEAR(run.velocity(scene.block, 10).x(), v, bound * v);
}

TEST_P(CoulombFriction, WirePressesEitherWay) {
  // A bead on a horizontal ring, no gravity: v' = -mu v^2/R, v = v0/(1 + mu v0 t/R). With gravity across the
  // ring's plane its multiplier changes sign on the way.
  constexpr double mu = 0.2, R = 1.5, v0 = 3.0;
  for (const double side : {1.0, -1.0}) {
    Scene<2> scene;
    const auto bead = scene.add_particle({.mass = 1.0, .position = {R, 0.0}, .velocity = {0.0, side * v0}});
    const Sphere<2> ring{.radius = R};
    const auto wire = scene.add(OnCurve{bead, ring});
    const auto rough = scene.add(coulomb(wire, Slip{bead, ring}, mu));
    const auto run = simulate(scene, options(2.0));
    const double v = v0 / (1.0 + mu * v0 * 2.0 / R);
    EXPECT_NEAR(run.velocity(bead, 10).norm(), v, bound * v0);
    EXPECT_NEAR(std::abs(run.multiplier(rough, 10)), mu * v * v / R, bound * v0 * v0);
  }
}

TEST_P(CoulombFriction, FrictionFollowsAWireWhoseForceTurns) {
  // Up a circular wire from its lowest point, theta from there, y = theta'^2: its force y + G cos theta, G =
  // g/R, turns above the height of the centre, where gravity takes over, and with it the sign s of
  //
  //   dy/dtheta = -2 G sin theta - m (y + G cos theta),   m = 2 mu s
  //   y = A cos theta + B sin theta + C exp(-m theta),   A = G (2 - m^2)/(1 + m^2),   B = -3 m G/(1 + m^2).
  constexpr double mu = 0.1, R = 1.0, G = g / R;
  const auto solution = [](double sign, double theta0, double square0, double theta) {
    const double m = 2.0 * mu * sign, A = G * (2.0 - m * m) / (1.0 + m * m), B = -3.0 * m * G / (1.0 + m * m);
    const double C = square0 - A * std::cos(theta0) - B * std::sin(theta0);
    return C * std::exp(-m * (theta - theta0)) + A * std::cos(theta) + B * std::sin(theta);
  };
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const double square = 4.6 * G;
  const auto bead =
      scene.add_particle({.mass = 1.0, .position = {0.0, -R}, .velocity = {R * std::sqrt(square), 0.0}});
  const Sphere<2> ring{.radius = R};
  const auto wire = scene.add(OnCurve{bead, ring});
  scene.add(coulomb(wire, Slip{bead, ring}, mu));
  const auto run = simulate(scene, options(0.68));
  double theta = std::atan2(run.position(bead, 10).x(), -run.position(bead, 10).y());
  if (theta < 0.0) theta += 2.0 * std::numbers::pi;
  double turn = 0.5 * std::numbers::pi;
  for (double step = 0.5; step > 1e-16; step /= 2.0)
    if (solution(1.0, 0.0, square, turn + step) + G * std::cos(turn + step) > 0.0) turn += step;
  ASSERT_GT(theta, turn);
  const double at_turn = solution(1.0, 0.0, square, turn);
  const double w2 = solution(-1.0, turn, at_turn, theta);
  EXPECT_LT(run.multiplier(wire, 10) * run.multiplier(wire, 0), 0.0);
  EXPECT_NEAR(run.velocity(bead, 10).squaredNorm() / R / R, w2, bound * square);
  EXPECT_TRUE(run.events().empty());
}

TEST_P(CoulombFriction, SkiddingWheelEndsInRolling) {
  // A disk set down at v0 without spin: v' = -mu g, R w' = mu g m R^2/I: rolls from t = v0/(mu g (1 + m
  // R^2/I)).
  constexpr double mu = 0.2, R = 0.5, v0 = 3.0, m = 2.0, I = 0.25;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto centre = scene.add_particle({.mass = m, .position = {0.0, R}, .velocity = {v0, 0.0}});
  const auto wheel = scene.add_rotor({.inertia = I});
  const Fixed<2> a{{0.0, 0.0}}, b{{1.0, 0.0}};
  const auto track = scene.add(PointLineDistance{centre, a, b, R});
  const auto rough = scene.add(coulomb(track, Rolling{centre, wheel, a, b, R}, mu));
  const auto run = simulate(scene, options(2.0));
  const double rolls = v0 / (mu * g * (1.0 + m * R * R / I));
  ASSERT_EQ(run.events().size(), 1U);
  EXPECT_NEAR(run.events()[0].time, rolls, bound);
  EXPECT_NEAR(run.velocity(centre, 10).x(), v0 - mu * g * rolls, bound);
  EXPECT_NEAR(run.multiplier(rough, 10), 0.0, bound * g);
}

TEST_P(CoulombFriction, IsToldBesideMuchLargerForces) {
  // A light block that 1e11 times its weight presses nothing of.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto light = scene.add_particle({.mass = 1.0}),
             heavy = scene.add_particle({.mass = 1e11, .position = {5.0, 0.0}});
  const auto floor = scene.add(OnCurve{light, Plane<2>{}});
  scene.add(OnCurve{heavy, Plane<2>{}});
  scene.add(coulomb(floor, Slip{light, Plane<2>{}}, 0.05));
  scene.add(force_law(points(light), [](auto, auto) { return vec(1.0, 0.0); }));
  const auto run = simulate(scene, options(1.0));
  EXPECT_NEAR(run.velocity(light, 10).x(), 1.0 - 0.05 * g, bound);
}

TEST_P(CoulombFriction, FeetWhoseSharesDecideAreRefused) {
  // Two feet joined by a rod stick together; which of them has how much is not determined, and with
  // mu_static > mu it would be that which decides when they go.
  Scene<2> scene("feet");
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto left = scene.add_particle({.mass = 1.0}),
             right = scene.add_particle({.mass = 3.0, .position = {1.0, 0.0}});
  scene.add(Distance{left, right, 1.0});
  for (const auto foot : {left, right}) {
    const auto floor = scene.add(OnCurve{foot, Plane<2>{}});
    scene.add(coulomb(floor, Slip{foot, Plane<2>{}}, 0.2, 0.3), foot == left ? "left" : "right");
  }
  scene.add(force_law(points(left), [](auto t, auto, auto) { return vec(6.0 * t, 0.0); }));
  EXPECT_THAT([&] { (void)simulate(scene, options(4.0)); },
              ThrowsMessage<IntegrationFailure>(AllOf(HasSubstr("\"left\""), HasSubstr("not determined"))));
}

/// A block of mass 1 and weight 10 on a rough floor, with mu = 0.2 and mu_static = 0.3, beside a one-sided
/// constraint that keeps it from going to the right. A force to the right, F = F0 - 20 t, draws it away: it
/// holds up to F = -3, and slides with v' = F + 2.
class BesideAContact : public CoulombFriction {
 protected:
  template <class Stop>
  void lets_go(double F0, Stop stop, Contact contact) {
    Scene<2> scene("block");
    scene.add(UniformGravity<2>{{0.0, -10.0}});
    const auto block = scene.add_particle({.mass = 1.0}, "block");
    const auto floor = scene.add(OnCurve{block, Plane<2>{}}, "floor");
    const auto beside = scene.add(unilateral(stop(block), contact), "beside");
    const auto rough = scene.add(coulomb(floor, Slip{block, Plane<2>{}}, 0.2, 0.3), "rough");
    scene.add(force_law(
        points(block), [F0](auto t, auto r, auto) { return vec(F0 - 20.0 * t + 0.0 * r.x(), 0.0 * r.y()); }));
    const double goes = (F0 + 3.0) / 20.0, t = goes + 0.5;
    const auto run = simulate(scene, options(t));
    ASSERT_EQ(run.events().size(), 2U);
    for (const EventRecord& it : run.events()) EXPECT_NEAR(it.time, goes, bound);
    EXPECT_EQ(run.events()[0].kind, EventKind::slides);
    EXPECT_EQ(run.events()[0].source, static_cast<std::size_t>(rough.index));
    EXPECT_EQ(run.events()[1].kind, EventKind::opened);
    EXPECT_EQ(run.events()[1].source, static_cast<std::size_t>(beside.index));
    EXPECT_NEAR(run.velocity(block, 10).x(), (F0 + 2.0) * 0.5 - 10.0 * (t * t - goes * goes), 10.0 * bound);
    EXPECT_NEAR(run.multiplier(rough, 10), 2.0, 10.0 * bound);
  }
};
INSTANTIATE_TEST_SUITE_P(Runs, BesideAContact, at_tolerances, tolerance_name);

TEST_P(BesideAContact, LetsGoOfAWallThatCarriesNothing) {
  // With F0 > 0 the block first presses against the wall.
  for (const double F0 : {-0.5, 10.0})
    lets_go(F0, [](auto block) { return OnCurve{block, Plane<2>{.normal = {-1.0, 0.0}}}; }, {});
}

TEST_P(BesideAContact, LetsGoOnATautString) {
  lets_go(10.0,
          [](auto block) {
            return Distance{Fixed<2>{{-1.0, 0.0}}, block, 1.0};
          },
          {.allowed = Allowed::negative});
}

TEST_P(CoulombFriction, SlidesUpTheRoughWallOfARoughGroove) {
  // Both walls, at an angle a, are rough. F = 20 t pushes a block of weight 10 at the right one until the
  // left one carries nothing, at F (cos a - mu_static sin a) = 10 (sin a + mu_static cos a). On the right one
  // alone v' = F (cos a - mu sin a) - 10 (sin a + mu cos a).
  constexpr double a = 0.7, mu = 0.3;
  const double S = std::sin(a), C = std::cos(a);
  for (const double mu_static : {0.3, 0.4}) {
    Scene<2> scene("groove");
    scene.add(UniformGravity<2>{{0.0, -10.0}});
    const auto block = scene.add_particle({.mass = 1.0}, "block");
    const Plane<2> left_wall{.normal = {S, C}}, right_wall{.normal = {-S, C}};
    const auto left = scene.add(unilateral(OnCurve{block, left_wall}), "left"),
               right = scene.add(unilateral(OnCurve{block, right_wall}), "right");
    scene.add(coulomb(left, Slip{block, left_wall}, mu, mu_static), "rough left");
    scene.add(coulomb(right, Slip{block, right_wall}, mu, mu_static), "rough right");
    scene.add(force_law(points(block),
                        [](auto t, auto r, auto) { return vec(20.0 * t + 0.0 * r.x(), 0.0 * r.y()); }));
    const double goes = (S + mu_static * C) / (C - mu_static * S) / 2.0, t = goes + 0.5;
    const auto run = simulate(scene, options(t));
    const double v = 10.0 * (C - mu * S) * (t * t - goes * goes) - 10.0 * (S + mu * C) * 0.5;
    // Where the left wall's force falls to 0 it opens as late as forces are known, a part of those of 20.
    EXPECT_NEAR(run.velocity(block, 10).norm(), v, 20.0 * bound);
    EXPECT_NEAR(run.multiplier(right, 10), 20.0 * t * S + 10.0 * C, 20.0 * bound);
    EXPECT_EQ(run.multiplier(left, 10), 0.0);
    EXPECT_NEAR(run.events().front().time, goes, bound);
  }
}

TEST_P(CoulombFriction, FrictionThatLetsGoMayOpenAContact) {
  // A rod leans on a smooth wall at 45 degrees, its foot pulled away by F = k t. The foot holds F + m g of
  // what 1.5 (2 m g) it could; then, without friction, the rod would have to pull its top onto the wall by
  // F - m g. Free, it is under a tension of sqrt(2) (F - m g)/3, which gives its top a third of g.
  constexpr double k = 4.0;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto foot = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}),
             top = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}});
  scene.add(Distance{foot, top, std::sqrt(2.0)});
  const auto floor = scene.add(OnCurve{foot, Plane<2>{}}),
             wall = scene.add(unilateral(OnCurve{top, Plane<2>{{0.0, 0.0}, {1.0, 0.0}}}));
  const auto rough = scene.add(coulomb(floor, Slip{foot, Plane<2>{}}, 0.0, 1.5));
  scene.add(force_law(points(foot), [](auto t, auto, auto) { return vec(k * t, 0.0 * t); }));
  const double goes = 2.0 * g / k;
  const auto run = simulate(scene, options(goes + 0.1));
  ASSERT_EQ(run.events().size(), 2U);
  for (const EventRecord& it : run.events()) EXPECT_NEAR(it.time, goes, bound);
  EXPECT_EQ(run.events()[0].kind, EventKind::slides);
  EXPECT_EQ(run.events()[0].source, static_cast<std::size_t>(rough.index));
  EXPECT_EQ(run.events()[1].kind, EventKind::opened);
  EXPECT_EQ(run.events()[1].source, static_cast<std::size_t>(wall.index));
  EXPECT_NEAR(run.event_sample(1).multiplier(wall), g, bound * g);
  EXPECT_EQ(run.sample_after(1).multiplier(wall), 0.0);
  EXPECT_NEAR(run.sample_after(1).acceleration(top).x(), g / 3.0, bound * g);
}

TEST_P(CoulombFriction, FrictionIsExactWhereTheForceOfAWireChangesItsSign) {
  // N = -3 cos t: v = v0 - 3 mu integral |cos t| dt. |N| has a kink where the force is 0.
  constexpr double mu = 0.3, v0 = 5.0;
  for (const double loose : {1e-3, 1e-4, 1e-5, 1e-6, 1e-8}) {
    Scene<2> scene;
    const auto bead = scene.add_particle({.mass = 1.0, .velocity = {v0, 0.0}}, "bead");
    const auto wire = scene.add(OnCurve{bead, Plane<2>{}}, "wire");
    scene.add(force_law(points(bead), [](auto t, auto, auto) { return vec(0.0 * t, 3.0 * cos(t)); }));
    scene.add(coulomb(wire, Slip{bead, Plane<2>{}}, mu), "rough");
    Options with = options(3.0);
    with.tolerance = loose;
    const auto run = simulate(scene, with);
    for (std::size_t i = 0; i < run.size(); ++i) {
      const double t = run.times()[i], sine = std::sin(t);
      const double integral = t < std::numbers::pi / 2.0 ? sine : 2.0 - sine;
      // The sum of the errors of all steps is what a run says; the true error is at most twelve times that.
      EXPECT_NEAR(run.velocity(bead, i).x(), v0 - 3.0 * mu * integral, 12.0 * run.statistics().accuracy)
          << loose;
    }
  }
}

TEST_P(CoulombFriction, UnpressedContactDoesNotChatter) {
  // Nothing presses, nothing pulls.
  Scene<2> scene;
  const auto block = scene.add_particle({.mass = 1.0});
  const auto floor = scene.add(unilateral(OnCurve{block, Plane<2>{}}));
  scene.add(coulomb(floor, Slip{block, Plane<2>{}}, 0.3));
  const auto run = simulate(scene, options(1.0));
  EXPECT_EQ(run.position(block, 10).norm(), 0.0);
  EXPECT_TRUE(run.events().empty());
}

// On a wire that presses to either side, N = k (t - t0), a force f along it has to be held by mu |N|: it
// slides from t0 - a on, a = f/(mu k), until t0 + (1 + root of 2) a. With s = (t - t0)/a
//
//   v = f a/m [(s + 1) - (1 + sgn(s) s^2)/2],   x = f a^2/m (1 + 2/3 root of 2) in all.
//
// The larger k, the narrower is the corner of the bound, down to 1e-5 of a run that moves at no other time.
TEST(Coulomb, LetsGoWhereTheNormalForcePassesZero) {
  constexpr double f = 1.0, mu = 0.5, t0 = 0.37, root = std::numbers::sqrt2;
  for (const Stepper stepper : {Stepper::ida, Stepper::erk})
    for (const double tolerance : {1e-6, 1e-9})
      for (const double k : {1e2, 1e3, 1e4, 1e5}) {
        const double a = f / (mu * k);
        Scene<2> scene;
        const auto bead = scene.add_particle({.mass = 1.0});
        const auto wire = scene.add(OnCurve{bead, Plane<2>{}});
        scene.add(coulomb(wire, Slip{bead, Plane<2>{}}, mu));
        scene.add(force_law(points(bead), [=](auto t, auto, auto v) {
          return vec(f + 0.0 * v.x(), k * (t - t0) + 0.0 * v.x());
        }));
        const auto run =
            simulate(scene, {.t_end = 1.0, .samples = 3, .tolerance = tolerance, .stepper = stepper});
        ASSERT_EQ(run.events().size(), 2U);
        EXPECT_NEAR(run.events()[0].time, t0 - a, tolerance);
        EXPECT_NEAR(run.events()[1].time, t0 + (1.0 + root) * a, tolerance);
        const double x = f * a * a * (1.0 + 2.0 / 3.0 * root);
        EXPECT_NEAR(run.position(bead, 2).x(), x, 1000.0 * tolerance * x);  // as all models keep to
      }
}

// A ball slides 0.3 down a slope of 0.3 rad, with a = G (sin 0.3 - 0.2 cos 0.3), and strikes one that sticks,
// without restitution: P = m_1 m_2/(m_1 + m_2) v. Floors are across the impact, also where the rounding of
// positions turns their normals by 1e-11.
TEST(Coulomb, TakesNoImpulseAlongASlopeFarAway) {
  constexpr double G = 10.0, slope = 0.3;
  const Vec<2> down(std::cos(slope), -std::sin(slope)), up(std::sin(slope), std::cos(slope));
  for (const auto& [far, stepper] : {std::pair(0.0, Stepper::ida), std::pair(1e5, Stepper::ida),
                                     std::pair(0.0, Stepper::erk), std::pair(1e5, Stepper::erk)}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -G}});
    const Vec<2> start(far, -far);
    const auto first = scene.add_particle({.mass = 1.0, .position = start, .velocity = down}),
               second = scene.add_particle({.mass = 2.0, .position = start + 0.5 * down});
    const Plane<2> plane{start, up};
    for (const auto& [ball, mu] : {std::pair(first, 0.2), std::pair(second, 4.0)})
      scene.add(coulomb(scene.add(OnCurve{ball, plane}), Slip{ball, plane}, mu));
    const auto hit = scene.add(unilateral(Distance{first, second, 0.2}, {.restitution = 0.0}));
    const auto run = simulate(scene, {.t_end = 1.0, .tolerance = 1e-6, .stepper = stepper, .assemble = true});
    const double v = std::sqrt(1.0 + 2.0 * 0.3 * G * (std::sin(slope) - 0.2 * std::cos(slope)));
    ASSERT_FALSE(run.events().empty());
    EXPECT_NEAR(run.impulse(hit, 0), 2.0 / 3.0 * v, 1e-4);  // 100 tolerances
  }
}

// A block of 1 kg slides down a slope of 0.2 and strikes one of 2 kg at rest, with e = 1/2: of its speed w it
// keeps none, the other has w/2 and slides w^2/(8 b) until it sticks. So the next w is sqrt(2 a/(8 b)) as
// large, and they come to rest. The second bounce rises by 1e-10.
TEST(Coulomb, LetsBlocksOnASlopeComeToRestByImpacts) {
  constexpr double G = 10.0, slope = 0.2;
  const double a = G * (std::sin(slope) - 0.2 * std::cos(slope)),
               b = G * (4.0 * std::cos(slope) - std::sin(slope));
  const double square = 1.0 + 2.0 * 0.3 * a, ratio = 2.0 * a / (8.0 * b);  // of speeds, squared
  const double x = 0.3 + square / (8.0 * b) / (1.0 - ratio);
  for (const Stepper stepper : {Stepper::ida, Stepper::erk})
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
      Scene<2> scene;
      scene.add(UniformGravity<2>{{G * std::sin(slope), -G * std::cos(slope)}});
      const auto upper = scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.0}}),
                 lower = scene.add_particle({.mass = 2.0, .position = {0.5, 0.0}});
      for (const auto& [block, mu] : {std::pair(upper, 0.2), std::pair(lower, 4.0)})
        scene.add(coulomb(scene.add(OnCurve{block, Plane<2>{}}), Slip{block, Plane<2>{}}, mu));
      scene.add(unilateral(Distance{upper, lower, 0.2}, {.restitution = 0.5}));
      const auto run =
          simulate(scene, {.t_end = 1.0, .samples = 3, .tolerance = tolerance, .stepper = stepper});
      EXPECT_NEAR(run.position(upper, 2).x(), x, 10.0 * tolerance);
      EXPECT_NEAR(run.position(lower, 2).x(), x + 0.2, 10.0 * tolerance);
      EXPECT_NEAR(run.velocity(upper, 2).x(), 0.0, tolerance);
    }
}

// A block of weight 10 at a wall, on a floor of mu 0.3, under a force F into the wall and out of it: friction
// holds it wherever F > -3, the wall where friction does not. At F = 0 the wall has no force left; from F = 3
// it has some again, or from where friction reaches its bound.
TEST(Coulomb, LeavesWhatAWallHasLetGoToTheWallAgain) {
  for (const Stepper stepper : {Stepper::ida, Stepper::erk})
    for (const double tolerance : {1e-4, 1e-6, 1e-9}) {
      Scene<2> scene;
      scene.add(UniformGravity<2>{{0.0, -10.0}});
      const auto block = scene.add_particle({.mass = 1.0});
      const Plane<2> wall_plane{{0.0, 0.0}, {-1.0, 0.0}};
      const auto floor = scene.add(unilateral(OnCurve{block, Plane<2>{}}));
      const auto wall = scene.add(unilateral(OnCurve{block, wall_plane}));
      const auto friction = scene.add(coulomb(floor, Slip{block, Plane<2>{}}, 0.3));
      scene.add(force_law(points(block), [](auto t, auto r, auto) {
        return vec(1.05 + 3.95 * cos(t) + 0.0 * r.x(), 0.0 * r.x());
      }));
      const auto run =
          simulate(scene, {.t_end = 20.0, .samples = 41, .tolerance = tolerance, .stepper = stepper});
      for (std::size_t i = 0; i < run.size(); ++i) {
        const double F = 1.05 + 3.95 * std::cos(run.times()[i]);
        EXPECT_NEAR(run.position(block, i).x(), 0.0, tolerance);
        EXPECT_NEAR(run.multiplier(wall, i) - run.multiplier(friction, i), F, 10.0 * tolerance);
        EXPECT_GE(run.multiplier(wall, i), 0.0);
        EXPECT_LE(std::abs(run.multiplier(friction, i)), 3.0 + 10.0 * tolerance);
      }
    }
}

// A body on three legs, each on a slope of its own: N = (4.35, 0, 14.98), T = (0.31, 0, -4.79) hold it, but
// no friction within the bounds of the normal forces of least norm does.
TEST(Coulomb, HoldsABodyOnLegsOnSlopes) {
  struct Leg {
    double x, y, slope, mu;
  };
  const Vec<2> centre(0.47, 0.36), weight(1.8, -20.0);
  const Leg legs[] = {{-0.95, -0.29, 0.09, 0.27}, {0.15, -0.22, -0.06, 0.18}, {0.92, -0.10, -0.20, 0.40}};
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{0.5 * weight});
    const auto body = add_body(scene, BodyState<2>{.mass = 2.0, .inertia = 1.0, .centre = centre}, "body");
    std::vector<Constraint<1>> floors, frictions;
    for (const auto& [x, y, slope, mu] : legs) {
      const auto foot = body.point_at({x, y});
      const Plane<2> floor{{x, y}, {-std::sin(slope), std::cos(slope)}};
      floors.push_back(scene.add(unilateral(OnCurve{foot, floor})));
      frictions.push_back(scene.add(coulomb(floors.back(), Slip{foot, floor}, mu)));
    }
    const auto run = simulate(scene, {.t_end = 1.0, .samples = 2, .stepper = stepper});
    EXPECT_TRUE(run.events().empty());
    constexpr double rounding = 1e-12;  // of some solves
    Vec<2> force = weight;
    double moment = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double N = run.multiplier(floors[k], 1), c = std::cos(legs[k].slope), s = std::sin(legs[k].slope);
      const double T = run.multiplier(frictions[k], 1);
      const Vec<2> own(T * c - N * s, T * s + N * c);
      const Vec<2> arm(legs[k].x - centre.x(), legs[k].y - centre.y());
      EXPECT_GE(N, 0.0);
      EXPECT_LE(std::abs(T), legs[k].mu * N + rounding);
      force += own;
      moment += arm.x() * own.y() - arm.y() * own.x();
    }
    EXPECT_NEAR(force.norm(), 0.0, 20.0 * rounding);
    EXPECT_NEAR(moment, 0.0, 20.0 * rounding);
  }
}

TEST_P(CoulombFriction, IsDecidedForEachPartByItself) {
  // A pull of 5 m/s^2 along a floor: what holds by mu = 0.6 stays, what has 0.3 slides with 5 - 0.3 10. Two
  // on a rod share: 5 - (0.3 + 0.6) 10/2. Positions of 20 m are known to the tolerance of that length.
  constexpr double t = 0.5;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{5.0, -10.0}});
  std::vector<Particle<2>> blocks;
  for (int i = 0; i < 10; ++i) {
    blocks.push_back(scene.add_particle({.mass = 1.0, .position = {2.0 * i, 0.0}}));
    const auto floor = scene.add(OnCurve{blocks.back(), Plane<2>{}});
    scene.add(coulomb(floor, Slip{blocks.back(), Plane<2>{}, {0.0, 0.0}}, i % 2 == 0 ? 0.3 : 0.6));
  }
  scene.add(Distance{blocks[4], blocks[5], 2.0});
  const auto run = simulate(scene, options(t));
  for (int i = 0; i < 10; ++i) {
    const double a = i == 4 || i == 5 ? 0.5 : i % 2 == 0 ? 2.0 : 0.0;
    EXPECT_NEAR(run.position(blocks[static_cast<std::size_t>(i)], 10).x(), 2.0 * i + 0.5 * a * t * t,
                20.0 * error_of(run))
        << i;
  }
}

TEST(Coulomb, SlipThatThrowsWhereverItIsReadIsAnErrorByName) {
  // At each of its evaluations in turn, those for results among them.
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    long refused = 0;
    for (long fatal = 1;; ++fatal, ++refused) {
      long calls = 0;
      Scene<2> scene;
      scene.add(UniformGravity<2>{{0.0, -10.0}});
      const auto block = scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.0}});
      const auto floor = scene.add(OnCurve{block, Plane<2>{}});
      const auto slip = [&calls, &fatal](auto, auto v) {
        if (++calls == fatal) throw std::runtime_error("no speed");
        return v.x();
      };
      scene.add(coulomb(floor, nonholonomic(points(block), slip), 0.2), "rough");
      try {
        (void)simulate(scene, {.t_end = 0.01, .samples = 3, .tolerance = 1e-3, .stepper = stepper});
        if (calls < fatal) break;
      } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("\"rough\"")) << fatal;
      }
    }
    EXPECT_GT(refused, 10);
  }
}

TEST(Coulomb, ManyConstantForcesAreLookedAtAsOftenAsFew) {
  // Normal forces and slips that turn by their round-off do not reach 0 there: steps are read at the times
  // that all functions share. The blocks are independent: the steps are the same. One length for both, beside
  // which the rounding of the farthest block is nothing.
  const auto evaluations = [](int blocks, Stepper stepper) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    for (int i = 0; i < blocks; ++i) {
      const auto block =
          scene.add_particle({.mass = 1.0, .position = {2.0 * i, 0.0}, .velocity = {1.0, 0.0}});
      const auto floor = scene.add(unilateral(OnCurve{block, Plane<2>{}}));
      scene.add(coulomb(floor, Slip{block, Plane<2>{}, {0.0, 0.0}}, 0.3));
    }
    const auto statistics =
        simulate(scene, {.t_end = 1e-3, .samples = 2, .stepper = stepper, .length = 1000.0}).statistics();
    return std::pair(statistics.steps, statistics.evaluations);
  };
  for (const Stepper stepper : {Stepper::ida, Stepper::erk})
    EXPECT_EQ(evaluations(400, stepper), evaluations(4, stepper));
}

TEST(Coulomb, RefusesWhatItIsNotFor) {
  Incline scene(0.0, 0.0, 0.1, 0.2);
  const auto add = [&scene](double mu, double mu_static) {
    scene.scene.add(coulomb(scene.floor, Slip{scene.block, Plane<2>{}}, mu, mu_static));
  };
  EXPECT_THAT([&] { add(-0.1, 0.2); }, ThrowsMessage<InvalidScene>(HasSubstr("mu = -0.1")));
  EXPECT_THAT([&] { add(0.3, 0.2); }, ThrowsMessage<InvalidScene>(HasSubstr("mu_static = 0.2")));
  EXPECT_THROW(scene.scene.add(coulomb(Constraint<1>{}, Slip{scene.block, Plane<2>{}}, 0.1)),
               InvalidArgument);
  EXPECT_THAT([&] { (void)equilibrium(scene.scene); }, ThrowsMessage<NoEquilibrium>(HasSubstr("\"rough\"")));
}

// Constant friction brakes in steps of any length without an error: what is left is the round-off of their
// velocities, in the scene's speed. A slip that had to pass below 0 by a margin ended late by 1e-11.
TEST_P(CoulombFriction, EndsWhereTheSlipIsZero) {
  constexpr double a = 0.3 * g, fast = 10.0;
  for (const double v : {0.5, 1.0, 2.0, 3.0}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto block = scene.add_particle({.mass = 1.0, .velocity = {v, 0.0}});
    scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}, .velocity = {fast, 0.0}});
    scene.add(coulomb(scene.add(OnCurve{block, Plane<2>{}}), Slip{block, Plane<2>{}}, 0.3));
    const auto run = simulate(scene, options(2.0 * v / a));
    ASSERT_EQ(run.events().size(), 1U);
    EXPECT_NEAR(run.events()[0].time, v / a, 100.0 * epsilon * fast / a) << v;
  }
}

}  // namespace
}  // namespace dalembert::coulomb_test
