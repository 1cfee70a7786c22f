#include <dalembert/dalembert.h>
#include <dalembert/tests/both_steppers.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

/// Where the direction or the mode of Coulomb's friction changes: impacts, users' changes, prescribed slips,
/// and several contacts at once; at loose and tight tolerances.
namespace dalembert::coulomb_changes_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double g = 9.81;

class CoulombChanges : public testing::TestWithParam<StepperAt> {
 protected:
  [[nodiscard]] static double tolerance() { return GetParam().tolerance; }
  /// A run of a few seconds errs by some tens of its tolerance, and so do the times at which it gets
  /// anywhere.
  [[nodiscard]] static double bound() { return 200.0 * tolerance(); }
  /// Leaving rest by a force that grows, u = c t^2/2 turns at a rate 1/u: of the explicit stepper's steps the
  /// integral of that takes the inverse root of the slowest u that is followed, 1000 tolerances.
  [[nodiscard]] static double most_steps() {
    return 500.0 + (GetParam().stepper == Stepper::erk ? 5.0 / std::sqrt(1000.0 * tolerance()) : 0.0);
  }
  [[nodiscard]] static Options options(double t_end) {
    return {.t_end = t_end, .samples = 11, .tolerance = tolerance(), .stepper = GetParam().stepper};
  }
};
INSTANTIATE_TEST_SUITE_P(Runs, CoulombChanges, both_steppers_at({1e-5, 1e-7, 1e-10}), tolerance_name);

/// A block of mass 2 on a floor, or a belt.
struct Block {
  Scene<2> scene{"block"};
  Particle<2> block;
  Constraint<1> floor, rough;

  explicit Block(double speed, double mu, double belt = 0.0) {
    scene.add(UniformGravity<2>{{0.0, -g}});
    block = scene.add_particle({.mass = 2.0, .velocity = {speed, 0.0}}, "block");
    floor = scene.add(OnCurve{block, Plane<2>{}}, "floor");
    rough = scene.add(coulomb(floor, Slip{block, Plane<2>{}, {belt, 0.0}}, mu), "rough");
  }
};

TEST_P(CoulombChanges, SlowABlockThatAWallTurnedRound) {
  // From 3 to v = sqrt(9 - 2 mu g) at the wall, back with half of that, to rest after v^2/(8 mu g).
  constexpr double mu = 0.2;
  Block its(3.0, mu);
  const Plane<2> wall{.point = {1.0, 0.0}, .normal = {-1.0, 0.0}};
  its.scene.add(unilateral(OnCurve{its.block, wall}, {.restitution = 0.5}));
  const double v = std::sqrt(9.0 - 2.0 * mu * g), strikes = (3.0 - v) / (mu * g),
               rests = strikes + 0.5 * v / (mu * g);
  const auto run = simulate(its.scene, options(3.0));
  ASSERT_EQ(run.events().size(), 2U);
  EXPECT_NEAR(run.events()[0].time, strikes, bound());
  EXPECT_NEAR(run.events()[1].time, rests, bound());
  EXPECT_NEAR(run.sample_after(0).multiplier(its.rough), mu * 2.0 * g, bound() * g);
  EXPECT_NEAR(run.position(its.block, 10).x(), 1.0 - v * v / (8.0 * mu * g), bound());
  EXPECT_NEAR(run.velocity(its.block, 10).norm(), 0.0, bound());
}

TEST_P(CoulombChanges, FollowABeltThatReverses) {
  // At rest on a belt at 1, which turns at t = 1: the block slides with -mu g until it moves with it again.
  constexpr double mu = 0.3;
  Block its(1.0, mu, 1.0);
  const auto turn = [&](Scene<2>& scene) {
    scene.replace(its.rough, coulomb(its.floor, Slip{its.block, Plane<2>{}, {-1.0, 0.0}}, mu));
  };
  const auto run =
      simulate(its.scene, options(2.0),
               {{"turns", [](const auto& now) { return now.time() - 1.0; }, Crossing::rising, false, turn}});
  ASSERT_EQ(run.events().size(), 3U);
  EXPECT_EQ(run.events()[1].kind, EventKind::slides);
  EXPECT_EQ(run.events()[2].kind, EventKind::sticks);
  EXPECT_NEAR(run.events()[2].time, 1.0 + 2.0 / (mu * g), bound());
  EXPECT_NEAR(run.sample_after(0).multiplier(its.rough), -mu * 2.0 * g, bound() * g);
  EXPECT_NEAR(run.position(its.block, 10).x(), 1.0 - (2.0 - 1.0 - 2.0 / (mu * g)), bound());
}

TEST_P(CoulombChanges, FrictionOpposesATurnedVelocity) {
  // At t = 0.5 the velocity is set to -2: to rest after 2/(mu g).
  constexpr double mu = 0.3;
  Block its(3.0, mu);
  const auto turn = [&](Scene<2>& scene) {
    const Vec<2> at{scene.initial_positions()[0], scene.initial_positions()[1]};
    scene.replace(its.block, ParticleState<2>{.mass = 2.0, .position = at, .velocity = {-2.0, 0.0}});
  };
  const auto run =
      simulate(its.scene, options(2.0),
               {{"turns", [](const auto& now) { return now.time() - 0.5; }, Crossing::rising, false, turn}});
  EXPECT_NEAR(run.sample_after(0).multiplier(its.rough), mu * 2.0 * g, bound() * g);
  EXPECT_NEAR(run.events().back().time, 0.5 + 2.0 / (mu * g), bound());
  EXPECT_NEAR(run.position(its.block, 10).x(), 3.0 * 0.5 - mu * g * 0.125 - 2.0 / (mu * g), bound());
}

TEST_P(CoulombChanges, CarriedBlockSlidesBothWays) {
  // x = 1 + A sin w t: friction -mu m g sgn v, the rod gives the rest of m x''.
  constexpr double mu = 0.3, A = 0.1, w = 2.0;
  Scene<2> scene("carried");
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto block = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}, .velocity = {A * w, 0.0}});
  const auto table = scene.add(OnCurve{block, Plane<2>{}});
  const auto rough = scene.add(coulomb(table, Slip{block, Plane<2>{}}, mu));
  const auto rod = scene.add(Distance{driven([](auto t) { return vec(A * sin(w * t), 0.0); }), block, 1.0});
  const auto run = simulate(scene, options(3.0));
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i], friction = -std::copysign(mu * g, std::cos(w * t));
    EXPECT_NEAR(run.multiplier(rough, i), friction, bound() * g) << t;
    EXPECT_NEAR(run.multiplier(rod, i), -A * w * w * std::sin(w * t) - friction, bound() * g) << t;
  }
  ASSERT_EQ(run.events().size(), 2U);  // v = 0 at w t = pi/2, 3 pi/2
  EXPECT_NEAR(run.events()[0].time, std::numbers::pi / 4.0, bound());
  EXPECT_EQ(run.events()[0].kind, EventKind::slides);
}

// The slip grows from rest like t^2, t^3 or after a rest: friction is there as soon as it is a slip.
TEST_P(CoulombChanges, BlockCarriedOffSlowlySlidesAtOnce) {
  constexpr double mu = 0.3;
  const auto carried = [&](const auto& path, double from) {
    Scene<2> scene("carried");
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto block = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
    const auto table = scene.add(OnCurve{block, Plane<2>{}});
    const auto rough = scene.add(coulomb(table, Slip{block, Plane<2>{}}, mu));
    scene.add(Distance{driven([path](auto t) { return vec(path(t), 0.0 * t); }), block, 1.0});
    const auto run = simulate(scene, options(2.0));
    for (std::size_t i = 0; i < run.size(); ++i)
      if (run.times()[i] > from) {
        EXPECT_NEAR(run.multiplier(rough, i), -mu * g, bound() * g) << run.times()[i];
      }
  };
  carried([](auto t) { return 0.2 * (2.0 * t - sin(2.0 * t)); }, 0.0);
  carried([](auto t) { return t * t * t; }, 0.0);
  carried(
      [](auto t) {
        const auto s = t - 1.0;
        if (t < 1.0) return 0.0 * t;
        return s * s * s;
      },
      1.0);
}

TEST_P(CoulombChanges, HeldWheelSlidesBothWays) {
  // Centre held, phi = sin t prescribed: the slip is R phi'.
  constexpr double mu = 0.2, R = 0.5, m = 2.0, I = 0.25;
  Scene<2> scene("grinder");
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto centre = scene.add_particle({.mass = m, .position = {0.0, R}});
  const auto wheel = scene.add_rotor({.inertia = I, .angular_velocity = 1.0});
  const Fixed<2> a{{0.0, 0.0}}, b{{1.0, 0.0}};
  const auto track = scene.add(PointLineDistance{centre, a, b, R});
  const auto arm = scene.add(Distance{Fixed<2>{{-1.0, R}}, centre, 1.0});
  const auto motor = scene.add(Prescribed{wheel, [](auto t) { return vec(sin(t)); }});
  const auto rough = scene.add(coulomb(track, Rolling{centre, wheel, a, b, R}, mu));
  const auto run = simulate(scene, options(6.0));
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i], friction = -std::copysign(mu * m * g, std::cos(t));
    EXPECT_NEAR(run.multiplier(rough, i), friction, bound() * m * g) << t;
    EXPECT_NEAR(run.multiplier(arm, i), -friction, bound() * m * g) << t;
    EXPECT_NEAR(run.multiplier(motor, i), -I * std::sin(t) - R * friction, bound() * m * g) << t;
  }
}

TEST_P(CoulombChanges, SharesOfHeldFeetAreNotUnique) {
  Scene<2> scene("held");
  scene.add(UniformGravity<2>{{1.0, -g}});
  const auto block = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  const auto table = scene.add(OnCurve{block, Plane<2>{}});
  const auto rough = scene.add(coulomb(table, Slip{block, Plane<2>{}}, 0.3));
  const auto rod = scene.add(Distance{Fixed<2>{{0.0, 0.0}}, block, 1.0});
  const auto run = simulate(scene, options(1.0));
  EXPECT_FALSE(run.is_unique(rough, 10));
  EXPECT_NEAR(run.multiplier(rough, 10) + run.multiplier(rod, 10), -1.0, bound());
  EXPECT_LE(std::abs(run.multiplier(rough, 10)), 0.3 * g);
}

/// Three feet of mass 1 at the corners of a triangle on a rough table, pushed at one of them along x by k t.
struct Stool {
  static constexpr double mu = 0.3;
  Scene<3> scene{"stool"};
  std::vector<Particle<3>> feet;
  std::vector<Constraint<2>> rough;

  Stool(std::size_t pushed, double k) {
    scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
    for (int i = 0; i < 3; ++i) {
      const double angle = 2.0 * std::numbers::pi / 3.0 * i;
      feet.push_back(scene.add_particle({.mass = 1.0, .position = {std::cos(angle), std::sin(angle), 0.0}}));
    }
    for (std::size_t i = 0; i < 3; ++i) scene.add(Distance{feet[i], feet[(i + 1) % 3], std::sqrt(3.0)});
    for (const auto foot : feet)
      rough.push_back(scene.add(coulomb(scene.add(OnSurface{foot, Plane<3>{}}), Slip{foot, Plane<3>{}}, mu)));
    scene.add(
        force_law(points(feet[pushed]), [k](auto t, auto, auto) { return vec(k * t, 0.0 * t, 0.0 * t); }));
  }
  [[nodiscard]] std::size_t number(std::size_t foot) const {
    return static_cast<std::size_t>(rough[foot].index);
  }
};

TEST_P(CoulombChanges, ThreeFeetHoldUntilAllOfThemSlide) {
  // Pushed along the axis of symmetry: k t/3 on each foot, translation from k t = 3 mu g on.
  constexpr double k = 10.0;
  Stool its(0, k);
  const double goes = 3.0 * Stool::mu * g / k;
  Options all = options(1.2);
  all.assemble = true;
  const auto run = simulate(its.scene, all);
  ASSERT_EQ(run.events().size(), 3U);
  for (const EventRecord& it : run.events()) EXPECT_NEAR(it.time, goes, bound());
  EXPECT_FALSE(run.is_unique(its.rough[0], 5));
  EXPECT_LE(run.multiplier(its.rough[0], 5).norm(), Stool::mu * g);
  const double left = 1.2 - goes;
  const double of_steps = tolerance() * static_cast<double>(run.statistics().steps);  // each errs by so much
  EXPECT_NEAR(run.velocity(its.feet[1], 10).x(), k / 6.0 * left * left, bound() + of_steps);
  EXPECT_NEAR(run.velocity(its.feet[1], 10).y(), 0.0, bound());
  EXPECT_LT(static_cast<double>(run.statistics().steps), most_steps());
}

TEST_P(CoulombChanges, ThreeFeetTurnAboutOneThatKeepsStill) {
  // Pushed at the second: about the third, F sqrt(3) = 2 mu g sqrt(3).
  constexpr double k = 5.0;
  Stool its(1, k);
  Options all = options(1.5);
  all.assemble = true;
  const auto run = simulate(its.scene, all);
  const double goes = 2.0 * Stool::mu * g / k;
  ASSERT_GE(run.events().size(), 2U);
  EXPECT_NEAR(run.events()[0].time, goes, bound());
  EXPECT_NEAR(run.events()[1].time, goes, bound());
  EXPECT_NE(run.events()[0].source, its.number(2));
  EXPECT_NE(run.events()[1].source, its.number(2));
  for (std::size_t foot = 0; foot < 3; ++foot) {
    const Vec<3> v = run.velocity(its.feet[foot], 10),
                 sigma = run.constraint_force(its.rough[foot], its.feet[foot], 10);
    EXPECT_NEAR((sigma + Stool::mu * g * v.normalized()).norm(), 0.0, std::sqrt(tolerance()) * g);
  }
  EXPECT_LT(static_cast<double>(run.statistics().steps), most_steps());
}

TEST_P(CoulombChanges, TwoFeetHaveTheFrictionOfBoth) {
  // Joined by a rod: they go where the push is mu times both weights.
  constexpr double k = 6.0, mu = 0.3;
  Scene<2> scene("feet");
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto left = scene.add_particle({.mass = 1.0}),
             right = scene.add_particle({.mass = 3.0, .position = {1.0, 0.0}});
  scene.add(Distance{left, right, 1.0});
  for (const auto foot : {left, right})
    scene.add(coulomb(scene.add(OnCurve{foot, Plane<2>{}}), Slip{foot, Plane<2>{}}, mu));
  scene.add(force_law(points(left), [](auto t, auto, auto) { return vec(k * t, 0.0); }));
  const double goes = 4.0 * mu * g / k;
  const auto run = simulate(scene, options(4.0));
  ASSERT_EQ(run.events().size(), 2U);
  for (const EventRecord& it : run.events()) EXPECT_NEAR(it.time, goes, bound());
  const double v = k / 8.0 * (4.0 - goes) * (4.0 - goes);
  EXPECT_NEAR(run.velocity(right, 10).x(), v, bound() * v);
}

TEST_P(CoulombChanges, PuckTurnsBackDownAnIncline) {
  // Straight up with 2: slows by (s + mu c) g, then back with (s - mu c) g.
  constexpr double mu = 0.2, s = 0.6, c = 0.8;
  Scene<3> scene;
  scene.add(UniformGravity<3>{{-s * g, 0.0, -c * g}});
  const auto puck = scene.add_particle({.mass = 2.0, .velocity = {2.0, 0.0, 0.0}});
  const auto table = scene.add(OnSurface{puck, Plane<3>{}});
  const auto rough = scene.add(coulomb(table, Slip{puck, Plane<3>{}}, mu));
  const double turns = 2.0 / ((s + mu * c) * g);
  const auto run = simulate(scene, options(1.0));
  ASSERT_EQ(run.events().size(), 1U);
  EXPECT_EQ(run.events()[0].kind, EventKind::slides);
  EXPECT_NEAR(run.events()[0].time, turns, bound());
  EXPECT_NEAR(run.velocity(puck, 10).x(), -(s - mu * c) * g * (1.0 - turns), bound() * g);
  EXPECT_NEAR(run.constraint_force(rough, puck, 10).x(), mu * c * 2.0 * g, bound() * g);
}

/// The time at which a puck rests that is pulled by m f along x on a table that it presses with m (g - k t):
/// with u = rho d, rho' = f cos - a(t), rho theta' = -f sin, in s with dt = rho ds, by Runge and Kutta.
double time_of_rest(double f, double mu, double k, double speed, double theta) {
  struct State {
    double log_rho, theta, t;
  } x{std::log(speed), theta, 0.0};
  const auto rate = [&](const State& y) {
    return State{f * std::cos(y.theta) - mu * (g - k * y.t), -f * std::sin(y.theta), std::exp(y.log_rho)};
  };
  const auto moved = [](const State& y, double h, const State& r) {
    return State{y.log_rho + h * r.log_rho, y.theta + h * r.theta, y.t + h * r.t};
  };
  constexpr double h = 1e-3;
  while (x.log_rho > std::log(1e-15)) {
    const State a = rate(x), b = rate(moved(x, 0.5 * h, a)), c = rate(moved(x, 0.5 * h, b)),
                d = rate(moved(x, h, c));
    for (const auto& [part, weight] : {std::pair{a, 1.0}, {b, 2.0}, {c, 2.0}, {d, 1.0}})
      x = moved(x, h * weight / 6.0, part);
  }
  return x.t;
}

TEST_P(CoulombChanges, PuckComesToRestInTimeUnderAVaryingForce) {
  constexpr double mu = 0.3, k = 2.0;
  for (const double f : {0.4, 1.2}) {
    for (const double angle : {0.5, 1.5, 2.5}) {
      Scene<3> scene;
      scene.add(UniformGravity<3>{{f, 0.0, -g}});
      const auto puck =
          scene.add_particle({.mass = 2.0, .velocity = {std::cos(angle), std::sin(angle), 0.0}});
      const auto table = scene.add(OnSurface{puck, Plane<3>{}});
      scene.add(coulomb(table, Slip{puck, Plane<3>{}}, mu));
      scene.add(
          force_law(points(puck), [](auto t, auto, auto) { return vec(0.0 * t, 0.0 * t, 2.0 * k * t); }));
      const double rests = time_of_rest(f, mu, k, 1.0, angle);
      const auto run = simulate(scene, options(rests + 0.2));
      ASSERT_EQ(run.events().size(), 1U);
      EXPECT_NEAR(run.events()[0].time, rests, bound() * rests) << f << ' ' << angle;
    }
  }
}

// A change of what slides along a rough incline is no impact: its normal part is round-off.
/// A particle that hangs nearby is let go: nothing else moves, so that all speeds and impulses are round-off.
TEST_P(CoulombChanges, ChangeElsewhereIsNoImpactOnWhatSticks) {
  for (const double angle : {0.3, 0.8, 1.1}) {
    const Vec<2> normal(-std::sin(angle), std::cos(angle));
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto block = scene.add_particle({.mass = 1.0}, "block");
    const Plane<2> incline{{0.0, 0.0}, normal};
    const auto floor = scene.add(OnCurve{block, incline}, "floor");
    scene.add(coulomb(floor, Slip{block, incline}, 1.1 * std::tan(angle)), "rough");
    const auto load = scene.add_particle({.mass = 1.0, .position = {3.0, 0.0}}, "load");
    const auto hook = scene.add(Coincident{load, Fixed<2>{{3.0, 0.0}}}, "hook");
    const auto run = simulate(scene, options(1.0),
                              {{.name = "let go",
                                .function = [](const Sample<2>& now) { return now.time() - 0.35; },
                                .change = [hook](Scene<2>& next) { next.release(hook); }}});
    ASSERT_EQ(run.events().size(), 1U) << angle;
    EXPECT_NEAR(run.position(load, 10).y(), -0.5 * g * 0.65 * 0.65, bound()) << angle;
    EXPECT_NEAR(run.position(block, 10).norm(), 0.0, bound()) << angle;
  }
}

TEST_P(CoulombChanges, KickAlongAnInclineIsNoImpact) {
  constexpr double mu = 0.2, kick = 0.7;
  for (const double angle : {0.1, 0.3, 0.5, 0.7}) {
    const double c = std::cos(angle), s = std::sin(angle), a = g * (s - mu * c);
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -g}});
    const Plane<2> incline{{0.0, 0.0}, {s, c}};
    const auto block = scene.add_particle({.mass = 1.0, .velocity = {2.0 * c, -2.0 * s}}, "block");
    const auto floor = scene.add(OnCurve{block, incline});
    scene.add(coulomb(floor, Slip{block, incline}, mu));
    const Event<2> kicked{.name = "kick",
                          .function = [](const auto& now) { return now.time() - 0.2; },
                          .change =
                              [=](Scene<2>& changed) {
                                const auto q = changed.initial_positions(), v = changed.initial_velocities();
                                changed.replace(block, {.mass = 1.0,
                                                        .position = {q[0], q[1]},
                                                        .velocity = {v[0] + kick * c, v[1] - kick * s}});
                              }};
    const auto run = simulate(scene, options(0.5), {kicked});
    const double v = 2.0 + 0.5 * a + kick;
    EXPECT_NEAR(run.velocity(block, 10).norm(), v, bound()) << angle;
  }
}

}  // namespace
}  // namespace dalembert::coulomb_changes_test
