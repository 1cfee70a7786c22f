#include <dalembert/solvers/base/numbers.h>
#include <dalembert/tests/solvers/with_events.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace dalembert::contacts_at_round_off_test {
namespace {

/// Contacts that touch, close and open at the limits of round-off.
class ContactsAtRoundOff : public WithEvents {};
INSTANTIATE_TEST_SUITE_P(Runs, ContactsAtRoundOff, at_tolerances, tolerance_name);

TEST_P(ContactsAtRoundOff, OnlyThePressedSideOfASlotPushes) {
  // A slot without play, gravity across it: the floor bears, the ceiling does nothing, from the first sample.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto ball = scene.add_particle({.mass = 1.0});
  const auto floor = scene.add(unilateral(holonomic(points(ball), [](auto r) { return r.y(); })));
  const auto ceiling = scene.add(unilateral(holonomic(points(ball), [](auto r) { return -r.y(); })));
  const auto run = simulate(scene, options(1.0));
  for (std::size_t i = 0; i < run.size(); ++i) {
    EXPECT_NEAR(run.multiplier(floor, i), g, bound);
    EXPECT_NEAR(run.multiplier(ceiling, i), 0.0, bound);
  }
}

TEST_P(ContactsAtRoundOff, OpenWhereTheirForceVanishesAmongImpacts) {
  // A force on a block fades, 1 - t, while a ball beside it bounces, at any phase: the floor lets go at 1.
  for (const double height : {0.3, 0.31, 0.32, 0.33, 0.34}) {
    Scene<2> scene;
    const auto block = scene.add_particle({.mass = 1.0}, "block");
    const auto ball = scene.add_particle({.mass = 1.0, .position = {1.0, height}}, "ball");
    scene.add(force_law(points(block),
                        [](auto t, auto, auto v) { return (0.0 * v + vec(0.0, 1.0) * (t - 1.0)).eval(); }));
    scene.add(UniformGravity<2>{{0.0, -1.0}});
    scene.add(force_law(points(block), [](auto, auto, auto v) { return (0.0 * v + vec(0.0, 1.0)).eval(); }));
    const auto floor = scene.add(unilateral(holonomic(points(block), [](auto r) { return r.y(); })), "floor");
    scene.add(unilateral(holonomic(points(ball), [](auto r) { return r.y(); }), {.restitution = 0.9}));
    const auto run = simulate(scene, options(2.0));
    std::size_t opened = 0;
    for (const EventRecord& it : run.events()) {
      if (it.kind != EventKind::opened) continue;
      ++opened;
      EXPECT_NEAR(it.time, 1.0, bound) << height;
    }
    EXPECT_EQ(opened, 1U) << height;
    EXPECT_EQ(run.multiplier(floor, 10), 0.0);
    EXPECT_NEAR(run.position(block, 10).y(), 1.0 / 6.0, bound);
  }
}

TEST_P(ContactsAtRoundOff, SlotWithoutPlayStopsWhatIsThrownAcross) {
  // To and fro in no time, slower each time; then one side bears what pulls, and it goes along the slot.
  Scene<2> scene;
  const auto ball = scene.add_particle({.mass = 1.0, .position = {0.6, -0.5}, .velocity = {-4.0, 0.5}});
  scene.add(force_law(points(ball), [](auto t, auto, auto) { return vec(3.0 + 0.0 * t, 0.0 * t); }));
  const auto right = scene.add(
                 unilateral(OnCurve{ball, Plane<2>{{0.6, -0.5}, {-0.8, -0.6}}}, {.restitution = 0.16})),
             left = scene.add(
                 unilateral(OnCurve{ball, Plane<2>{{0.6, -0.5}, {0.8, 0.6}}}, {.restitution = 0.52}));
  Options o = options(1.0);
  o.max_steps = 1000;
  const auto run = simulate(scene, o);
  const Vec<2> n(0.8, 0.6), along(-0.6, 0.8);
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i];
    // What is left of the speed across is known no better than the velocities at the start, to 1e-8.
    EXPECT_NEAR((run.position(ball, i) - Vec<2>(0.6, -0.5)).dot(n), 0.0, bound) << t;
    EXPECT_NEAR(run.velocity(ball, i).dot(along), 2.8 - 1.8 * t, bound * 4.0) << t;
    if (i == 0) continue;  // its forces are those of the first impact
    EXPECT_NEAR(run.multiplier(right, i), 2.4, bound) << t;
    EXPECT_EQ(run.multiplier(left, i), 0.0) << t;
  }
}

// It leaves a circle where cos = (2 + v^2/(g R))/3, in units of any size and far from the origin.
TEST(ContactsFarFromTheOrigin, OpenWhereTheForceVanishes) {
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    for (const double unit : {1.0, 1000.0}) {
      for (const double mass : {0.5, 1e-6}) {
        const double R = 2.0 * unit, v = 3.0 * unit;
        const Vec<2> centre{100.0 * unit, -200.0 * unit};
        Scene<2> scene;
        scene.add(UniformGravity<2>{{0.0, -g * unit}});
        const auto bead =
            scene.add_particle({.mass = mass, .position = centre + vec(0.0, R), .velocity = {v, 0.0}});
        scene.add(unilateral(OnCurve{bead, Sphere<2>{.centre = centre, .radius = R}}));
        const auto run = simulate(scene, {.t_end = 0.6, .samples = 3, .tolerance = 1e-9, .stepper = stepper});
        ASSERT_EQ(run.events().size(), 1U);
        const Vec<2> d = run.event_sample(0).position(bead) - centre;
        EXPECT_NEAR(d.y() / d.norm(), (2.0 + v * v / (g * unit * R)) / 3.0, 100.0 * 1e-9);
      }
    }
  }
}

// Two equal balls between walls 1 m apart, which lose nothing: they go on as if through each other. An impact
// may be found off its place by twice the rounding of positions, and moves each path by twice as much.
TEST(ContactsFarFromTheOrigin, CloseWithinTheRoundingOfPositions) {
  constexpr double x[2] = {0.1, 0.3}, v[2] = {1.3, -0.7};
  const auto gap = [](auto a, auto b) { return b.x() - a.x(); };
  const auto folded = [](double s) { return 1.0 - std::abs(1.0 - (s - 2.0 * std::floor(0.5 * s))); };
  for (const double X : {1e3, 1e4, 1e6}) {
    for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
      Scene<2> scene;
      std::vector<Particle<2>> balls;
      for (int i = 0; i < 2; ++i) {
        balls.push_back(
            scene.add_particle({.mass = 1.0, .position = {X + x[i], 0.0}, .velocity = {v[i], 0.0}}));
        scene.add(holonomic(points(balls.back()), [](auto r) { return r.y(); }));
      }
      scene.add(unilateral(holonomic(points(balls[0], balls[1]), gap), {.restitution = 1.0}));
      scene.add(unilateral(OnCurve{balls[0], Plane<2>{{X, 0.0}, {1.0, 0.0}}}, {.restitution = 1.0}));
      scene.add(unilateral(OnCurve{balls[1], Plane<2>{{X + 1.0, 0.0}, {-1.0, 0.0}}}, {.restitution = 1.0}));
      const auto run =
          simulate(scene, {.t_end = 20.0, .samples = 21, .tolerance = 1e-12, .stepper = stepper});
      const double error = static_cast<double>(run.events().size()) * 2.0 * 2.0 * 10.0 * epsilon * X;
      for (std::size_t k = 0; k < run.size(); ++k) {
        const auto [left, right] =
            std::minmax({folded(x[0] + v[0] * run.times()[k]), folded(x[1] + v[1] * run.times()[k])});
        EXPECT_NEAR(run.position(balls[0], k).x() - X, left, error) << X;
        EXPECT_NEAR(run.position(balls[1], k).x() - X, right, error) << X;
      }
    }
  }
}

// A block that a force F presses along a rough floor against a wall: it slides back with F + mu g, to the
// wall with F - mu g; each of its bounces is so much shorter than the last that three of them reach
// round-off.
TEST(ContactsBesideFriction, BounceDownToRoundOff) {
  constexpr double mu = 0.3, F = 3.2, start = 2.0, distance = 0.4;
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    for (const double tolerance : {1e-6, 1e-8, 1e-9, 1e-10}) {
      for (const double e : {0.01, 0.02, 0.05}) {
        Scene<2> scene;
        scene.add(UniformGravity<2>{{0.0, -g}});
        const auto block = scene.add_particle({.mass = 1.0, .velocity = {start, 0.0}});
        const auto other = scene.add_particle({.mass = 1.0, .position = {-3.0, 0.0}});
        scene.add(OnCurve{other, Plane<2>{}});
        const auto floor = scene.add(OnCurve{block, Plane<2>{}}, "floor");
        scene.add(coulomb(floor, Slip{block, Plane<2>{}}, mu));
        scene.add(unilateral(OnCurve{block, Plane<2>{{distance, 0.0}, {-1.0, 0.0}}}, {.restitution = e}));
        scene.add(force_law(points(block), [](auto r, auto) { return vec(F + 0.0 * r.x(), 0.0 * r.x()); }));
        const auto run =
            simulate(scene, {.t_end = 1.0, .samples = 3, .tolerance = tolerance, .stepper = stepper});
        EXPECT_NEAR(run.position(block, 2).x(), distance, 100.0 * tolerance);
        EXPECT_NEAR(run.velocity(block, 2).x(), 0.0, 100.0 * tolerance);
        const double a = F - mu * g, first = (std::sqrt(start * start + 2.0 * a * distance) - start) / a;
        EXPECT_NEAR(run.events().front().time, first, 100.0 * tolerance);
      }
    }
  }
}

/// A bob on a string is let go from the horizontal, in a scene that is turned: its string is neither slack
/// nor taut there but for round-off, and then carries 3 m g sin of the angle.
TEST_P(ContactsAtRoundOff, StringFromTheHorizontalIsTautAtOnce) {
  for (const double turned : {0.0, 0.4, 1.3, 2.9, 4.1}) {
    const Vec<2> down(std::sin(turned), -std::cos(turned)), across(std::cos(turned), std::sin(turned));
    Scene<2> scene;
    scene.add(UniformGravity<2>{Vec<2>(g * down)});
    const auto bob = scene.add_particle({.mass = 1.0, .position = across});
    const auto string = scene.add(unilateral(Distance{Fixed<2>{}, bob, 1.0}, {.allowed = Allowed::negative}));
    const auto run = simulate(scene, options(0.5));
    EXPECT_TRUE(run.events().empty()) << turned;
    const double sine = run.position(bob, 10).dot(down);
    EXPECT_NEAR(-run.multiplier(string, 10), 3.0 * g * sine, 10.0 * bound * g) << turned;
  }
}

/// In balance between two springs at a wall that bears nothing, and then pressed against it by t: it stays,
/// and the wall bears t.
TEST_P(ContactsAtRoundOff, WhatRestsBesideAWallIsPressedAgainstIt) {
  for (const double k : {7.0, 130.0})
    for (const double x : {0.1, 0.7, 1.1}) {
      Scene<2> scene;
      const auto block = scene.add_particle({.mass = 1.0, .position = {x, 0.0}});
      scene.add(OnCurve{block, Plane<2>{}});
      scene.add(Spring{Fixed<2>{{x - 0.3, 0.0}}, block, k, 0.2});
      scene.add(Spring{Fixed<2>{{x + 0.3, 0.0}}, block, k, 0.2});
      const auto wall = scene.add(unilateral(OnCurve{block, Plane<2>{{x, 0.0}, {-1.0, 0.0}}}));
      scene.add(force_law(points(block), [](auto t, auto, auto) { return vec(1.0 * t, 0.0 * t); }));
      const auto run = simulate(scene, options(1.0));
      EXPECT_TRUE(run.events().empty()) << k << ' ' << x;
      EXPECT_NEAR(run.multiplier(wall, 10), 1.0, bound) << k << ' ' << x;
      EXPECT_NEAR(run.position(block, 10).x(), x, bound) << k << ' ' << x;
    }
}

/// Two blocks with a relaxed spring between them hit a wall without restitution: the first stays, pressed by
/// sqrt(k m) v sin(w s), w^2 = k/m with the second's m, and leaves after half a vibration.
TEST_P(ContactsAtRoundOff, WhatIsStruckWithARelaxedSpringIsPressed) {
  constexpr double m = 2.0, l = 0.3;
  for (const bool rough : {false, true})
    for (const auto& [k, v, d] : {std::array{100.0, 0.5, 0.2},
                                  {100.0, 0.5, 0.5},
                                  {100.0, 1.0, 0.9},
                                  {300.0, 0.5, 0.5},
                                  {1000.0, 0.5, 0.2},
                                  {1000.0, 0.5, 0.5},
                                  {1000.0, 0.5, 0.9},
                                  {1000.0, 1.0, 0.5},
                                  {1000.0, 1.0, 0.9},
                                  {1000.0, 3.3, 0.9}}) {
      Scene<2> scene;
      const auto first = scene.add_particle({.mass = 1.0, .position = {-d, 0.0}, .velocity = {v, 0.0}});
      const auto second = scene.add_particle({.mass = m, .position = {-d - l, 0.0}, .velocity = {v, 0.0}});
      for (const auto& one : {first, second}) scene.add(OnCurve{one, Plane<2>{}});
      scene.add(Spring{first, second, k, l});
      scene.add(unilateral(OnCurve{first, Plane<2>{{0.0, 0.0}, {-1.0, 0.0}}}));
      if (rough) {  // a block that slides elsewhere, all the while
        scene.add(UniformGravity<2>{{0.0, -g}});
        const Plane<2> table{{0.0, -2.0}, {0.0, 1.0}};
        const auto block = scene.add_particle({.mass = 1.0, .position = {0.0, -2.0}, .velocity = {1.0, 0.0}});
        scene.add(coulomb(scene.add(OnCurve{block, table}), Slip{block, table}, 0.01));
      }
      const double w = std::sqrt(k / m), struck = d / v, opens = struck + std::numbers::pi / w;
      const auto run = simulate(scene, options(opens + 0.2));
      ASSERT_EQ(run.events().size(), 2U) << k << ' ' << v << ' ' << d;
      EXPECT_EQ(run.events()[0].kind, EventKind::struck);
      EXPECT_NEAR(run.events()[0].time, struck, error_of(run));
      EXPECT_EQ(run.events()[1].kind, EventKind::opened);
      EXPECT_NEAR(run.events()[1].time, opens, error_of(run)) << k << ' ' << v << ' ' << d;
    }
}

/// A ball of small restitution e: its hops take e^k of the first, and end at the limit of their sum, though
/// the last are shorter than a step can tell.
TEST_P(ContactsAtRoundOff, WhatHardlyBouncesComesToRest) {
  for (const double e : {0.03, 0.05, 0.1, 0.3}) {
    constexpr double h = 0.4;
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto ball = scene.add_particle({.mass = 1.0, .position = {0.3, h}});
    scene.add(unilateral(OnCurve{ball, Plane<2>{}}, {.restitution = e}));
    scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}, .velocity = {1.0, 2.0}});
    const double falls = std::sqrt(2.0 * h / g), rests = falls * (1.0 + 2.0 * e / (1.0 - e));
    const auto run = simulate(scene, options(rests + 1.0));
    ASSERT_FALSE(run.events().empty()) << e;
    EXPECT_EQ(run.events().back().kind, EventKind::rested) << e;
    // A hop that does not part from the floor, by the error of a step in a gap, lasts for its root.
    EXPECT_NEAR(run.events().back().time, rests, 10.0 * std::sqrt(tolerance)) << e;
  }
}

/// A valve that rests on its seat is lifted by its cam, at once or after a dwell: nothing but the cam moves
/// it, and the seat opens.
TEST(ContactsBesideWhatIsFast, ElasticBallNeverComesToRest) {
  // Dropped from h it strikes at odd multiples of sqrt(2 h/g). A wheel far away is so fast that such speeds
  // are nothing beside its own.
  constexpr double h = 1e-4, end = 0.1;
  const double fall = std::sqrt(2.0 * h / g);
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto ball = scene.add_particle({.mass = 1.0, .position = {0.0, h}});
    scene.add(unilateral(OnCurve{ball, Plane<2>{}}, {.restitution = 1.0}));
    scene.add_particle({.mass = 1.0, .position = {1000.0, 1.0}});
    scene.add_rotor({.inertia = 1.0, .angular_velocity = 1e4});
    const auto run = simulate(scene, {.t_end = end, .samples = 2, .tolerance = 1e-11, .stepper = stepper});
    ASSERT_EQ(run.events().size(), static_cast<std::size_t>(0.5 * (end / fall + 1.0)));
    for (const EventRecord& one : run.events()) EXPECT_EQ(one.kind, EventKind::struck);
  }
}

TEST_P(ContactsAtRoundOff, WhatIsDrivenOffItsSeatLeavesIt) {
  for (const double dwell : {0.0, 0.35}) {
    Scene<2> scene;
    const auto valve = scene.add_particle({.mass = 1.0, .position = {0.3, 0.0}});
    scene.add(Prescribed{valve, [dwell](auto t) {
                           const auto lasts = max(t - dwell, 0.0 * t);
                           return vec(0.3 + 0.0 * t, 0.1 * (1.0 - cos(2.0 * lasts)));
                         }});
    const auto seat = scene.add(unilateral(OnCurve{valve, Plane<2>{}}));
    const auto run = simulate(scene, options(1.0));
    EXPECT_NEAR(run.position(valve, 10).y(), 0.1 * (1.0 - std::cos(2.0 * (1.0 - dwell))), bound) << dwell;
    EXPECT_EQ(run.multiplier(seat, 10), 0.0) << dwell;
    EXPECT_EQ(run.events().size(), dwell > 0.0 ? 1U : 0U);
  }
}

/// Two balls on a floor collide far from the origin: the direction between them is known to the rounding of
/// positions over their distance, and presses no floor.
TEST_P(ContactsAtRoundOff, ImpactAlongAFloorFarAwayIsNoneOfTheFloor) {
  constexpr double d = 0.3, gap = 0.5, v = 2.0, e = 0.5;
  for (const double turned : {0.3, 1.1, 2.3})
    for (const double far : {0.0, 321.7, 854.2}) {
      const Vec<2> along(std::cos(turned), std::sin(turned)), up(-std::sin(turned), std::cos(turned)),
          o(far, -far);
      Scene<2> scene;
      scene.add(UniformGravity<2>{Vec<2>(-g * up)});
      const auto first = scene.add_particle({.mass = 1.0, .position = o, .velocity = Vec<2>(v * along)}),
                 second = scene.add_particle({.mass = 1.0, .position = Vec<2>(o + (d + gap) * along)});
      for (const auto& ball : {first, second}) scene.add(unilateral(OnCurve{ball, Plane<2>{o, up}}));
      scene.add(unilateral(Distance{first, second, d}, {.restitution = e}));
      auto options = this->options(2.0 * gap / v);
      options.tolerance = std::max(options.tolerance, 1e-10);  // a length is known to 1e-13 there
      const auto run = simulate(scene, options);
      ASSERT_EQ(run.events().size(), 1U) << turned << ' ' << far;
      EXPECT_EQ(run.events()[0].kind, EventKind::struck);
      EXPECT_NEAR(run.velocity(second, 10).dot(along), 0.5 * (1.0 + e) * v, 1e-8);
    }
}

/// A ball strikes one end of a rod whose other end is hinged at a point of a floor, and does not move: the
/// hinge takes the impulse, the floor none, however hard something pulls at the hinge. P (1 + 3/m) = 2 v.
/// Three roundings of the pull change the speed of the other end, which feels m/3, and an impulse by twice as
/// much.
TEST_P(ContactsAtRoundOff, ImpactOnAHingedRodIsNoneOfTheFloorAtItsHinge) {
  constexpr double L = 1.3, m = 2.5, v = 1.7, d = 0.1, gap = 0.2, t_end = 0.2, P = 2.0 * v / (1.0 + 3.0 / m);
  for (const double turned : {0.3, 1.1, 2.3, 4.0})
    for (const double pull : {0.0, 1e9}) {
      const Vec<2> along(std::cos(turned), std::sin(turned)), up(-std::sin(turned), std::cos(turned)),
          hinge(0.7, -0.4), end(hinge + L * along);
      Scene<2> scene;
      const auto rod = add_thin_rod(scene, {.mass = m, .start = hinge, .end = end}, "rod");
      const auto ball = scene.add_particle(
          {.mass = 1.0, .position = Vec<2>(end + (d + gap) * up), .velocity = Vec<2>(-v * up)});
      scene.add(Coincident{rod.start(), Fixed<2>{hinge}});
      const auto floor = scene.add(unilateral(OnCurve{rod.start(), Plane<2>{hinge, up}}));
      const auto hit = scene.add(unilateral(Distance{ball, rod.end(), d}, {.restitution = 1.0}));
      scene.add(force_law(points(rod.start()), [=](auto t, auto, auto u) {
        return (0.0 * u + vec(0.6, 0.8) * (pull * t * t)).eval();
      }));
      const auto run = simulate(scene, options(t_end));
      ASSERT_EQ(run.events().size(), 1U) << turned << ' ' << pull;
      EXPECT_EQ(run.events()[0].kind, EventKind::struck);
      const double of_pull = 6.0 * epsilon * pull * std::pow(t_end, 3) / m;
      EXPECT_NEAR(run.impulse(hit, 0), P, bound + of_pull) << turned << ' ' << pull;
      EXPECT_EQ(run.impulse(floor, 0), 0.0) << turned << ' ' << pull;
    }
}

/// A box slides on two feet; the edge in front is caught by a step, which holds the foot there. By the
/// angular momentum about the edge, m v a/2 = (2/3) m a^2 w, and the foot behind opens.
TEST_P(ContactsAtRoundOff, BoxTripsOverAStepAboutTheFootInFront) {
  constexpr double m = 10.0, way = 0.5, a = 0.37;
  for (const double v : {0.5, 1.3, 1.9, 3.7})
    for (const double turned : {0.0, 0.4, 2.3}) {
      const Vec<2> along(std::cos(turned), std::sin(turned)), up(-std::sin(turned), std::cos(turned)),
          edge(0.2, 0.9);
      Scene<2> scene;
      scene.add(UniformGravity<2>{Vec<2>(-g * up)});
      const auto box = add_body(scene,
                                {.mass = m,
                                 .inertia = m * a * a / 6.0,
                                 .centre = Vec<2>(edge - (way + 0.5 * a) * along + 0.5 * a * up),
                                 .angle = turned,
                                 .velocity = Vec<2>(v * along)},
                                "box");
      const auto behind = box.point({-0.5 * a, -0.5 * a}), before = box.point({0.5 * a, -0.5 * a});
      const auto rear = scene.add(unilateral(OnCurve{behind, Plane<2>{edge, up}})),
                 front = scene.add(unilateral(OnCurve{before, Plane<2>{edge, up}}));
      const auto step = scene.add(Coincident{before, Fixed<2>{edge}}, "step");
      scene.release(step);
      const std::vector<Event<2>> events{
          {.name = "hits",
           .function = [=](const auto& now) { return (now.position(before) - edge).dot(along); },
           .crossing = Crossing::rising,
           .change = [=](Scene<2>& changed) { changed.impose(step); }}};
      const auto run = simulate(scene, options(way / v + 0.02), events);
      ASSERT_EQ(run.events().size(), 2U) << v << ' ' << turned;  // the step, and the foot
      for (const std::size_t k : {0U, 1U}) EXPECT_EQ(run.impulse(front, k), 0.0) << v << ' ' << turned;
      EXPECT_NE(run.name_of(run.events()[0]), run.name_of(run.events()[1]));
      EXPECT_EQ(run.multiplier(rear, run.size() - 1), 0.0) << v << ' ' << turned;
      EXPECT_NEAR(angular_velocity(run.sample_after(1), box), -3.0 * v / (4.0 * a), bound * v / a) << v;
    }
}

}  // namespace
}  // namespace dalembert::contacts_at_round_off_test
