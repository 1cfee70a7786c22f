#include <dalembert/tests/solvers/with_events.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace dalembert::coulomb_in_space_test {
namespace {

class CoulombFrictionInSpace : public WithEvents {};
INSTANTIATE_TEST_SUITE_P(Runs, CoulombFrictionInSpace, at_tolerances, tolerance_name);

TEST_P(CoulombFrictionInSpace, IsRound) {
  // A puck on a plane that is pulled along x by m f, below what friction holds:
  //
  //   u' = -mu g u/|u| + f e_x,   d(mu g |u| + f u_x)/dt = f^2 - (mu g)^2
  //
  // so it rests after (mu g |u0| + f u0_x)/((mu g)^2 - f^2), whatever the bend of its path.
  constexpr double mu = 0.3, a = mu * g;
  for (const double f : {0.0, 0.5 * a, 0.8 * a}) {
    for (const double angle : {0.0, 0.7, 2.0, 3.0}) {
      Scene<3> scene;
      scene.add(UniformGravity<3>{{f, 0.0, -g}});
      const Vec<3> along(std::cos(angle), std::sin(angle), 0.0);
      const auto puck = scene.add_particle({.mass = 2.0, .velocity = 2.0 * along});
      const auto table = scene.add(OnSurface{puck, Plane<3>{}});
      const auto rough = scene.add(coulomb(table, Slip{puck, Plane<3>{}}, mu));
      const double rests = 2.0 * (a + f * along.x()) / (a * a - f * f);
      const auto run = simulate(scene, options(rests + 1.0));
      EXPECT_NEAR((run.constraint_force(rough, puck, 0) + 2.0 * a * along).norm(), 0.0, bound * g);
      ASSERT_EQ(run.events().size(), 1U) << f << ' ' << angle;
      EXPECT_EQ(run.events()[0].kind, EventKind::sticks);
      EXPECT_NEAR(run.events()[0].time, rests, error_of(run) * rests) << f << ' ' << angle;
      EXPECT_NEAR(run.constraint_force(rough, puck, 10).x(), -2.0 * f, bound * g);
      if (f == 0.0) {
        EXPECT_NEAR((run.position(puck, 10) - 2.0 / a * along).norm(), 0.0, bound);
      }
    }
  }
}

// As IsRound, pulled by half of what friction holds: a run that claims an accuracy rests at a time that is
// known to it, up to the ten times that errors may add up to. At 1e-12 ida was off by 1.4e-7.
TEST_P(CoulombFrictionInSpace, RestsInTimeAtEveryTolerance) {
  constexpr double mu = 0.3, a = mu * g, f = 0.5 * a, angle = 0.7;
  Scene<3> scene;
  scene.add(UniformGravity<3>{{f, 0.0, -g}});
  const auto puck =
      scene.add_particle({.mass = 2.0, .velocity = {2.0 * std::cos(angle), 2.0 * std::sin(angle), 0.0}});
  const auto table = scene.add(OnSurface{puck, Plane<3>{}});
  scene.add(coulomb(table, Slip{puck, Plane<3>{}}, mu));
  const double rests = 2.0 * (a + f * std::cos(angle)) / (a * a - f * f);
  for (const double tight : {1e-4, 1e-6, 1e-8, 1e-11, 1e-12, 1e-13}) {
    Options options = this->options(rests + 1.0);
    options.tolerance = tight;
    const auto run = simulate(scene, options);
    ASSERT_EQ(run.events().size(), 1U);
    EXPECT_NEAR(run.events()[0].time, rests, 10.0 * run.statistics().accuracy * rests);
    EXPECT_LT(run.statistics().accuracy, 100.0 * tight);
  }
}

// On a belt of speed 1 on a spring of 4 N/m, 1 kg with mu g = 4: it sticks until x = r, r = mu_static/mu,
// slides as x = 1 + D cos 2s + sin 2s/2 with D = r - 1, and has the belt's speed again at x = 1 - D, at
// s = pi - atan 2D. The slip that would follow is D^2 for r close to 1, and short: within a step it passes
// rest, and comes back.
TEST_P(CoulombFrictionInSpace, SticksToABeltHoweverShortly) {
  for (const double r : {1.01, 1.03, 1.1}) {
    Scene<3> scene;
    scene.add(UniformGravity<3>{{0.0, 0.0, -10.0}});
    const auto block =
        scene.add_particle({.mass = 1.0, .position = {r - 0.3, 0.0, 0.0}, .velocity = {1.0, 0.0, 0.0}});
    const auto belt = scene.add(OnSurface{block, Plane<3>{}});
    scene.add(coulomb(belt, Slip{block, Plane<3>{}, {1.0, 0.0, 0.0}}, 0.4, 0.4 * r));
    scene.add(Spring{Fixed<3>{}, block, 4.0});
    const auto run = simulate(scene, options(10.0));
    const double D = r - 1.0, slides = std::numbers::pi - std::atan(2.0 * D);
    ASSERT_EQ(run.events().size(), 7U) << r;
    double t = 0.3;
    for (std::size_t i = 0; i < 7; ++i) {
      EXPECT_EQ(run.events()[i].kind, i % 2 == 0 ? EventKind::slides : EventKind::sticks) << r;
      // The slip passes 0 with a slope of 4 D: an error of it is as much larger in time.
      EXPECT_NEAR(run.events()[i].time, t, error_of(run) / (4.0 * D)) << r << ' ' << i;
      t += i % 2 == 0 ? slides : 2.0 * D;
    }
  }
}

// Up an incline, and back down: by g (sin a + mu cos a) and g (sin a - mu cos a).
TEST_P(CoulombFrictionInSpace, TurnsBackOnceOnAnIncline) {
  if (tolerance < 1e-11 && GetParam().stepper == Stepper::ida) return;  // refused: round-off beside a rest
  constexpr double v = 1.7, a = 0.6, mu = 0.3;
  for (const double about : {0.0, 0.4, 2.1}) {
    const Vec<3> up(std::cos(about) * std::cos(a), std::sin(about) * std::cos(a), std::sin(a)),
        normal(-std::cos(about) * std::sin(a), -std::sin(about) * std::sin(a), std::cos(a));
    Scene<3> scene;
    scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
    const auto block = scene.add_particle({.mass = 1.0, .velocity = v * up});
    const Plane<3> incline{Vec<3>(0.0, 0.0, 0.0), normal};
    const auto floor = scene.add(OnSurface{block, incline});
    scene.add(coulomb(floor, Slip{block, incline}, mu));
    const double slows = g * (std::sin(a) + mu * std::cos(a)), falls = g * (std::sin(a) - mu * std::cos(a)),
                 turns = v / slows;
    const auto run = simulate(scene, options(turns + 1.0));
    ASSERT_EQ(run.events().size(), 1U) << about;
    EXPECT_EQ(run.events()[0].kind, EventKind::slides);
    EXPECT_NEAR(run.events()[0].time, turns, bound);
    const Vec<3> end = (0.5 * v * v / slows - 0.5 * falls) * up;
    EXPECT_NEAR((run.position(block, 10) - end).norm(), 0.0, bound);
  }
}

TEST_P(CoulombFrictionInSpace, GoesTheWayItIsPulled) {
  // From rest, by a force that grows: as the block in the plane.
  constexpr double k = 5.0, mu = 0.3, mu_static = 0.5;
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
  const auto puck = scene.add_particle({.mass = 2.0});
  const auto table = scene.add(OnSurface{puck, Plane<3>{}});
  scene.add(coulomb(table, Slip{puck, Plane<3>{}}, mu, mu_static));
  const Vec<3> way = Vec<3>(0.6, -0.8, 0.0);
  scene.add(force_law(points(puck), [way](auto t, auto, auto) { return (k * t * way).eval(); }));
  const double goes = mu_static * 2.0 * g / k, t = goes + 1.0;
  const auto run = simulate(scene, options(t));
  ASSERT_EQ(run.events().size(), 1U);
  EXPECT_NEAR(run.events()[0].time, goes, bound);
  const double v = (k * (t * t - goes * goes) / 2.0 - mu * 2.0 * g * (t - goes)) / 2.0;
  EXPECT_NEAR((run.velocity(puck, 10) - v * way).norm(), 0.0, bound * v);
}

// All decelerate by mu g, without a load on the bars between them, and stop together after v/(mu g), at
// v^2/(2 mu g). What an error of the steps leaves of the others' slip once one of them sticks is none.
TEST_P(CoulombFrictionInSpace, ThreeFeetThatSlideStraightOnStopTogether) {
  constexpr double mu = 0.3, v0 = 1.0;
  for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-11, 1e-12, 1e-13}) {
    Scene<3> scene("feet");
    scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
    std::vector<Particle<3>> feet;
    for (int i = 0; i < 3; ++i) {
      const double angle = 2.0 * std::numbers::pi / 3.0 * i;
      feet.push_back(scene.add_particle(
          {.mass = 1.0, .position = {std::cos(angle), std::sin(angle), 0.0}, .velocity = {v0, 0.0, 0.0}}));
    }
    for (std::size_t i = 0; i < 3; ++i) scene.add(Distance{feet[i], feet[(i + 1) % 3], std::sqrt(3.0)});
    for (const auto& foot : feet)
      scene.add(coulomb(scene.add(OnSurface{foot, Plane<3>{}}), Slip{foot, Plane<3>{}}, mu));
    const auto run = simulate(scene, {.t_end = 1.0,
                                      .samples = 3,
                                      .tolerance = tolerance,
                                      .stepper = GetParam().stepper,
                                      .max_steps = 2000,
                                      .assemble = true});
    const Vec<3> due(v0 * v0 / (2.0 * mu * g), 0.0, 0.0);
    for (const auto& foot : feet) {
      EXPECT_LE((run.position(foot, 2) - run.position(foot, 0) - due).norm(), 100.0 * tolerance + 1e-13)
          << tolerance;
    }
    EXPECT_EQ(run.events().size(), 3U) << tolerance;
    for (const auto& event : run.events()) EXPECT_EQ(event.kind, EventKind::sticks);
  }
}

TEST_P(CoulombFrictionInSpace, CoupledPucksAreHeldAgainstTheirAccelerations) {
  // Two pucks with a rod between them, pulled from rest each its own way.
  constexpr double mu = 0.3;
  Scene<3> scene;
  const auto a = scene.add_particle({.mass = 1.0}),
             b = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0, 0.0}});
  scene.add(Distance{a, b, 1.0});
  std::vector<Constraint<2>> rough;
  for (const auto puck : {a, b}) {
    const auto table = scene.add(OnSurface{puck, Plane<3>{}});
    rough.push_back(scene.add(coulomb(table, Slip{puck, Plane<3>{}}, mu)));
  }
  scene.add(force_law(points(a, b), [](auto, auto, auto, auto) {
    return std::tuple{vec(3.0, 5.0, -g), vec(4.0, -3.0, -g)};
  }));
  const auto run = simulate(scene, options(0.1));
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    const Vec<3> sigma = run.constraint_force(rough[k], k == 0 ? a : b, 0);
    const Vec<3> along = run.acceleration(k == 0 ? a : b, 0).normalized();
    EXPECT_NEAR((sigma + mu * g * along).norm(), 0.0,
                1e-5 * g);  // the root of round-off is asked of directions
  }
}

// Stages of a step that lie behind the rest pushed the block back, and the error estimate was deceived.
TEST_P(CoulombFrictionInSpace, RestsWhateverTheStep) {
  constexpr double a = 0.3 * g;
  for (const double loose : {1e-3, 1e-4}) {
    for (const double fast : {1.0, 10.0, 100.0}) {
      for (double v = 0.5; v < 4.0; v += 0.25) {
        Scene<3> scene;
        scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
        const auto block = scene.add_particle({.mass = 1.0, .velocity = {v, 0.0, 0.0}});
        scene.add_particle({.mass = 1.0, .position = {0.0, 10.0, 0.0}, .velocity = {fast, 0.0, 0.0}});
        const auto table = scene.add(OnSurface{block, Plane<3>{}});
        scene.add(coulomb(table, Slip{block, Plane<3>{}}, 0.3));
        const double rests = v / a;
        const auto run =
            simulate(scene, {.t_end = 2.0 * rests, .tolerance = loose, .stepper = GetParam().stepper});
        ASSERT_EQ(run.events().size(), 1U) << loose << ' ' << fast << ' ' << v;
        EXPECT_EQ(run.events()[0].kind, EventKind::sticks);
        // Speeds are known to the tolerance, of the scene's.
        const double error = 10.0 * run.statistics().accuracy;
        EXPECT_NEAR(run.events()[0].time, rests,
                    error * (rests + run.statistics().length / run.statistics().time / a));
      }
    }
  }
}

// A step that is taken again towards a rest may have begun behind the switch that lets another block go.
TEST_P(CoulombFrictionInSpace, RestsBehindAPushOfAnother) {
  constexpr double a = 0.3 * g, push = 6.0;
  for (double v = 0.5; v < 4.0; v += 0.25) {
    for (const double part : {0.5, 0.8, 0.9, 0.98}) {
      const double rests = v / a, from = part * rests;
      Scene<3> scene;
      scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
      const auto first = scene.add_particle({.mass = 1.0, .velocity = {v, 0.0, 0.0}}),
                 second = scene.add_particle({.mass = 1.0, .position = {0.0, 3.0, 0.0}});
      for (const auto& block : {first, second}) {
        const auto table = scene.add(unilateral(OnSurface{block, Plane<3>{}}));
        scene.add(coulomb(table, Slip{block, Plane<3>{}}, 0.3));
      }
      scene.add(force_law(points(second), [from, push](auto t, auto, auto) {
        return t > from ? vec(push, 0.0, 0.0) : vec(0.0, 0.0, 0.0);
      }));
      const auto run = simulate(scene, options(2.0 * rests));
      ASSERT_EQ(run.events().size(), 2U) << v << ' ' << part;
      EXPECT_EQ(run.events()[0].kind, EventKind::slides);
      EXPECT_EQ(run.events()[1].kind, EventKind::sticks);
      const double since = 2.0 * rests - from;
      EXPECT_NEAR(run.position(second, run.size() - 1).x(), 0.5 * (push - a) * since * since,
                  bound * since * since);
    }
  }
}

// A ball rolls along the inside of a vertical cylinder of radius A about its axis, its centre at the rate
// Omega, and down and up: with I = 2 m R^2/5 the rows of no slip give z'' = -(5 g/7) cos(k t), k^2 = 2
// Omega^2/7, and the wall pushes by m A Omega^2. The friction along z, m (g + z''), reaches mu times that at
// t1. The slip that begins has no acceleration at first: its direction, which turns with what it can be told
// by, is an error of the steps. Each of its turns began another
// sliding.
TEST_P(CoulombFrictionInSpace, BeginsToSlideOnce) {
  constexpr double A = 0.8, Omega = 4.0, R = 0.1, m = 0.7, mu = 0.9, I = 0.4 * m * R * R;
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
  const auto ball = add_body(scene,
                             BodyState<3>{.mass = m,
                                          .inertia = {I, I, I},
                                          .centre = {A, 0.0, 0.0},
                                          .velocity = {0.0, A * Omega, 0.0},
                                          .angular_velocity = {0.0, 0.0, -A * Omega / R}},
                             "ball");
  const auto wall = scene.add(OnSurface{ball.centre(), Cylinder{.axis = {0.0, 0.0, 1.0}, .radius = A}});
  const auto of_ball = points(ball.centre(), ball.vector({1.0, 0.0, 0.0}), ball.vector({0.0, 1.0, 0.0}),
                              ball.vector({0.0, 0.0, 1.0}));
  // With spin = (1/2) sum e_i x e_i', the slip v + spin x R n at the contact, along e_phi and e_z.
  const auto slip = [R = R](auto r, auto e1, auto e2, auto e3, auto v, auto d1, auto d2, auto d3) {
    const auto spin = 0.5 * (e1.cross(d1) + e2.cross(d2) + e3.cross(d3));
    const auto rho = sqrt(r.x() * r.x() + r.y() * r.y()), x = r.x() / rho, y = r.y() / rho;
    return vec(-y * v.x() + x * v.y() + R * spin.z(), v.z() + R * (spin.x() * y - spin.y() * x));
  };
  scene.add(coulomb(wall, nonholonomic(of_ball, slip), mu));
  const double t1 = std::acos(1.4 * (1.0 - mu * A * Omega * Omega / g)) / (std::sqrt(2.0 / 7.0) * Omega);
  for (const double tight : {1e-4, 1e-6, 1e-8, 1e-12}) {
    Options options = this->options(t1 + 0.05);
    options.tolerance = tight;
    const auto run = simulate(scene, options);
    ASSERT_EQ(run.events().size(), 1U) << tight;
    EXPECT_EQ(run.events()[0].kind, EventKind::slides);
    EXPECT_NEAR(run.events()[0].time, t1, error_of(run) * t1) << tight;
  }
}

}  // namespace
}  // namespace dalembert::coulomb_in_space_test
