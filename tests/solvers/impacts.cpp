#include <dalembert/tests/solvers/with_events.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace dalembert::impacts_test {
namespace {

class Impacts : public WithEvents {};
INSTANTIATE_TEST_SUITE_P(Runs, Impacts, at_tolerances, tolerance_name);

/// A ball of mass 2 that falls from a height of 1, going sideways.
struct Ball {
  Scene<2> scene{"ball"};
  Particle<2> ball;
  Constraint<1> floor;
  double first = std::sqrt(2.0 / g);  // impact

  explicit Ball(double restitution) {
    scene.add(UniformGravity<2>{{0.0, -g}});
    ball = scene.add_particle({.mass = 2.0, .position = {0.0, 1.0}, .velocity = {0.3, 0.0}}, "ball");
    floor = scene.add(
        unilateral(holonomic(points(ball), [](auto r) { return r.y(); }), {.restitution = restitution}),
        "floor");
  }
};

TEST_P(Impacts, BouncingBallHasTheTimesAndImpulsesOfTheClosedForm) {
  // It strikes with u_k = e^k sqrt(2 g h), u_0 after sqrt(2 h/g), and flies for 2 e u_k/g; P = m (1 + e) u_k.
  constexpr double e = 0.9;
  const Ball scene(e);
  const auto run = simulate(scene.scene, options(5.0));
  ASSERT_EQ(run.events().size(), 8U);
  double time = scene.first, u = g * time;
  for (std::size_t k = 0; k < run.events().size(); ++k) {
    EXPECT_EQ(run.events()[k].kind, EventKind::struck);
    EXPECT_EQ(run.events()[k].source, static_cast<std::size_t>(scene.floor.index));
    EXPECT_NEAR(run.events()[k].time, time, bound);
    EXPECT_NEAR(run.event_sample(k).velocity(scene.ball).y(), -u, bound);
    EXPECT_NEAR(run.sample_after(k).velocity(scene.ball).y(), e * u, bound);
    EXPECT_NEAR(run.impulse(scene.floor, k), 2.0 * (1.0 + e) * u, bound);
    u *= e;
    time += 2.0 * u / g;
  }
  EXPECT_NEAR(run.position(scene.ball, 10).x(), 0.3 * 5.0, bound);
  EXPECT_EQ(run.multiplier(scene.floor, 10), 0.0);
}

TEST_P(Impacts, AccumulatingImpactsEndInRestAtTheirLimit) {
  // The flights are a geometric series: sqrt(2 h/g) (1 + e)/(1 - e).
  for (const double e : {0.3, 0.5, 0.8}) {
    const Ball scene(e);
    const double limit = scene.first * (1.0 + e) / (1.0 - e);
    const auto run = simulate(scene.scene, options(limit + 1.0));
    const EventRecord& last = run.events().back();
    EXPECT_EQ(last.kind, EventKind::rested) << e;
    EXPECT_NEAR(last.time, limit, bound * limit) << e;
    EXPECT_NEAR(run.multiplier(scene.floor, 10), 2.0 * g, bound) << e;
    EXPECT_NEAR(run.position(scene.ball, 10).y(), 0.0, tolerance) << e;
    EXPECT_NEAR(run.position(scene.ball, 10).x(), 0.3 * (limit + 1.0), bound * limit) << e;
  }
}

/// Where a ball is between impacts, and what follows.
struct Hop {
  double t, y, v;  // upwards

  /// After its next impact, the ball pulled down by G.
  [[nodiscard]] Hop next(double G, double e) const {
    const double u = std::sqrt(v * v + 2.0 * G * y);
    return {t + (v + u) / G, 0.0, e * u};
  }
  /// From an impact on.
  [[nodiscard]] Hop at(double time, double G) const {
    const double s = time - t;
    return {time, v * s - 0.5 * G * s * s, v - G * s};
  }
  [[nodiscard]] double rest(double G, double e) const {
    const Hop first = next(G, e);
    return first.t + 2.0 * first.v / (G * (1.0 - e));
  }
};

/// How well impacts tell the time of rest, where each is known to the tolerance: its derivatives by the last
/// four of them, where D_k/D_(k-1) = e, see Accumulation.
double error_of_rest(double e) {
  const double lost = 1.0 - e;
  return tolerance * (1.0 + 2.0 * e / lost + 2.0 * e * (1.0 + e) / (lost * lost * lost));
}

TEST_P(Impacts, RestIsTheLimitUnderTheForcesThatItEndsIn) {
  // Before they change the impacts tend to another limit, at 4.06.
  constexpr double e = 0.8, change = 3.0, less = 0.2, G = 20.0 * g;
  Hop hop = Hop{0.0, 1.0, 0.0}.next(g, e);
  while (hop.next(g, e).t < change) hop = hop.next(g, e);
  hop = hop.at(change, g);
  const auto rest_of = [](const Trajectory<2>& run) {
    EXPECT_EQ(run.events().back().kind, EventKind::rested);
    return run.events().back().time;
  };
  Ball pressed(e);
  pressed.scene.add(force_law(points(pressed.ball), [](auto t, auto r, auto) {
    return vec(0.0 * r.x(), t > 3.0 ? 0.0 * r.y() - 2.0 * 19.0 * g : 0.0 * r.y());
  }));
  EXPECT_NEAR(rest_of(simulate(pressed.scene, options(5.0))), hop.rest(G, e), error_of_rest(e));

  Scene<2> soft;
  soft.add(UniformGravity<2>{{0.0, -g}});
  const auto ball = soft.add_particle({.mass = 2.0, .position = {0.0, 1.0}});
  const auto plate = soft.add(unilateral(OnCurve{ball, Plane<2>{}}, {.restitution = e}));
  const Event<2> soften{"soften", [](const auto& now) { return now.time() - 3.0; }, Crossing::rising, false,
                        [=](Scene<2>& s) {
                          s.replace(plate, unilateral(OnCurve{ball, Plane<2>{}}, {.restitution = less}));
                        }};
  EXPECT_NEAR(rest_of(simulate(soft, options(5.0), {soften})), hop.rest(g, less), error_of_rest(e));
}

TEST_P(Impacts, RestAfterALiftIsTheLimitOfTheImpactsBehindIt) {
  // It rests at 1.35, rises by g from 2 to 2.5, and falls again.
  constexpr double e = 0.5, lift = 0.5;
  Ball scene(e);
  scene.scene.add(force_law(points(scene.ball), [](auto t, auto r, auto) {
    return vec(0.0 * r.x(), t > 2.0 && t < 2.5 ? 0.0 * r.y() + 2.0 * 2.0 * g : 0.0 * r.y());
  }));
  const double second = Hop{2.0 + lift, 0.5 * g * lift * lift, g * lift}.rest(g, e);
  const auto run = simulate(scene.scene, options(6.0));
  std::vector<double> rests;
  for (const EventRecord& it : run.events())
    if (it.kind == EventKind::rested) rests.push_back(it.time);
  ASSERT_EQ(rests.size(), 2U);
  EXPECT_NEAR(rests[0], scene.first * (1.0 + e) / (1.0 - e), error_of_rest(e));
  EXPECT_NEAR(rests[1], second, error_of_rest(e));
}

TEST_P(Impacts, RestOfOneBallLeavesAnotherBouncing) {
  // One of restitution 1/2 rests three times its fall after the start. Near to that, at the loose tolerance
  // within its last bounces, an elastic one lands far from it: that keeps its energy.
  constexpr double loose = 1e-4, h = 0.3;
  const double rests = 3.0 * std::sqrt(2.0 * h / g);
  for (int k = 1; k <= 20; ++k) {
    Scene<2> scene("two");
    scene.add(UniformGravity<2>{{0.0, -g}});
    const double lands = rests - 0.001 * k, high = 0.5 * g * lands * lands;
    const auto first = scene.add_particle({.mass = 1.0, .position = {0.0, h}});
    const auto other = scene.add_particle({.mass = 1.0, .position = {5.0, high}});
    scene.add(unilateral(OnCurve{first, Plane<2>{}}, {.restitution = 0.5}), "first");
    scene.add(unilateral(OnCurve{other, Plane<2>{}}, {.restitution = 1.0}), "other");
    const auto run = simulate(
        scene, {.t_end = rests + 0.2, .samples = 2, .tolerance = loose, .stepper = GetParam().stepper});
    const double left = rests + 0.2 - lands;
    EXPECT_NEAR(run.position(first, 1).y(), 0.0, 10.0 * loose);
    EXPECT_NEAR(run.position(other, 1).y(), left * (g * lands - 0.5 * g * left), 100.0 * loose) << k;
  }
}

TEST_P(Impacts, PlasticImpactClosesTheContactAtOnce) {
  const Ball scene(0.0);
  const auto run = simulate(scene.scene, options(1.0));
  ASSERT_EQ(run.events().size(), 1U);
  EXPECT_EQ(run.events()[0].kind, EventKind::struck);
  EXPECT_NEAR(run.impulse(scene.floor, 0), 2.0 * std::sqrt(2.0 * g), bound);
  // The normal part of the energy is lost, and no other.
  EXPECT_NEAR(run.sample_after(0).energy(), 0.3 * 0.3, bound);
  EXPECT_NEAR(run.multiplier(scene.floor, 10), 2.0 * g, bound);
}

TEST_P(Impacts, ElasticImpactsKeepTheEnergy) {
  const Ball scene(1.0);
  const auto run = simulate(scene.scene, options(100.0));
  EXPECT_EQ(run.events().size(), static_cast<std::size_t>((100.0 / scene.first - 1.0) / 2.0) + 1);
  // A lone ball's errors are relative to its path, 30 long.
  EXPECT_NEAR(run.energy(10), run.energy(0), error_of(run) * 2.0 * g * 30.0);
}

TEST_P(Impacts, PendulumsRodGetsAnImpulseToo) {
  // The bob meets a vertical wall at x = -0.2, where the rod makes sin a = 0.2. It goes along (cos a, sin a)
  // at w = sqrt(2 g (cos a - cos 0.5)), and comes back at as much. The wall pushes along x: across the rod 2
  // w = P cos a; along it the rod takes up P sin a.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {std::sin(0.5), -std::cos(0.5)}});
  const auto rod = scene.add(Distance{Fixed<2>{}, bob, 1.0});
  const auto wall =
      scene.add(unilateral(holonomic(points(bob), [](auto r) { return r.x() + 0.2; }), {.restitution = 1.0}));
  const auto run = simulate(scene, options(10.0));
  const double a = std::asin(0.2), w = std::sqrt(2.0 * g * (std::cos(a) - std::cos(0.5)));
  ASSERT_GE(run.events().size(), 5U);
  const double error = error_of(run);
  for (std::size_t k = 0; k < run.events().size(); ++k) {
    EXPECT_NEAR(run.impulse(wall, k), 2.0 * w / std::cos(a), error * w);
    EXPECT_NEAR(std::abs(run.impulse(rod, k)), 2.0 * w * std::tan(a), error * w);
    // Together they are what the bob gains.
    const Vec<2> gained = run.sample_after(k).velocity(bob) - run.event_sample(k).velocity(bob);
    EXPECT_NEAR(gained.norm(), 2.0 * w, error * w);
  }
  EXPECT_NEAR(run.energy(10), run.energy(0), error * g);
}

/// Equal balls in a row at these places, the first of which goes to the others at 1.
std::vector<double> cradle(const std::vector<double>& places, const Options& options) {
  Scene<2> scene("cradle");
  std::vector<Particle<2>> balls;
  for (const double x : places)
    balls.push_back(scene.add_particle(
        {.mass = 1.0, .position = {x, 0.0}, .velocity = {balls.empty() ? 1.0 : 0.0, 0.0}}));
  for (std::size_t i = 0; i + 1 < balls.size(); ++i) {
    scene.add(unilateral(
        holonomic(points(balls[i], balls[i + 1]), [](auto a, auto b) { return b.x() - a.x() - 1.0; }),
        {.restitution = 1.0}));
  }
  const auto run = simulate(scene, options);
  std::vector<double> speeds;
  for (const auto ball : balls) speeds.push_back(run.velocity(ball, run.size() - 1).x());
  return speeds;
}

TEST_P(Impacts, TouchingBallsObeyMoreausLaw) {
  // U+ = 1 at the first contact; the others stay closed, U+ = 0, as nothing parts them: n - 1 balls go on as
  // one of mass n - 1 does, (1 - (n - 1))/n and 2/n.
  for (const int n : {2, 3, 5, 10}) {
    std::vector<double> places;
    for (int i = 0; i < n; ++i) places.push_back(i);
    const auto v = cradle(places, options(1.0));
    EXPECT_NEAR(v[0], (2.0 - n) / n, 1e-13);
    for (std::size_t i = 1; i < v.size(); ++i) EXPECT_NEAR(v[i], 2.0 / n, 1e-13) << n;
  }
}

TEST_P(Impacts, BallsApartHandTheSpeedOn) {
  // One after the other, however little they are apart: the last goes off at 1, all others rest.
  for (const double apart : {1e-1, 1e-4, 1e-7}) {
    const auto v = cradle({0.0, 1.0 + apart, 2.0 + 2.0 * apart, 3.0 + 3.0 * apart}, options(1.0));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(v[i], 0.0, bound) << apart;
    EXPECT_NEAR(v[3], 1.0, bound) << apart;
  }
}

TEST_P(Impacts, SimultaneousImpactsAreAllCarriedOut) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  std::vector<Particle<2>> balls;
  for (int i = 0; i < 3; ++i) {
    balls.push_back(scene.add_particle({.mass = 1.0 + i, .position = {2.0 * i, 1.0}}));
    scene.add(unilateral(holonomic(points(balls.back()), [](auto r) { return r.y(); }),
                         {.restitution = 0.5 + 0.1 * i}));
  }
  const auto run = simulate(scene, options(0.6));
  ASSERT_EQ(run.events().size(), 3U);
  const double first = std::sqrt(2.0 / g), left = 0.6 - first;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(run.events()[i].time, first, bound);
    const double up = (0.5 + 0.1 * static_cast<double>(i)) * g * first;
    EXPECT_NEAR(run.position(balls[i], 10).y(), up * left - g * left * left / 2.0, bound);
  }
}

TEST_P(Impacts, ImpactAtTheStartHasAStateBefore) {
  Scene<2> scene;
  const auto ball = scene.add_particle({.mass = 2.0, .velocity = {0.3, -1.0}});
  const auto floor =
      scene.add(unilateral(holonomic(points(ball), [](auto r) { return r.y(); }), {.restitution = 0.5}));
  const auto run = simulate(scene, options(1.0));
  ASSERT_EQ(run.events().size(), 1U);
  EXPECT_EQ(run.event_sample(0).velocity(ball).y(), -1.0);
  EXPECT_NEAR(run.event_sample(0).energy(), 1.09, bound);
  EXPECT_NEAR(run.sample_after(0).velocity(ball).y(), 0.5, bound);
  EXPECT_NEAR(run.impulse(floor, 0), 3.0, bound);
}

TEST_P(Impacts, ThreePlasticBallsEndInOneVelocity) {
  // Below e = 7 - 4 sqrt(3), by impacts without number, without any force (McNamara and Young, 1992).
  Scene<2> scene;
  std::vector<Particle<2>> balls;
  for (const auto& [x, v] : {std::pair(0.0, 1.0), std::pair(0.3, 0.0), std::pair(0.8, -0.9)})
    balls.push_back(scene.add_particle({.mass = 1.0, .position = {x, 0.0}, .velocity = {v, 0.0}}));
  for (std::size_t i = 0; i < 2; ++i)
    scene.add(
        unilateral(holonomic(points(balls[i], balls[i + 1]), [](auto a, auto b) { return b.x() - a.x(); }),
                   {.restitution = 0.0717}));
  Options limited = options(10.0);
  limited.max_steps = 2000;
  const auto run = simulate(scene, limited);
  EXPECT_EQ(run.events().back().kind, EventKind::rested);
  for (const auto ball : balls) EXPECT_NEAR(run.velocity(ball, 10).x(), 0.1 / 3.0, bound);
}

TEST_P(Impacts, StateIsReadBetweenSamplesAndStepByStep) {
  const Ball scene(1.0);
  Options dense = options(1.0);
  dense.dense = true;
  const auto run = simulate(scene.scene, dense);
  const double just_before = scene.first - 1e-6, just_after = scene.first + 1e-6, u = g * scene.first;
  EXPECT_NEAR(run.at({just_before}).velocity(scene.ball, 0).y(), -u + g * 1e-6, bound);
  EXPECT_NEAR(run.at({just_after}).velocity(scene.ball, 0).y(), u - g * 1e-6, bound);
  Simulation<2> simulation(scene.scene, options(1.0));
  while (simulation.time() < 1.0) simulation.step();
  EXPECT_EQ(simulation.events().size(), run.events().size());
  EXPECT_NEAR(simulation.position(scene.ball).y(), run.position(scene.ball, 10).y(), bound);
}

// A table on four legs that drops flat: of the impacts, which its legs share, each leg is struck every time,
// and all rest at sqrt(2 H/g) (1 + 2 e/(1 - e)).
TEST(SharedImpacts, StrikeEveryLegAndEndTogether) {
  constexpr double e = 0.5, H = 0.3;
  const double rest = std::sqrt(2.0 * H / g) * (1.0 + 2.0 * e / (1.0 - e));
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    for (const double vx : {0.0, 0.1, 0.2}) {
      Scene<3> scene;
      scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
      const auto table = add_body(scene,
                                  BodyState<3>{.mass = 4.0,
                                               .inertia = {0.3, 0.4, 0.6},
                                               .centre = {0.0, 0.0, 0.7 + H},
                                               .velocity = {vx, 0.1, 0.0}},
                                  "table");
      for (const double x : {-0.4, 0.4})
        for (const double y : {-0.3, 0.3})
          scene.add(unilateral(OnSurface{table.point({x, y, -0.7}), Plane<3>{}}, {.restitution = e}));
      const auto run = simulate(scene, {.t_end = 1.0, .samples = 3, .tolerance = 1e-8, .stepper = stepper});
      std::vector<double> rests;
      for (const EventRecord& it : run.events())
        if (it.kind == EventKind::rested) rests.push_back(it.time);
      ASSERT_EQ(rests.size(), 4U) << vx;
      // As exactly as some impacts, each known to the tolerance, tell the limit of all.
      for (const double t : rests) EXPECT_NEAR(t, rest, 100.0 * 1e-8) << vx;
      EXPECT_EQ(run.events()[0].time, run.events()[3].time);
    }
  }
}

// The wall's impacts end; the floor, on which the block lies all the while, does not come to rest.
TEST(SharedImpacts, EndInTheRestOfWhatBounced) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{1.0, -g}});
  const auto block = scene.add_particle({.mass = 1.0});
  const auto floor = scene.add(unilateral(OnCurve{block, Plane<2>{}}), "floor");
  const auto wall =
      scene.add(unilateral(OnCurve{block, Plane<2>{{0.2, 0.0}, {-1.0, 0.0}}}, {.restitution = 0.5}));
  const auto run = simulate(scene, {.t_end = 3.0, .samples = 3});
  EXPECT_EQ(run.events().back().kind, EventKind::rested);
  for (const EventRecord& it : run.events())
    EXPECT_EQ(it.source, static_cast<std::size_t>(wall.index)) << name(it.kind);
  EXPECT_NEAR(run.multiplier(floor, 2), g, bound);
}

// From either side of an impact of a ball that has gone some way along the floor.
TEST(SharedImpacts, AreWhereAnotherRunMayBegin) {
  const Ball ball(0.5);
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    const Options options{.t_end = 1.2, .samples = 3, .tolerance = 1e-8, .stepper = stepper};
    const auto run = simulate(ball.scene, options);
    for (const auto& from : {run.event_sample(0), run.sample_after(0)}) {
      const auto rest = simulate(ball.scene, from, options);
      EXPECT_NEAR(rest.position(ball.ball, 2).y(), run.position(ball.ball, 2).y(), 100.0 * 1e-8);
    }
  }
}

// The gap dips below 0 for no longer than a step overlooks, by less than forces are known to.
TEST(SmallBalls, MeetWhateverTheStep) {
  constexpr double speed = 2.0, apart = 0.7, loose = 1e-4;
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    for (double size = 1e-4; size < 0.02; size *= 1.1) {
      Scene<2> scene;
      const auto ball = scene.add_particle({.mass = 1.0, .velocity = {speed, 0.0}}),
                 struck = scene.add_particle({.mass = 3.0, .position = {apart + size, 0.0}});
      const auto touch = scene.add(unilateral(Distance{ball, struck, size}, {.restitution = 0.5}));
      const double meet = apart / speed;
      const auto run = simulate(scene, {.t_end = 2.0 * meet, .tolerance = loose, .stepper = stepper});
      ASSERT_EQ(run.events().size(), 1U) << size;
      EXPECT_NEAR(run.events()[0].time, meet, 10.0 * loose * meet);
      // (1 + e) of the reduced mass, 3/4.
      EXPECT_NEAR(run.impulse(touch, 0), 1.5 * 0.75 * speed, 10.0 * loose * speed);
    }
  }
}

// Between walls that close in impacts come faster and faster, and then slower: none of them ends in rest.
TEST(ElasticBall, LeavesANarrowWedge) {
  constexpr double loose = 1e-4;
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    for (const double angle : {0.01, 0.02, 0.05, 0.1, 0.2}) {
      for (double off = 0.1; off < 0.95; off += 0.1) {
        Scene<2> scene;
        const Vec<2> at(1.0, off * std::tan(angle));
        const auto ball = scene.add_particle({.mass = 1.0, .position = at, .velocity = {-1.0, 0.0}});
        scene.add_particle({.mass = 1.0, .position = {0.0, 5.0}});
        for (const double side : {-1.0, 1.0}) {
          const Vec<2> out(std::sin(angle), side * std::cos(angle));
          scene.add(unilateral(OnCurve{ball, Plane<2>{{0.0, 0.0}, out}}, {.restitution = 1.0}));
        }
        const auto run = simulate(scene, {.t_end = 2.0, .tolerance = loose, .stepper = stepper});
        EXPECT_NEAR(run.velocity(ball, run.size() - 1).norm(), 1.0, 100.0 * loose) << angle << ' ' << off;
      }
    }
  }
}

// Steps end where a force jumps, and between its jumps halves of them: a touch at such a time is not the end
// of the dip.
TEST(SmallBalls, MeetWhereAStepLooks) {
  constexpr double speed = 1.0, apart = 0.3;
  for (const double loose : {1e-4, 1e-6}) {
    for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
      for (double size = 1e-4; size < 0.02; size *= 1.2) {
        Scene<2> scene;
        const auto ball = scene.add_particle({.mass = 1.0, .velocity = {speed, 0.0}}),
                   struck = scene.add_particle({.mass = 1.0, .position = {apart + size, 0.0}}),
                   other = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}});
        scene.add(force_law(points(other), [](auto t, auto, auto) { return vec(cos(t), 0.0 * t); }));
        scene.add(unilateral(Distance{ball, struck, size}, {.restitution = 1.0}));
        const auto run =
            simulate(scene, {.t_end = 2.0 * apart / speed, .tolerance = loose, .stepper = stepper});
        ASSERT_EQ(run.events().size(), 1U) << size;
        EXPECT_NEAR(run.velocity(struck, run.size() - 1).x(), speed, 10.0 * loose * speed);
      }
    }
  }
}

// A ball between smooth walls: its hops on the floor end after (1 + e)/(1 - e) of the fall, the walls strike
// it for ever.
TEST(ElasticBall, GoesOnBetweenWallsWhereItsHopsEnd) {
  constexpr double width = 1e-3, speed = 4.0, height = 0.1, e = 0.5;
  const double rests = std::sqrt(2.0 * height / g) * (1.0 + e) / (1.0 - e);
  for (const double tolerance : {1e-4, 1e-6}) {
    for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
      Scene<2> scene;
      scene.add(UniformGravity<2>{{0.0, -g}});
      const auto ball =
          scene.add_particle({.mass = 1.0, .position = {0.5 * width, height}, .velocity = {speed, 0.0}});
      const auto floor = scene.add(unilateral(OnCurve{ball, Plane<2>{}}, {.restitution = e}));
      for (const double side : {0.0, 1.0}) {
        const Plane<2> wall{{side * width, 0.0}, {1.0 - 2.0 * side, 0.0}};
        scene.add(unilateral(OnCurve{ball, wall}, {.restitution = 1.0}));
      }
      const auto run = simulate(scene, {.t_end = 1.5 * rests, .tolerance = tolerance, .stepper = stepper});
      EXPECT_NEAR(std::abs(run.velocity(ball, run.size() - 1).x()), speed, 100.0 * tolerance * speed);
      for (const EventRecord& it : run.events()) {
        if (it.kind != EventKind::rested) continue;
        EXPECT_EQ(it.source, static_cast<std::size_t>(floor.index));
        EXPECT_NEAR(it.time, rests, 100.0 * tolerance);
      }
    }
  }
}

}  // namespace
}  // namespace dalembert::impacts_test
