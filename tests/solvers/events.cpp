#include <dalembert/solvers/base/root.h>
#include <dalembert/tests/solvers/with_events.h>

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/special_functions/ellint_1.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace dalembert::events_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class Events : public WithEvents {};
INSTANTIATE_TEST_SUITE_P(Runs, Events, at_tolerances, tolerance_name);

/// A pendulum of length 1, from rest at an angle from the downward vertical.
struct Pendulum {
  Scene<2> scene{"pendulum"};
  Particle<2> bob;
  Constraint<1> rod;

  explicit Pendulum(double angle, double rate = 0.0) {
    const Vec<2> along(std::sin(angle), -std::cos(angle)), across(std::cos(angle), std::sin(angle));
    scene.add(UniformGravity<2>{{0.0, -g}});
    bob = scene.add_particle({.mass = 1.0, .position = along, .velocity = rate * across}, "bob");
    rod = scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");
  }
};

TEST(Root, IsFoundOfSmoothFunctionsAndOfJumps) {
  int calls = 0;
  const auto f = [&calls](double x) { return ++calls, std::cos(x) - x; };
  EXPECT_NEAR(root(f, 0.0, f(0.0), 1.0, f(1.0), 1e-15), 0.7390851332151607, 2e-15);
  EXPECT_LT(calls, 20);
  const auto jump = [](double x) { return x < 0.3 ? -1.0 : 1e6; };
  EXPECT_NEAR(root(jump, 0.0, -1.0, 1.0, 1e6, 1e-12), 0.3, 1e-12);
  EXPECT_EQ(root([](double x) { return x; }, -1.0, -1.0, 0.0, 0.0, 1e-15), 0.0);
}

TEST_P(Events, AllEventsAreFoundInTheOrderOfTime) {
  // A pendulum of amplitude 1 passes the lowest point at odd quarters of its period 4 K(sin(1/2))/omega0, and
  // rests at even ones.
  const Pendulum pendulum(1.0);
  const double quarter = boost::math::ellint_1(std::sin(0.5)) / std::sqrt(g);
  const auto run =
      simulate(pendulum.scene, options(5.0),
               {{"lowest", [bob = pendulum.bob](const auto& now) { return now.position(bob).x(); }},
                {"turns back", [bob = pendulum.bob](const auto& now) { return now.velocity(bob).x(); },
                 Crossing::rising}});
  ASSERT_GE(run.events().size(), 7U);
  std::size_t k = 0;
  for (int n = 1; n * quarter < 5.0; ++n) {
    if (n % 4 == 0) continue;  // there it turns back the other way
    ASSERT_LT(k, run.events().size());
    EXPECT_EQ(run.events()[k].source, n % 2 == 0 ? 1U : 0U);
    EXPECT_EQ(run.name_of(run.events()[k]), n % 2 == 0 ? "turns back" : "lowest");
    EXPECT_NEAR(run.events()[k].time, n * quarter, bound);
    if (n % 2 == 1) {
      EXPECT_NEAR(-run.event_sample(k).multiplier(pendulum.rod), g * (3.0 - 2.0 * std::cos(1.0)), bound * g);
    }
    ++k;
  }
  EXPECT_EQ(k, run.events().size());
  EXPECT_EQ(run.size(), 11U);
}

TEST_P(Events, EndARunWhereAForceOfConstraintVanishes) {
  // A particle slides off a sphere of radius 1 from the angle 0.1 off its top, at rest: it leaves at
  // cos theta = (2/3) cos 0.1, after int dtheta/sqrt(2 g (cos 0.1 - cos theta)). With theta = 0.1 + u^2 the
  // integrand is regular.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto particle = scene.add_particle({.mass = 1.0, .position = {std::sin(0.1), std::cos(0.1)}});
  const auto sphere = scene.add(OnSurface{particle, Sphere<2>{.radius = 1.0}});
  const auto run = simulate(
      scene, options(10.0),
      {{"leaves", [=](const auto& now) { return now.multiplier(sphere); }, Crossing::falling, true}});
  ASSERT_EQ(run.events().size(), 1U);
  const double leaves = std::acos(2.0 / 3.0 * std::cos(0.1));
  boost::math::quadrature::tanh_sinh<double> integrator;
  const double time = integrator.integrate(
      [](double u) {
        // cos 0.1 - cos(0.1 + u^2) = 2 sin(0.1 + u^2/2) sin(u^2/2)
        const double fall = 2.0 * std::sin(0.1 + u * u / 2.0) * std::sin(u * u / 2.0);
        return u < 1e-8 ? 2.0 / std::sqrt(2.0 * g * std::sin(0.1)) : 2.0 * u / std::sqrt(2.0 * g * fall);
      },
      0.0, std::sqrt(leaves - 0.1));
  EXPECT_NEAR(run.events()[0].time, time, bound);
  const auto last = run.sample(run.size() - 1);
  EXPECT_EQ(last.time(), run.events()[0].time);
  EXPECT_NEAR(last.position(particle).y(), std::cos(leaves), bound);
  EXPECT_NEAR(last.multiplier(sphere), 0.0, bound * g);
  EXPECT_EQ(run.size(), 2U);  // that at the start, and the last
}

TEST_P(Events, BothRootsWithinAStepAreFound) {
  // Free flight, y = t - t^2/2: a height just below the top is passed twice within 2 e, whatever the steps.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -1.0}});
  const auto ball = scene.add_particle({.mass = 1.0, .velocity = {0.3, 1.0}});
  for (const double e : {1e-1, 1e-2, 1e-3}) {
    const auto run =
        simulate(scene, options(2.0),
                 {{"height", [=](const auto& now) { return now.position(ball).y() - 0.5 * (1.0 - e * e); }}});
    ASSERT_EQ(run.events().size(), 2U) << e;
    // The height is known to the tolerance, the time to that over the speed e.
    EXPECT_NEAR(run.events()[0].time, 1.0 - e, bound / e);
    EXPECT_NEAR(run.events()[1].time, 1.0 + e, bound / e);
  }
}

TEST_P(Events, DirectionOfACrossingDecides) {
  const Pendulum pendulum(1.0);
  const auto times = [&](Crossing crossing) {
    const auto run = simulate(
        pendulum.scene, options(4.0),
        {{"lowest", [bob = pendulum.bob](const auto& now) { return now.position(bob).x(); }, crossing}});
    std::vector<double> all;
    for (const EventRecord& one : run.events()) all.push_back(one.time);
    return all;
  };
  const auto either = times(Crossing::either), rising = times(Crossing::rising),
             falling = times(Crossing::falling);
  ASSERT_EQ(either.size(), rising.size() + falling.size());
  EXPECT_EQ(either[0], falling[0]);
  EXPECT_EQ(either[1], rising[0]);
}

TEST_P(Events, FunctionThatBeginsOrStaysAtZeroHasNoEvent) {
  const Pendulum pendulum(1.0);
  const auto run =
      simulate(pendulum.scene, options(0.3),
               {{"at rest", [bob = pendulum.bob](const auto& now) { return now.velocity(bob).norm(); }},
                {"constant", [](const auto& /*now*/) { return 0.0; }}});
  EXPECT_TRUE(run.events().empty());
}

TEST_P(Events, ChangeNothingOfTheMotion) {
  const Pendulum pendulum(1.0);
  const auto plain = simulate(pendulum.scene, options(3.0));
  const auto watched =
      simulate(pendulum.scene, options(3.0),
               {{"lowest", [bob = pendulum.bob](const auto& now) { return now.position(bob).x(); }}});
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_EQ(plain.position(pendulum.bob, i), watched.position(pendulum.bob, i));
    EXPECT_EQ(plain.multiplier(pendulum.rod, i), watched.multiplier(pendulum.rod, i));
  }
  EXPECT_EQ(plain.statistics().steps, watched.statistics().steps);
}

/// From 1 m it strikes at sqrt(2/g); which samples are asked for changes nothing of that.
TEST_P(Events, AreThoseOfTheWholeRunWhereverItsSamplesEnd) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto ball = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}});
  scene.add(unilateral(OnCurve{ball, Plane<2>{}}, {.restitution = 0.5}));
  const std::vector<Event<2>> end{
      {"end", [](const Sample<2>& now) { return now.time() - 0.9; }, Crossing::rising, true}};
  Options options{.t_end = 1.0, .tolerance = GetParam().tolerance, .stepper = GetParam().stepper};
  const auto all = simulate(scene, options, end);
  ASSERT_EQ(all.events().size(), 2U);
  options.times = {0.1, 0.2};
  const auto few = simulate(scene, options, end);
  options.times.clear();
  options.sample_interval = 0.7;
  const auto wide = simulate(scene, options, end);
  for (const auto* run : {&few, &wide}) {
    ASSERT_EQ(run->events().size(), 2U);
    for (const std::size_t i : {0U, 1U}) EXPECT_NEAR(run->events()[i].time, all.events()[i].time, bound);
    EXPECT_EQ(run->times().back(), run->events()[1].time);
  }
}

TEST_P(Events, EndStepsOfASimulationAsWell) {
  const Pendulum pendulum(1.0);
  Simulation<2> simulation(
      pendulum.scene, options(5.0),
      {{"lowest", [bob = pendulum.bob](const auto& now) { return now.position(bob).x(); }, Crossing::either,
        true}});
  simulation.advance_to(5.0);
  const double quarter = boost::math::ellint_1(std::sin(0.5)) / std::sqrt(g);
  EXPECT_NEAR(simulation.time(), quarter, bound);
  ASSERT_EQ(simulation.events().size(), 1U);
  EXPECT_THAT([&] { simulation.advance_to(5.0); },
              ThrowsMessage<InvalidArgument>(HasSubstr("ended the run")));
  EXPECT_THAT([&] { simulation.step(); }, ThrowsMessage<InvalidArgument>(HasSubstr("ended the run")));
}

TEST_P(Events, FailingEventStopsTheRunByName) {
  const Pendulum pendulum(1.0);
  const auto bad = [&](auto function) {
    return [&, function] { (void)simulate(pendulum.scene, options(1.0), {Event<2>{"slack", function}}); };
  };
  EXPECT_THAT(
      bad([](const auto& now) { return now.time() < 0.5 ? 1.0 : std::nan(""); }),
      ThrowsMessage<IntegrationFailure>(AllOf(HasSubstr("Event \"slack\""), HasSubstr("no finite number"))));
  EXPECT_THAT(bad([](const auto& now) -> double {
                if (now.time() > 0.5) throw std::runtime_error("no idea");
                return 1.0;
              }),
              ThrowsMessage<IntegrationFailure>(AllOf(HasSubstr("Event \"slack\""), HasSubstr("no idea"))));
  EXPECT_THAT(bad(std::function<double(const Sample<2>&)>()),
              ThrowsMessage<InvalidArgument>(AllOf(HasSubstr("\"slack\""), HasSubstr("no function"))));
}

TEST_P(Events, EventsBeforeAFailureAreKept) {
  const Pendulum pendulum(1.0);
  try {
    (void)simulate(pendulum.scene, options(3.0),
                   {{"lowest", [bob = pendulum.bob](const auto& now) { return now.position(bob).x(); }},
                    {"fails", [](const auto& now) { return now.time() < 2.0 ? 1.0 : std::nan(""); }}});
    FAIL();
  } catch (const IntegrationFailure& failure) {
    const auto kept = failure.trajectory<2>();
    EXPECT_FALSE(kept.events().empty());
  }
}

// A stone on a slack string, of length 1, that is thrown along x = 0.6: it goes taut at (0.6, 0.8), which
// takes its speed along the string, 4 * 0.8. The rest, 2.4, loads the string at once with 2.4^2.
TEST_P(Events, CrossZeroWhereTheirFunctionJumps) {
  Scene<2> scene;
  const auto stone = scene.add_particle({.mass = 1.0, .position = {0.6, -0.5}, .velocity = {0.0, 4.0}});
  const auto string =
      scene.add(unilateral(Distance{Fixed<2>{}, stone, 1.0}, {.allowed = Allowed::negative}), "string");
  const auto tension = [=](const Sample<2>& now) { return -now.multiplier(string) - 5.0; };
  const auto noted = simulate(scene, options(0.5), {{.name = "load", .function = tension}});
  ASSERT_EQ(noted.events().size(), 2U);
  EXPECT_EQ(noted.events()[1].kind, EventKind::event);
  EXPECT_NEAR(noted.events()[1].time, 1.3 / 4.0, bound);
  const auto ended = simulate(scene, options(0.5), {{.name = "load", .function = tension, .ends = true}});
  EXPECT_EQ(ended.times().back(), noted.events()[1].time);
  EXPECT_NEAR(-ended.multiplier(string, ended.size() - 1), 2.4 * 2.4, 10.0 * bound);
}

// Two blocks couple where they come as close as a rod is long: the event's function is 0 from there on.
TEST_P(Events, ChangeThatHoldsTheFunctionAtZeroHappensOnce) {
  for (const double angle : {0.0, 0.2, 0.6}) {
    const double c = std::cos(angle), s = std::sin(angle), offset = 3.0;
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -g}});
    const Plane<2> plane{{offset, offset}, {s, c}};
    const auto a =
        scene.add_particle({.mass = 1.0, .position = {offset, offset}, .velocity = {3.0 * c, -3.0 * s}});
    const auto b =
        scene.add_particle({.mass = 2.0, .position = {offset + c, offset - s}, .velocity = {c, -s}});
    scene.add(OnCurve{a, plane});
    scene.add(OnCurve{b, plane});
    const auto hook = scene.add(Distance{a, b, 0.25}, "hook");
    scene.release(hook);
    const Event<2> couple{
        .name = "couple",
        .function = [=](const Sample<2>& now) { return (now.position(b) - now.position(a)).norm() - 0.25; },
        .change = [=](Scene<2>& changed) { changed.impose(hook); }};
    const auto run = simulate(scene, options(1.0), {couple});
    ASSERT_EQ(run.events().size(), 1U) << angle;
    EXPECT_NEAR(run.events()[0].time, 0.75 / 2.0, bound);
    EXPECT_NEAR((run.velocity(a, run.size() - 1) - run.velocity(b, run.size() - 1)).norm(), 0.0, bound);
  }
}

/// |r| - 1 is round-off while the rod holds, at the start as well: "taut" waits for the flight between.
TEST_P(Events, StringOfARodIsTautOnlyAfterItWasSlack) {
  for (const double offset : {0.0, 3.0}) {
    const Vec<2> centre{offset, -offset / 3.0};
    Scene<2> by_events, string;
    Particle<2> bob;
    for (Scene<2>* scene : {&string, &by_events}) {
      scene->add(UniformGravity<2>{{0.0, -9.81}});
      bob = scene->add_particle({.mass = 2.0, .position = centre - Vec<2>::Unit(1), .velocity = {5.6, 0.0}},
                                "bob");
    }
    string.add(
        unilateral(Distance{Fixed<2>{centre}, string.particle("bob"), 1.0}, {.allowed = Allowed::negative}));
    bob = by_events.particle("bob");
    const auto rod = by_events.add(Distance{Fixed<2>{centre}, bob, 1.0}, "rod");
    const std::vector<Event<2>> events{
        {.name = "slack",
         .function = [=](const Sample<2>& now) { return now.multiplier(rod); },
         .change = [=](Scene<2>& scene) { scene.release(rod); }},
        {.name = "taut",
         .function = [=](const Sample<2>& now) { return (now.position(bob) - centre).norm() - 1.0; },
         .change = [=](Scene<2>& scene) { scene.impose(rod); }}};
    const auto right = simulate(string, options(1.5)), run = simulate(by_events, options(1.5), events);
    ASSERT_EQ(run.events().size(), right.events().size()) << offset;
    for (std::size_t k = 0; k < run.events().size(); ++k)
      EXPECT_NEAR(run.events()[k].time, right.events()[k].time, bound) << offset;
  }
}

/// Nothing moves; a load of 5 N comes and goes within one step.
TEST_P(Events, ForceThatJumpsWhereNothingMovesCrosses) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -10.0}});
  const auto weight = scene.add_particle({.mass = 1.0, .position = {0.0, -1.0}}, "weight");
  const auto rod = scene.add(Distance{Fixed<2>{}, weight, 1.0}, "rod");
  scene.add(force_law(points(weight), [](auto t, auto, auto) {
    return vec(0.0 * t, t > 2.0 && t < 2.3 ? -5.0 + 0.0 * t : 0.0 * t);
  }));
  const Event<2> tension{.name = "tension",
                         .function = [=](const Sample<2>& now) { return -now.multiplier(rod) - 12.0; },
                         .crossing = Crossing::either};
  const auto run = simulate(scene, options(5.0), {tension});
  ASSERT_EQ(run.events().size(), 2U);
  EXPECT_NEAR(run.events()[0].time, 2.0, bound);
  EXPECT_NEAR(run.events()[1].time, 2.3, bound);
}

/// Constraints keep these functions 0 from the start, at 0 coordinates and multipliers as well: no event, at
/// whatever time round-off takes a sign.
TEST_P(Events, WhatConstraintsKeepAt0DoesNotCross) {
  const auto expect_none = [&](const Scene<2>& scene,
                               const std::function<double(const Sample<2>&)>& function) {
    const auto run = simulate(scene, options(3.0), {{.name = "never", .function = function, .ends = true}});
    EXPECT_TRUE(run.events().empty());
    EXPECT_EQ(run.times().back(), 3.0);
  };
  {
    Scene<2> circle;
    const auto bead = circle.add_particle({.mass = 1.0, .position = {1.0, 0.0}, .velocity = {0.0, 1.0}});
    circle.add(Distance{Fixed<2>{}, bead, 1.0});
    expect_none(circle, [=](const Sample<2>& now) { return now.position(bead).dot(now.velocity(bead)); });
  }
  {
    Scene<2> gear;
    gear.add_particle({.mass = 1.0});
    const auto a = gear.add_rotor({.inertia = 1.0}), b = gear.add_rotor({.inertia = 0.3});
    gear.add(holonomic(points(a, b), [](auto x, auto y) { return 3.0 * x[0] - y[0]; }));
    gear.add(Torque{a, 0.4});
    expect_none(
        gear, [=](const Sample<2>& now) { return 3.0 * now.angular_velocity(a) - now.angular_velocity(b); });
  }
  for (const double speed : {0.0, 1.0}) {
    Scene<2> line;
    const auto bead = line.add_particle({.mass = 1.0, .velocity = {0.8 * speed, 0.6 * speed}});
    line.add(OnCurve{bead, Plane<2>{{0.0, 0.0}, {-0.6, 0.8}}});
    line.add(UniformGravity<2>{{0.0, -9.81}});
    expect_none(line, [=](const Sample<2>& now) {
      return -0.6 * now.velocity(bead).x() + 0.8 * now.velocity(bead).y();
    });
  }
  {
    Scene<2> unloaded;
    const auto bead = unloaded.add_particle({.mass = 1.0, .velocity = {0.8, 0.6}});
    const auto line = unloaded.add(OnCurve{bead, Plane<2>{{0.0, 0.0}, {-0.6, 0.8}}});
    unloaded.add(LinearDrag{bead, 0.3});
    expect_none(unloaded, [=](const Sample<2>& now) { return now.multiplier(line); });
  }
}

// What rests is read off with round-off of its forces; beside it something moves.
TEST_P(Events, WhatIsAtRestDoesNotCross) {
  const auto expect_none = [&](Scene<2>& scene, const std::function<double(const Sample<2>&)>& function) {
    scene.add_particle({.mass = 1.0, .position = {9.0, 0.0}, .velocity = {0.0, 30.0}});
    const auto run = simulate(scene, options(2.0), {{.name = "never", .function = function, .ends = true}});
    EXPECT_TRUE(run.events().empty());
    EXPECT_EQ(run.times().back(), 2.0);
  };
  const Vec<2> place(0.3, -0.4);
  {
    Scene<2> scene("two rods");
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto bob = scene.add_particle({.mass = 1.0, .position = place});
    scene.add(Distance{Fixed<2>{}, bob, 0.5});
    scene.add(Distance{Fixed<2>{{1.0, 0.0}}, bob, std::hypot(0.7, 0.4)});
    expect_none(scene, [=](const Sample<2>& now) { return now.velocity(bob).x(); });
  }
  {
    Scene<2> scene("block");
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto block =
        add_body(scene, BodyState<2>{.mass = 2.0, .inertia = 0.3, .centre = {0.1, 0.7}}, "block");
    for (const double x : {-0.33, 0.47}) scene.add(unilateral(OnCurve{block.point({x, -0.7}), Plane<2>{}}));
    const auto centre = block.centre();
    expect_none(scene, [=](const Sample<2>& now) { return now.velocity(centre).y(); });
  }
  {
    Scene<2> scene("springs in balance, on a rail that carries nothing");
    const double k = 7.3, other = 3.1;
    const auto bead = scene.add_particle({.mass = 1.0, .position = place});
    scene.add(Spring{Fixed<2>{}, bead, k});
    scene.add(Spring{Fixed<2>{place + (k / other) * place}, bead, other});
    const auto rail = scene.add(OnCurve{bead, Plane<2>{place, {0.6, 0.8}}});
    expect_none(scene, [=](const Sample<2>& now) { return now.multiplier(rail); });
  }
  {  // y = x^2/2, from its lowest point
    Scene<2> scene("parabola");
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto bead = scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.0}});
    scene.add(holonomic(points(bead), [](auto r) { return r.y() - 0.5 * r.x() * r.x(); }));
    expect_none(scene, [=](const Sample<2>& now) {
      const Vec<2> r = now.position(bead);
      return r.y() - 0.5 * r.x() * r.x();
    });
  }
}

// The arc cosine of 1 less a rounding is 1e-8: the square root of its round-off. It is no jump.
TEST_P(Events, AngleOfWeldedBodiesDoesNotCross) {
  Scene<2> scene("welded");
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto body = [&](const Vec<2>& at, const char* its) {
    return add_body(scene, BodyState<2>{.mass = 1.0, .inertia = 0.1, .centre = at}, its);
  };
  const auto upper = body({0.6, -0.8}, "upper"), lower = body({1.2, -1.6}, "lower");
  scene.add(Revolute{Ground<2>{}, upper, Vec<2>(0.0, 0.0)});
  scene.add(Weld{upper, lower, Vec<2>(0.9, -1.2)});
  const auto a = upper.vector({0.6, 0.8}), b = lower.vector({0.6, 0.8});
  const Event<2> folds{.name = "folds",
                       .function =
                           [=](const Sample<2>& now) {
                             const Vec<2> u = now.position(a), w = now.position(b);
                             return std::acos(std::clamp(u.dot(w) / (u.norm() * w.norm()), -1.0, 1.0));
                           },
                       .ends = true};
  const auto run = simulate(scene, options(3.0), {folds});
  EXPECT_EQ(run.times().back(), 3.0);
}

// What starts at 0 and leaves it, however large or fast what is not coupled to it may be.
TEST_P(Events, WhatStartsAt0CrossesLater) {
  for (const double fast : {1.0, 1e3, 1e6}) {
    for (const double A : {1.0, 1e-3}) {
      Scene<2> scene;
      const auto swings = scene.add_particle({.mass = 1.0, .position = {A, 0.0}});
      scene.add(OnCurve{swings, Plane<2>{}});
      scene.add(potential(points(swings), [](auto r) { return 0.5 * r.x() * r.x(); }));
      scene.add_particle({.mass = 1.0, .position = {0.0, 2.0}, .velocity = {fast, 0.0}});
      const auto run = simulate(
          scene, options(4.0),
          {{.name = "turns", .function = [=](const Sample<2>& now) { return now.velocity(swings).x(); }}});
      ASSERT_EQ(run.events().size(), 1U) << fast << ' ' << A;
      // The whole scene's speed is what velocities are known to.
      const double error = 12.0 * run.statistics().accuracy * std::max(fast, run.statistics().length) / A;
      EXPECT_NEAR(run.events()[0].time, std::numbers::pi, std::max(1e-9, error)) << fast << ' ' << A;
    }
  }
}

// A load hangs from a drum that pays out faster and faster, -3 t: l (1/m + 1/I) = g - 3 t/I, which is 0 at
// g/6. Its height is round-off, which says nothing of how large forces are.
TEST_P(Events, RopeFromADrumGoesSlack) {
  for (const double height : {0.0, 0.1 + 0.2 - 0.3}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto load = scene.add_particle({.mass = 1.0, .position = {0.0, height}});
    scene.add(OnCurve{load, Plane<2>{{0.0, 0.0}, {1.0, 0.0}}});
    const auto drum = scene.add_rotor({.inertia = 0.5}, "drum");
    const auto rope = scene.add(
        holonomic(points(load, drum), [=](auto r, auto angle) { return r.y() - height + 1.0 * angle[0]; }));
    scene.add(
        force_law(points(drum), [](auto t, auto angle, auto) { return vec(3.0 * t + 0.0 * angle[0]); }));
    const auto run = simulate(scene, options(3.0),
                              {{.name = "slack",
                                .function = [=](const Sample<2>& now) { return now.multiplier(rope); },
                                .ends = true}});
    EXPECT_NEAR(run.times().back(), g / 6.0, 10.0 * bound);
  }
}

// A steep term beside a jump is not its round-off: k x + sign(v) from rest, x = 3 (cos t - cos(w t))/(k - 1).
TEST_P(Events, JumpBesideASteepTermCrosses) {
  constexpr double k = 1e6;
  Scene<2> scene;
  const auto bead = scene.add_particle({.mass = 1.0});
  scene.add(OnCurve{bead, Plane<2>{}});
  scene.add(force_law(points(bead), [](auto t, auto r, auto v) {
    return vec(3.0 * cos(t) - k * r.x() - 2e4 * v.x(), 0.0 * r.x());
  }));
  const auto function = [=](const Sample<2>& now) {
    return k * now.position(bead).x() + (now.velocity(bead).x() > 0.0 ? 1.0 : -1.0);
  };
  const auto run = simulate(scene, options(6.0), {{.name = "crosses", .function = function}});
  EXPECT_GE(run.events().size(), 2U);
}

// A jump is no term of a sum, whose rounding might be all that the function is. The seat of a swing moves
// down at 45 degrees where it hangs at 45.
TEST_P(Events, FunctionThatJumpsAtTheStartCrossesLater) {
  Scene<2> thrown;
  const auto stone = thrown.add_particle({.mass = 1.0});
  thrown.add(UniformGravity<2>{{0.0, -g}});
  thrown.add(unilateral(OnCurve{stone, Plane<2>{{0.0, -1.0}, {0.0, 1.0}}}, {.restitution = 0.5}));
  const auto up = [=](const Sample<2>& now) { return now.velocity(stone).y() > 0.0 ? 1.0 : -1.0; };
  const auto run = simulate(thrown, options(1.0),
                            {{.name = "up", .function = up, .crossing = Crossing::rising, .ends = true}});
  EXPECT_NEAR(run.times().back(), std::sqrt(2.0 / g), bound);

  Scene<2> swing;
  const auto seat = swing.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  swing.add(Distance{Fixed<2>{}, seat, 1.0});
  swing.add(UniformGravity<2>{{0.0, -g}});
  const auto slope = [=](const Sample<2>& now) {
    return std::atan2(now.velocity(seat).y(), now.velocity(seat).x()) + 0.75 * std::numbers::pi;
  };
  const auto stopped = simulate(swing, options(2.0), {{.name = "slope", .function = slope, .ends = true}});
  EXPECT_NEAR(stopped.position(seat, stopped.size() - 1).x(), std::sqrt(0.5), 10.0 * bound);
}

}  // namespace
}  // namespace dalembert::events_test
