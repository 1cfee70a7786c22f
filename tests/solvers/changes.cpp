#include <dalembert/tests/solvers/with_events.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace dalembert::changes_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class Changes : public WithEvents {};
INSTANTIATE_TEST_SUITE_P(Runs, Changes, at_tolerances, tolerance_name);

/// A pendulum of length 1 that is let go where it is level.
struct Pendulum {
  Scene<2> scene{"pendulum"};
  Particle<2> bob;
  Constraint<1> rod;
  Force gravity;

  Pendulum() {
    gravity = scene.add(UniformGravity<2>{{0.0, -g}});
    bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "bob");
    rod = scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");
  }
  [[nodiscard]] Event<2> at_the_bottom(std::function<void(Scene<2>&)> change) const {
    return {"bottom", [bob = bob](const auto& now) { return now.position(bob).x(); }, Crossing::falling,
            false, std::move(change)};
  }
};

TEST_P(Changes, ReleaseAConstraint) {
  // Cut where it hangs straight the bob flies on at sqrt(2 g).
  const Pendulum p;
  const auto cut = p.at_the_bottom([rod = p.rod](Scene<2>& scene) { scene.release(rod); });
  auto o = options(1.0);
  o.dense = true;
  const auto run = simulate(p.scene, o, {cut});
  ASSERT_EQ(run.events().size(), 1U);
  const double left = 1.0 - run.events()[0].time, v = std::sqrt(2.0 * g);
  EXPECT_NEAR(run.event_sample(0).multiplier(p.rod), -3.0 * g, bound * g);
  EXPECT_EQ(run.sample_after(0).multiplier(p.rod), 0.0);
  EXPECT_NEAR(run.position(p.bob, 10).x(), -v * left, bound);
  EXPECT_NEAR(run.position(p.bob, 10).y(), -1.0 - g * left * left / 2.0, bound);
  EXPECT_EQ(run.multiplier(p.rod, 10), 0.0);
  const auto between = run.at({0.3, 0.999});
  EXPECT_LT(between.multiplier(p.rod, 0), -0.1 * g);
  EXPECT_EQ(between.multiplier(p.rod, 1), 0.0);
}

TEST_P(Changes, ImposeAConstraintWithItsImpulse) {
  // A ball in free fall is caught by a rod of length 1 where it is that far from the pivot.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto ball = scene.add_particle({.mass = 2.0, .position = {0.6, 0.0}});
  const auto rod = scene.add(Distance{Fixed<2>{}, ball, 1.0}, "rod");
  scene.release(rod);
  const Event<2> caught{"caught", [=](const auto& now) { return now.position(ball).norm() - 1.0; },
                        Crossing::rising, false, [=](Scene<2>& s) { s.impose(rod); }};
  const auto run = simulate(scene, options(1.0), {caught});
  ASSERT_EQ(run.events().size(), 1U);
  const double t = std::sqrt(2.0 * 0.8 / g), v = g * t;
  EXPECT_NEAR(run.events()[0].time, t, bound);
  EXPECT_NEAR(run.impulse(rod, 0), -2.0 * 0.8 * v, bound * g);
  const auto after = run.sample_after(0);
  EXPECT_NEAR(after.velocity(ball).dot(after.position(ball)), 0.0, bound);
  EXPECT_NEAR(after.velocity(ball).norm(), 0.6 * v, bound * v);
  EXPECT_NEAR(run.energy(10), after.energy(), bound * g);
  EXPECT_NEAR(run.position(ball, 10).norm(), 1.0, tolerance);
}

TEST_P(Changes, CatchASpinningBodyBesideItsPath) {
  // A pin takes hold of it at d from its centre, farther on its way by what counts as rounded. Its moment of
  // momentum about the pin stays: (I + m d^2) omega = I omega_0.
  constexpr double m = 2.0, I = 0.3, omega = 7.0, d = 0.5, late = 0.1;
  for (const double beside : {1e-10, 1e-9, 4e-9}) {
    Scene<2> scene;
    const auto body =
        add_body(scene, BodyState<2>{.mass = m, .inertia = I, .angular_velocity = omega}, "body");
    const double c = std::cos(late * omega), s = std::sin(late * omega);
    const auto pin = scene.add(
        Coincident{Fixed<2>{{d * c - beside * s, d * s + beside * c}}, body.point({d, 0.0})}, "pin");
    scene.release(pin);
    const Event<2> caught{"caught", [](const auto& now) { return now.time() - late; }, Crossing::rising,
                          false, [=](Scene<2>& its) { its.impose(pin); }};
    const auto run = simulate(scene, options(0.5), {caught});
    EXPECT_NEAR(angular_velocity(run.sample_after(0), body), omega * I / (I + m * d * d),
                omega * error_of(run) + omega * omega * beside);
  }
}

TEST_P(Changes, LatchADoorWhereItHasSwungBack) {
  // Let go where it is level it comes back there after every period, of 4 K(sin 45 deg) / omega with omega^2
  // = m g d / (I + m d^2), to the accuracy of the run. Hung at both ends it rests on them with half its
  // weight.
  const double period = 4.0 * 1.8540746773013719 / std::sqrt(g / 1.1);
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto door = add_body(scene, BodyState<2>{.mass = 1.0, .inertia = 0.1, .centre = {1.0, 0.0}}, "door");
  add_joint(scene, Revolute{Ground<2>{}, door, {0.0, 0.0}}, "hinge");
  const auto edge = door.point({1.0, 0.0});
  const auto latch = scene.add(Coincident{Fixed<2>{{2.0, 0.0}}, edge}, "latch");
  scene.release(latch);
  const Event<2> back{
      "back", [=](const auto& now) { return now.time() < 3.0 * period - 0.3 ? 1.0 : now.velocity(edge).y(); },
      Crossing::falling, false, [=](Scene<2>& its) { its.impose(latch); }};
  const auto run = simulate(scene, options(3.0 * period + 1.0), {back});
  ASSERT_EQ(run.events().size(), 1U);
  // A time errs by the error of the velocity over the acceleration, here of about the length over time^2.
  EXPECT_NEAR(run.events()[0].time, 3.0 * period, error_of(run) * run.statistics().time);
  EXPECT_NEAR(run.multiplier(latch, 10).y(), 0.5 * g, g * error_of(run));
}

TEST_P(Changes, StateForcesMassesAndVelocitiesAnew) {
  // At the bottom gravity doubles, the bob gets four times its mass, and is stopped: it stays.
  const Pendulum p;
  const auto change = p.at_the_bottom([p](Scene<2>& scene) {
    scene.replace(p.gravity, UniformGravity<2>{{0.0, -2.0 * g}});
    scene.replace(p.bob, ParticleState<2>{.mass = 4.0, .position = {0.0, -1.0}});
  });
  const auto run = simulate(p.scene, options(2.0), {change});
  ASSERT_EQ(run.events().size(), 1U);
  EXPECT_NEAR(run.multiplier(p.rod, 10), -8.0 * g, bound * g);
  EXPECT_NEAR((run.position(p.bob, 10) - Vec<2>(0.0, -1.0)).norm(), 0.0, tolerance);
  EXPECT_NEAR(run.sample(0).force(p.gravity, p.bob).y(), -g, bound);
  EXPECT_NEAR(run.sample(10).force(p.gravity, p.bob).y(), -8.0 * g, bound * g);
  EXPECT_NEAR(run.event_sample(0).force(p.gravity, p.bob).y(), -g, bound);
  EXPECT_NEAR(run.sample_after(0).force(p.gravity, p.bob).y(), -8.0 * g, bound * g);
  Simulation<2> sim(p.scene, options(2.0), {change});
  sim.advance_to(0.1);
  EXPECT_NEAR(sim.sample().force(p.gravity, p.bob).y(), -g, bound);
  sim.advance_to(2.0);
  EXPECT_NEAR(sim.sample().force(p.gravity, p.bob).y(), -8.0 * g, bound * g);
}

TEST_P(Changes, KickWhatRestsOnAFloor) {
  // Whenever t passes a whole number of half seconds a ball at rest is sent up at 1: it is back after 2/g.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto ball = scene.add_particle({.mass = 1.0});
  const auto floor = scene.add(unilateral(OnCurve{ball, Plane<2>{}}));
  const Event<2> kick{"kick",
                      [](const auto& now) { return std::sin(2.0 * std::numbers::pi * (now.time() - 0.5)); },
                      Crossing::rising, false,
                      [=](Scene<2>& s) {
                        s.replace(ball, ParticleState<2>{.mass = 1.0, .velocity = {0.0, 1.0}});
                      }};
  const auto run = simulate(scene, options(2.2), {kick});
  ASSERT_EQ(run.events().size(), 6U);  // kicked, and opened; struck, twice
  for (std::size_t k = 0; k < 6; k += 3) {
    const double t = 0.5 + static_cast<double>(k / 3);
    EXPECT_EQ(run.events()[k].kind, EventKind::event);
    EXPECT_NEAR(run.events()[k].time, t, bound);
    EXPECT_EQ(run.events()[k + 1].kind, EventKind::opened);
    EXPECT_EQ(run.events()[k + 2].kind, EventKind::struck);
    EXPECT_NEAR(run.events()[k + 2].time, t + 2.0 / g, bound);
    EXPECT_NEAR(run.impulse(floor, k + 2), 1.0, bound);
  }
}

TEST_P(Changes, ImpactReachesWhatAReplacedRodHolds) {
  // A rod from A to B holds C instead, on a floor below a guide. A turns about C, at 2, against a ceiling at
  // an angle of 30 degrees, P = 2 v/cos 30: the rod's share P sin 30 presses C down by P sin^2 30.
  constexpr double G = 10.0, v = 2.0;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -G}});
  const auto A = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "A"),
             B = scene.add_particle({.mass = 1.0, .position = {2.0, 0.0}}, "B"),
             C = scene.add_particle({.mass = 5.0}, "C");
  scene.add(force_law(points(A), [](auto, auto r, auto) { return vec(0.0 * r.x(), 0.0 * r.y() + G); }));
  scene.add(holonomic(points(C), [](auto r) { return r.x(); }), "guide");
  scene.add(unilateral(OnCurve{B, Plane<2>{}}));
  const auto floor = scene.add(unilateral(OnCurve{C, Plane<2>{}}), "floor"),
             ceiling = scene.add(
                 unilateral(OnCurve{A, Plane<2>{{0.0, 0.5}, {0.0, -1.0}}}, {.restitution = 1.0}), "ceiling");
  const auto rod = scene.add(Distance{A, B, 1.0}, "rod");
  const Event<2> move{
      "move", [](const auto& now) { return now.time() - 0.1; }, Crossing::rising, false,
      [=](Scene<2>& s) {
        s.replace(rod, Distance{A, C, 1.0});
        s.replace(A, ParticleState<2>{.mass = 1.0, .position = {1.0, 0.0}, .velocity = {0.0, v}});
      }};
  const auto run = simulate(scene, options(0.8), {move});
  const double P = 2.0 * v / std::cos(std::numbers::pi / 6.0);
  std::size_t struck = 0;
  for (std::size_t k = 0; k < run.events().size(); ++k) {
    const EventRecord& it = run.events()[k];
    if (it.kind != EventKind::struck || it.source != static_cast<std::size_t>(ceiling.index)) continue;
    ++struck;
    EXPECT_NEAR(it.time, 0.1 + std::numbers::pi / 6.0 / v, bound);
    EXPECT_NEAR(run.impulse(ceiling, k), P, bound);
    EXPECT_NEAR(run.impulse(floor, k), 0.25 * P, bound);
  }
  EXPECT_EQ(struck, 1U);
  EXPECT_NEAR(run.position(C, 10).norm(), 0.0, bound);
}

TEST_P(Changes, GapIsRestatedInAnotherUnit) {
  // Of the same floor: a ball that falls from 1 meets it at sqrt(2/g), and rests three times as late.
  const double first = std::sqrt(2.0 / g);
  const auto ground = [](const Particle<2>& ball, double unit) {
    return unilateral(holonomic(points(ball), [unit](auto r) { return r.y() / unit; }), {.restitution = 0.5});
  };
  for (const double unit : {1e-6, 1e6}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto ball = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}});
    const auto floor = scene.add(ground(ball, 1.0), "floor");
    const Event<2> restate{"restate", [](const auto& now) { return now.time() - 0.2; }, Crossing::rising,
                           false, [=](Scene<2>& s) { s.replace(floor, ground(ball, unit)); }};
    const auto run = simulate(scene, options(2.0), {restate});
    ASSERT_EQ(run.events()[1].kind, EventKind::struck);
    EXPECT_NEAR(run.events()[1].time, first, bound);
    EXPECT_NEAR(run.impulse(floor, 1) / unit, 1.5 * g * first, bound);
    EXPECT_EQ(run.events().back().kind, EventKind::rested);
    EXPECT_NEAR(run.events().back().time, 3.0 * first, bound);
  }
}

TEST_P(Changes, ContactsAndFrictionAnswerAnImposedConstraint) {
  // A ball rests on a floor, another of the same mass goes up at v beside it; where the rod between them is
  // imposed both go up at v/2: the floor does not hold the first. On a rough floor two blocks go sideways.
  for (const bool rough : {false, true}) {
    Scene<2> scene;
    const Vec<2> way = rough ? Vec<2>(1.0, 0.0) : Vec<2>(0.0, 1.0);
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto a = scene.add_particle({.mass = 1.0});
    const auto b = scene.add_particle({.mass = 1.0, .position = 0.5 * way, .velocity = 6.0 * way});
    const auto floor = scene.add(unilateral(OnCurve{a, Plane<2>{}}));
    if (rough) {
      scene.add(coulomb(floor, Slip{a, Plane<2>{}}, 0.3));
      scene.add(OnCurve{b, Plane<2>{}});
    }
    const auto rod = scene.add(Distance{a, b, 1.0}, "rod");
    scene.release(rod);
    const Event<2> taut{"taut",
                        [=](const auto& now) { return (now.position(b) - now.position(a)).norm() - 1.0; },
                        Crossing::rising, false, [=](Scene<2>& s) { s.impose(rod); }};
    const auto run = simulate(scene, options(0.2), {taut});
    ASSERT_GE(run.events().size(), 1U);
    const double v = run.event_sample(0).velocity(b).dot(way);
    EXPECT_NEAR(run.sample_after(0).velocity(a).dot(way), 0.5 * v, bound * v) << rough;
    EXPECT_NEAR(run.impulse(rod, 0), -0.5 * v, bound * v) << rough;
    EXPECT_NEAR(run.impulse(floor, 0), 0.0, bound * v) << rough;
  }
}

TEST_P(Changes, SimultaneousChangesAreAllCarriedOutAndListed) {
  Scene<2> scene;
  const auto ball = scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.0}});
  const auto speed_up = [=](double by) {
    return [=](Scene<2>& s) {
      const Vec<2> r(s.initial_positions()[0], s.initial_positions()[1]);
      const Vec<2> v(s.initial_velocities()[0] + by, s.initial_velocities()[1]);
      s.replace(ball, ParticleState<2>{.mass = 1.0, .position = r, .velocity = v});
    };
  };
  const auto at_half = [](const auto& now) { return now.time() - 0.5; };
  const std::vector<Event<2>> events{{"A", at_half, Crossing::rising, false, speed_up(1.0)},
                                     {"B", at_half, Crossing::rising, false, speed_up(2.0)},
                                     {"C", at_half}};
  const auto run = simulate(scene, options(1.0), events);
  ASSERT_EQ(run.events().size(), 3U);
  EXPECT_NEAR(run.position(ball, 10).x(), 0.5 + 0.5 * 4.0, bound);
  auto with_end = events;
  with_end[2].ends = true;
  const auto ended = simulate(scene, options(1.0), with_end);
  EXPECT_NEAR(ended.times().back(), 0.5, bound);
  ASSERT_EQ(ended.events().size(), 3U);
  EXPECT_NEAR(ended.sample_after(2).velocity(ball).x(), 4.0, bound);
}

// A ball falls 1/2 onto a floor without restitution; where it strikes, at sqrt(1/g), the user ends the run.
TEST_P(Changes, ImpactIsCarriedOutWhereAnEventEndsTheRun) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto ball = scene.add_particle({.mass = 1.0, .position = {0.0, 0.5}});
  const auto floor = scene.add(unilateral(OnCurve{ball, Plane<2>{}}));
  const auto run = simulate(scene, options(1.0),
                            {{.name = "down",
                              .function = [ball](const auto& now) { return now.position(ball).y(); },
                              .ends = true}});
  EXPECT_NEAR(run.times().back(), std::sqrt(1.0 / g), bound);
  ASSERT_EQ(run.events().size(), 2U);
  EXPECT_EQ(run.events()[1].kind, EventKind::struck);
  EXPECT_NEAR(run.impulse(floor, 1), std::sqrt(g), 10.0 * bound);
  EXPECT_NEAR(run.event_sample(1).velocity(ball).y(), -std::sqrt(g), 10.0 * bound);
  EXPECT_NEAR(run.sample_after(1).velocity(ball).y(), 0.0, bound);
}

/// A bead that is caught 5 tolerances beside where it is may be, then, once more so far off beside the twelve
/// of its steps, not twelve times as far: else each catch could miss by more than the one before.
TEST_P(Changes, WhatEventsMoveDoesNotAddUp) {
  const auto caught_beside = [&](double first, double second) {
    Scene<2> scene;
    const auto bead = scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.0}});
    scene.add(OnCurve{bead, Plane<2>{}});
    const auto bob = scene.add_particle({.mass = 1.0, .position = {6.0, 0.0}});
    scene.add(Distance{Fixed<2>{{5.0, 0.0}}, bob, 1.0});
    std::vector<Event<2>> events;
    for (const auto& its_place : {std::pair{0.1, first}, std::pair{0.3, second}}) {
      const double x = its_place.first, place = x + its_place.second;
      const auto stop = scene.add(holonomic(points(bead), [=](auto r) { return r.x() - place; }));
      scene.release(stop);
      events.push_back({.name = "caught",
                        .function = [=](const Sample<2>& now) { return now.position(bead).x() - x; },
                        .crossing = Crossing::rising,
                        .change = [=](Scene<2>& its) { its.impose(stop); }});
      events.push_back(
          {.name = "goes on",
           .function = [=](const Sample<2>& now) { return now.time() - 2.0 * x; },
           .change =
               [=](Scene<2>& its) {
                 its.release(stop);
                 its.replace(bead, {.mass = 1.0, .position = {place, 0.0}, .velocity = {1.0, 0.0}});
               }});
    }
    Options more = options(1.0);
    more.tolerance = std::max(more.tolerance, 1e-6);  // below 1e-8 of the length anything counts as satisfied
    return simulate(scene, more, events);
  };
  const Statistics known = caught_beside(0.0, 0.0).statistics();
  const double unit = known.accuracy * known.length;
  EXPECT_EQ(caught_beside(5.0 * unit, 10.0 * unit).statistics().singular_positions, 0);
  EXPECT_THROW((void)caught_beside(5.0 * unit, 60.0 * unit), IntegrationFailure);
}

// The last step reaches from several samples to the change at its end: they are of the motion before it.
TEST_P(Changes, LastChangeLeavesTheSamplesBeforeIt) {
  Scene<2> scene;
  const auto body = scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.0}});
  const Event<2> back{
      .name = "back",
      .function = [](const auto& now) { return now.time() - 1.0; },
      .change =
          [=](Scene<2>& s) {
            s.replace(body, ParticleState<2>{.mass = 1.0, .position = {1.0, 0.0}, .velocity = {-2.0, 0.0}});
          }};
  const auto run = simulate(scene, options(1.0), {back});
  for (std::size_t i = 0; i < run.size(); ++i) {
    EXPECT_NEAR(run.position(body, i).x(), run.times()[i], bound) << i;
    EXPECT_NEAR(run.velocity(body, i).x(), 1.0, bound) << i;
  }
  EXPECT_NEAR(run.sample_after(0).velocity(body).x(), -2.0, bound);
}

/// A ball that flies sideways and that its user reflects to a part of its speed: the times accumulate.
/// (Sideways its scene has the length of its path, and steps grow far beyond the flights.)
struct Reflected {
  Scene<2> scene{"ball"};
  Particle<2> ball;

  explicit Reflected(double sideways) {
    scene.add(UniformGravity<2>{{0.0, -g}});
    ball = scene.add_particle({.mass = 1.0, .position = {3.0, 1.0}, .velocity = {sideways, 0.0}});
  }
  [[nodiscard]] Event<2> bounce(double restitution) const {
    return {"bounce", [ball = ball](const auto& now) { return now.position(ball).y(); }, Crossing::falling,
            false,
            [ball = ball, restitution](Scene<2>& s) {
              const auto q = s.initial_positions(), v = s.initial_velocities();
              s.replace(ball,
                        ParticleState<2>{
                            .mass = 1.0, .position = {q[0], q[1]}, .velocity = {v[0], -restitution * v[1]}});
            }};
  }
};

TEST_P(Changes, ChatteringChangesAreErrors) {
  // Whatever the ratio of the flights: where too few are seen for their limit to be known, the first that is
  // lost in round-off is enough.
  for (const double restitution : {0.9, 0.5, 0.1, 1e-2, 1e-3, 1e-4}) {
    for (const double sideways : {0.0, 1.0}) {
      const Reflected its(sideways);
      EXPECT_THAT([&] { (void)simulate(its.scene, options(20.0), {its.bounce(restitution)}); },
                  ThrowsMessage<IntegrationFailure>(AllOf(HasSubstr("bounce"), HasSubstr("chatters"))))
          << restitution << ' ' << sideways;
    }
  }
}

TEST_P(Changes, StopsAreImposedWhereTheRunErrs) {
  // A block swings on a spring, x = cos wt, and is stopped where it must be by then. The run misses that by
  // its own error, which may be more than its estimate: in the end the block is at the stop all the same.
  constexpr double k = 10.0;
  for (int i = 1; i <= 24; ++i) {
    const double stopped = 0.7 * i, x = std::cos(std::sqrt(k) * stopped);
    Scene<2> scene;
    const auto block = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
    scene.add(OnCurve{block, Plane<2>{}});
    scene.add(potential(points(block), [](auto r) { return 0.5 * k * r.x() * r.x(); }));
    const auto stop = scene.add(holonomic(points(block), [x](auto r) { return r.x() - x; }), "stop");
    scene.release(stop);
    const Event<2> latch{"latch", [=](const auto& now) { return now.time() - stopped; }, Crossing::rising,
                         false, [=](Scene<2>& its) { its.impose(stop); }};
    const auto run = simulate(scene, options(stopped + 0.1), {latch});
    EXPECT_NEAR(run.position(block, 10).x(), x, 1e-13) << stopped;  // what a projection leaves
    EXPECT_NEAR(run.multiplier(stop, 10), k * x, k * 1e-13) << stopped;
    EXPECT_NEAR(run.impulse(stop, 0), std::sqrt(k) * std::sin(std::sqrt(k) * stopped),
                4.0 * error_of(run));  // of w = 3.2
  }
}

/// A block on a one-sided floor, of any restitution and smooth by Coulomb's law, swings on a spring of length
/// 1 and stiffness 20; where it turns for the third time, at x = 1.3, an oblique rod comes into force to a
/// pivot 1 below the floor, or above it.
struct TiedDown {
  static constexpr double mass = 1.0, stiffness = 20.0, start = 1.3;
  Scene<2> scene{"tied down"};
  Particle<2> block = scene.add_particle({.mass = mass, .position = {start, 0.0}}, "block");
  Constraint<1> floor = scene.add(unilateral(OnCurve{block, Plane<2>{}}, {.restitution = 0.9}), "floor");
  Constraint<1> rod;
  double turns = 6.0 * std::numbers::pi / std::sqrt(stiffness / mass);

  explicit TiedDown(double pivot) {
    scene.add(UniformGravity<2>{{0.0, -g}});
    scene.add(coulomb(floor, Slip{block, Plane<2>{}}, 0.0), "smooth");
    scene.add(Spring{Fixed<2>{}, block, stiffness, 1.0});
    rod = scene.add(Distance{Fixed<2>{{0.0, pivot}}, block, std::hypot(start, 1.0)}, "rod");
    scene.release(rod);
  }
  [[nodiscard]] Event<2> ties() const {
    return {"ties", [at = turns](const auto& now) { return now.time() - at; }, Crossing::rising, false,
            [rod = rod](Scene<2>& its) { its.impose(rod); }};
  }
};

TEST_P(Changes, JointsKeepClosedContactsClosed) {
  // The rod takes up the spring, R = k (x - 1) L/x, and the floor m g and the rod's upright part, R/L. By the
  // run's own error in x the rod misses the block then: it moves along the floor, neither off it nor into
  // it. The forces change by less than 2 k for each unit of x, which errs by 1.3 times what the run says.
  for (const double pivot : {-1.0, 1.0}) {
    const TiedDown its(pivot);
    const auto run = simulate(its.scene, options(its.turns + 0.5), {its.ties()});
    ASSERT_EQ(run.events().size(), 1U) << pivot;
    EXPECT_NEAR(run.sample_after(0).position(its.block).y(), 0.0, 1e-13);
    const double pull = its.stiffness * (its.start - 1.0) / its.start,
                 error = 2.6 * its.stiffness * error_of(run);
    for (const auto& now : {run.sample_after(0), run.sample(10)}) {
      EXPECT_NEAR(now.multiplier(its.floor), its.mass * g + pivot * pull, error) << pivot;
      EXPECT_NEAR(now.multiplier(its.rod), pull * std::hypot(its.start, 1.0), error) << pivot;
    }
  }
}

TEST_P(Changes, ImposedJointsBounceNothingThatRests) {
  // A ball slides at 2 on a floor of restitution 0.8 where a rod to a pivot 1 below comes into force, as far
  // to its side. What the floor takes up of the rod's impulse was no approach before: U- = 0, so U+ = 0, and
  // all stops. Struck down at 1 just then it leaves the floor at 0.8, and the rod turns it: Moreau's law for
  // both.
  for (const double down : {0.0, 1.0}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto ball = scene.add_particle({.mass = 1.0, .velocity = {2.0, 0.0}}, "ball");
    const auto floor = scene.add(unilateral(OnCurve{ball, Plane<2>{}}, {.restitution = 0.8}), "floor");
    const auto rod = scene.add(Distance{Fixed<2>{{0.0, -1.0}}, ball, std::sqrt(2.0)}, "rod");
    scene.release(rod);
    const Event<2> taut{
        "taut", [=](const auto& now) { return now.position(ball).x() - 1.0; }, Crossing::rising, false,
        [=](Scene<2>& its) {
          const Vec<2> here(its.initial_positions()[0], its.initial_positions()[1]);
          if (down > 0.0)
            its.replace(ball, ParticleState<2>{.mass = 1.0, .position = here, .velocity = {2.0, -down}});
          its.impose(rod);
        }};
    const auto run = simulate(scene, options(0.6), {taut});
    const double up = 0.8 * down;
    // Speeds err by a part of the scene's, which is below 3; impulses by up to 2 sqrt(2) of that.
    const double error = 3.0 * error_of(run);
    EXPECT_NEAR(run.sample_after(0).velocity(ball).x(), -up, error);
    EXPECT_NEAR(run.sample_after(0).velocity(ball).y(), up, error);
    EXPECT_NEAR(run.impulse(rod, 0), -(2.0 + up) * std::sqrt(2.0), 3.0 * error);
    EXPECT_NEAR(run.impulse(floor, 0), 2.0 + up + up + down, 3.0 * error);
  }
}

TEST_P(Changes, ImpulsesOfJointsDoNotDependOnWhatIsNotCoupled) {
  // A ball slides at 0.5 where a rod to a pivot below or above it comes into force. It is stopped between the
  // rod and the floor, or lifted along the circle, at 0.25 each way. Beside it, far away, a pendulum turns a
  // hundred times as fast.
  for (const double pivot : {-1.0, 1.0}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto ball = scene.add_particle({.mass = 1.0, .velocity = {0.5, 0.0}}, "ball");
    const auto floor = scene.add(unilateral(OnCurve{ball, Plane<2>{}}), "floor");
    const auto rod = scene.add(Distance{Fixed<2>{{0.0, pivot}}, ball, std::sqrt(2.0)}, "rod");
    scene.release(rod);
    const auto bob = scene.add_particle({.mass = 1.0, .position = {6.0, 0.0}, .velocity = {0.0, 50.0}});
    scene.add(Distance{Fixed<2>{{5.0, 0.0}}, bob, 1.0});
    const Event<2> taut{"taut", [=](const auto& now) { return now.position(ball).x() - 1.0; },
                        Crossing::rising, false, [=](Scene<2>& its) { its.impose(rod); }};
    const auto run = simulate(scene, options(2.01), {taut});
    // The ball's motion is uniform, which steps err in by roundings, and time by what times are told apart
    // to.
    const double error = std::max(1e-9, tolerance), up = pivot > 0.0 ? 0.25 : 0.0;
    EXPECT_NEAR(run.sample_after(0).velocity(ball).x(), up, error) << pivot;
    EXPECT_NEAR(run.sample_after(0).velocity(ball).y(), up, error) << pivot;
    EXPECT_NEAR(run.impulse(rod, 0), pivot > 0.0 ? -0.25 * std::sqrt(2.0) : -0.5 * std::sqrt(2.0), error);
    EXPECT_NEAR(run.impulse(floor, 0), pivot > 0.0 ? 0.0 : 0.5, error) << pivot;
  }
}

TEST_P(Changes, MovesOntoWhatIsImposedAreInTheAccuracy) {
  // A stop that comes into force half as far beside a ball as it may: the run errs by that, which a fast
  // pendulum allows and the ball, whose motion is uniform, does not show.
  Scene<2> scene;
  const auto ball = scene.add_particle({.mass = 1.0, .velocity = {0.5, 0.0}}, "ball");
  const auto bob = scene.add_particle({.mass = 1.0, .position = {6.0, 0.0}, .velocity = {0.0, 5.0}});
  scene.add(Distance{Fixed<2>{{5.0, 0.0}}, bob, 1.0});
  const auto known = simulate(scene, options(2.0)).statistics();
  const double beside = 0.5 * 12.0 * known.accuracy * known.length;
  const auto stop = scene.add(holonomic(points(ball), [=](auto r) { return r.x() - 1.0 - beside; }), "stop");
  scene.release(stop);
  const Event<2> reached{"reached", [=](const auto& now) { return now.position(ball).x() - 1.0; },
                         Crossing::rising, false, [=](Scene<2>& its) { its.impose(stop); }};
  const auto run = simulate(scene, options(2.01), {reached});
  const double error = run.statistics().accuracy * run.statistics().length;
  EXPECT_NEAR(run.position(ball, 10).x(), 1.0 + beside, 1e-12);
  EXPECT_GT(error, beside);
  EXPECT_LT(error, 2.0 * beside);
}

TEST_P(Changes, LatchesTakeOverFromTheFloor) {
  // A ball rests on a floor where a latch comes into force, above it by a hundredth of the tolerance: the
  // ball is at the latch, which bears it, and the floor is open.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto ball = scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.0}}, "ball");
  const auto floor = scene.add(unilateral(OnCurve{ball, Plane<2>{}}), "floor");
  const double above = std::max(1e-7, tolerance / 100.0);
  const auto latch = scene.add(holonomic(points(ball), [=](auto r) { return r.y() - above; }), "latch");
  scene.release(latch);
  const Event<2> taken{"taken", [=](const auto& now) { return now.position(ball).x() - 1.0; },
                       Crossing::rising, false, [=](Scene<2>& its) { its.impose(latch); }};
  if (tolerance < 1e-6) {  // such a run is right to less than that
    EXPECT_THROW((void)simulate(scene, options(2.0), {taken}), IntegrationFailure);
    return;
  }
  const auto run = simulate(scene, options(2.0), {taken});
  EXPECT_NEAR(run.position(ball, 10).y(), above, 1e-15);
  EXPECT_NEAR(run.multiplier(latch, 10), g, 1e-12);
  EXPECT_EQ(run.multiplier(floor, 10), 0.0);
}

TEST_P(Changes, ImposedJointsGiveNoEnergyToWhatIsStruck) {
  // Struck down at `down` and moving aside at u a ball meets an oblique rod and a floor that loses nothing.
  // Alone the rod would leave it an approach of (down + u)/2, less than it came with: it leaves at that,
  // along the rod's circle.
  for (const double down : {1.0, 3.0}) {
    constexpr double u = 0.2;
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto ball = scene.add_particle({.mass = 1.0, .position = {0.9, 0.0}, .velocity = {u, 0.0}}, "ball");
    const auto floor = scene.add(unilateral(OnCurve{ball, Plane<2>{}}, {.restitution = 1.0}), "floor");
    const auto rod = scene.add(Distance{Fixed<2>{{0.0, -1.0}}, ball, std::sqrt(2.0)}, "rod");
    scene.release(rod);
    const Event<2> taut{
        "taut", [](const auto& now) { return now.time() - 0.5; }, Crossing::rising, false,
        [=](Scene<2>& its) {
          its.replace(ball, ParticleState<2>{.mass = 1.0, .position = {1.0, 0.0}, .velocity = {u, -down}});
          its.impose(rod);
        }};
    const auto run = simulate(scene, options(0.55), {taut});
    const double up = 0.5 * (down + u), error = 4.0 * down * 1e-14;  // what a projection leaves
    const auto after = run.sample_after(0).velocity(ball);
    EXPECT_NEAR(after.x(), -up, error);
    EXPECT_NEAR(after.y(), up, error);
    EXPECT_NEAR(run.impulse(rod, 0), -(u + up) * std::sqrt(2.0), error);
    EXPECT_NEAR(run.impulse(floor, 0), up + down + u + up, error);
  }
}

TEST_P(Changes, ReleasedStopLetsTheBodyFall) {
  // Stopped on its way down a ball falls on, through where it was stopped.
  const Reflected its(0.0);
  const auto run = simulate(its.scene, options(1.0), {its.bounce(0.0)});
  ASSERT_EQ(run.events().size(), 1U);
  const double left = 1.0 - std::sqrt(2.0 / g);
  EXPECT_NEAR(run.position(its.ball, 10).y(), -0.5 * g * left * left, bound);
}

TEST_P(Changes, LengthOfThePathIsKeptAcrossChanges) {
  // Reflected without loss a lone ball flies as far each time: its length is that of all its way, up to the
  // last reflection and on from there, and not that of a step which would have gone through the floor.
  const Reflected its(1.0);
  const auto run = simulate(its.scene, options(20.0), {its.bounce(1.0)});
  EXPECT_NEAR(run.statistics().length, 20.0, bound);
  const auto ended = simulate(its.scene, options(20.0),
                              {{.name = "down",
                                .function = [&](const auto& now) { return now.position(its.ball).y(); },
                                .ends = true}});
  EXPECT_NEAR(ended.statistics().length, 1.0, bound);
}

TEST(Change, RefusesWhatCannotBe) {
  const Pendulum p;
  const Options options{.t_end = 1.0};
  const auto fails = [&](std::function<void(Scene<2>&)> change, const char* what) {
    EXPECT_THAT([&] { (void)simulate(p.scene, options, {p.at_the_bottom(change)}); },
                ThrowsMessage<IntegrationFailure>(HasSubstr(what)));
  };
  fails([](Scene<2>& s) { s.add_particle({.mass = 1.0}); }, "adds to the scene");
  fails([](Scene<2>&) { throw std::runtime_error("no"); }, "threw \"no\"");
  fails(
      [&](Scene<2>& s) {
        s.replace(p.rod, Distance{Fixed<2>{}, p.bob, 2.0});
      },
      "\"rod\" comes into force where");
  Scene<2> two;
  const auto block = two.add_particle({.mass = 1.0});
  two.add(nonholonomic(points(block), [](auto, auto v) { return v.x(); }));
  const auto other = two.add(nonholonomic(points(block), [](auto, auto v) { return v.x() - 1.0; }), "other");
  two.release(other);
  EXPECT_THAT(
      [&] {
        (void)simulate(two, options,
                       {{"contradiction", [](const auto& now) { return now.time() - 0.5; }, Crossing::rising,
                         false, [=](Scene<2>& s) { s.impose(other); }}});
      },
      ThrowsMessage<IntegrationFailure>(AllOf(HasSubstr("\"other\""), HasSubstr("contradicts"))));
  auto both = p.at_the_bottom([](Scene<2>&) {});
  both.ends = true;
  EXPECT_THAT([&] { (void)simulate(p.scene, options, {both}); },
              ThrowsMessage<InvalidArgument>(HasSubstr("only one of them")));
  Scene<2> scene;
  const auto ball = scene.add_particle({.mass = 1.0});
  const auto floor = scene.add(unilateral(OnCurve{ball, Plane<2>{}}), "floor");
  EXPECT_THAT([&] { scene.release(floor); }, ThrowsMessage<InvalidArgument>(HasSubstr("\"floor\"")));
}

}  // namespace
}  // namespace dalembert::changes_test
