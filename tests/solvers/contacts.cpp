#include <dalembert/solvers/linear/complementarity.h>
#include <dalembert/tests/solvers/with_events.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace dalembert::contacts_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Complementarity, IsSolvedForRandomPositiveSemidefiniteMatrices) {
  // A solution is checked without another solver. Ranks below the size, and rows repeated, make ties.
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 1 + trial % 12, rank = 1 + trial % n;
    Eigen::MatrixXd A(n, rank);
    for (double& x : A.reshaped()) x = normal(generator);
    if (n > 2) A.row(n - 1) = A.row(0);
    const Eigen::MatrixXd M = A * A.transpose();
    Eigen::VectorXd x(rank);
    for (double& y : x) y = normal(generator);
    const Eigen::VectorXd q = A * x;  // feasible: w = A (A^T z + x), and 0 is a minimum of |A^T z + x|
    const auto z = complementary_solution(M, q);
    ASSERT_TRUE(z) << trial;
    const Eigen::VectorXd w = M * *z + q;
    const double round_off = 1e-11 * (1.0 + q.cwiseAbs().maxCoeff() + (M * *z).cwiseAbs().maxCoeff());
    EXPECT_GE(z->minCoeff(), 0.0) << trial;
    EXPECT_GE(w.minCoeff(), -round_off) << trial;
    EXPECT_LE(std::abs(w.dot(*z)), round_off * (1.0 + z->sum())) << trial;
  }
}

TEST(Complementarity, SaysThatThereIsNoSolution) {
  EXPECT_FALSE(complementary_solution(Eigen::MatrixXd::Zero(1, 1), Eigen::VectorXd::Constant(1, -1.0)));
  Eigen::MatrixXd M(2, 2);
  M << 1.0, -1.0, -1.0, 1.0;
  EXPECT_FALSE(complementary_solution(M, Eigen::Vector2d(-1.0, -1.0)));
  EXPECT_TRUE(complementary_solution(M, Eigen::Vector2d(-1.0, 1.0)));
}

class Contacts : public WithEvents {};
INSTANTIATE_TEST_SUITE_P(Runs, Contacts, at_tolerances, tolerance_name);

TEST_P(Contacts, WashboardIsMetAtItsFirstCrest) {
  // Thrown flat over y = A sin(n x + 0.1), many of whose crests lie within one step of a parabola. The first
  // impact by looking along that in steps of 1e-5 s, and by bisection. The parabola is within round-off;
  // times are as exact as the path along the board is, to the tolerance of 1 m over the least speed of 3 m/s.
  constexpr double A = 0.05, h = 0.5;
  for (const double n : {20.0, 60.0}) {
    for (int k = 0; k < 10; ++k) {
      const double v = 3.0 + 0.37 * k;
      const auto gap = [=](double t) { return h - 0.5 * g * t * t - A * std::sin(n * v * t + 0.1); };
      double due = 0.0, behind = 1e-5;
      while (gap(behind) > 0.0) due = std::exchange(behind, behind + 1e-5);
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (due + behind);
        (gap(middle) > 0.0 ? due : behind) = middle;
      }
      Scene<2> scene("washboard");
      scene.add(UniformGravity<2>{{0.0, -g}});
      const auto ball = scene.add_particle({.mass = 1.0, .position = {0.0, h}, .velocity = {v, 0.0}}, "ball");
      scene.add(unilateral(holonomic(points(ball), [=](auto r) { return r.y() - A * sin(n * r.x() + 0.1); }),
                           {.restitution = 1.0}),
                "board");
      const auto run = simulate(scene, options(due + 0.01));
      ASSERT_FALSE(run.events().empty()) << n << ' ' << v;
      EXPECT_NEAR(run.events()[0].time, due, tolerance) << n << ' ' << v;
    }
  }
}

TEST_P(Contacts, VibratingTableThrowsItsLoad) {
  // y = A sin(w t): the load leaves where A w^2 sin(w t) = g, at A w cos(w t).
  constexpr double A = 0.1, w = 20.0;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto load = scene.add_particle({.mass = 1.0, .velocity = {0.0, A * w}});
  const auto table = scene.add(
      unilateral(holonomic(points(load), [](auto t, auto r) { return r.y() - A * sin(w * t); })), "table");
  const double leaves = std::asin(g / (A * w * w)) / w;
  const auto run = simulate(scene, options(leaves + 0.05));
  ASSERT_GE(run.events().size(), 1U);
  EXPECT_NEAR(run.events()[0].time, leaves, bound);
  EXPECT_NEAR(run.multiplier(table, 0), g, bound * g);
  EXPECT_NEAR(run.position(load, 10).y(),
              A * std::sin(w * leaves) + A * w * std::cos(w * leaves) * 0.05 - g * 0.05 * 0.05 / 2.0, bound);
}

// A mass drifts, without gravity, onto a floor that vibrates: it meets the first crest that reaches it, found
// by a scan.
TEST_P(Contacts, FloorFasterThanTheMotionStrikesAtItsFirstCrest) {
  constexpr double A = 0.01;
  for (const double w : {10.0, 100.0, 300.0}) {
    Scene<2> scene("drifts");
    const auto mass = scene.add_particle({.mass = 1.0, .position = {0.0, 0.05}, .velocity = {1.0, -0.05}});
    scene.add(unilateral(holonomic(points(mass), [=](auto t, auto r) { return r.y() - A * sin(w * t); }),
                         {.restitution = 1.0}));
    double t = 0.0;
    while (0.05 - 0.05 * t > A * std::sin(w * t)) t += 1e-6;
    for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
      auto o = options(1.5);
      o.tolerance = tolerance;
      const auto run = simulate(scene, o);
      ASSERT_GE(run.events().size(), 1U) << w << ' ' << tolerance;
      EXPECT_NEAR(run.events()[0].time, t, 1e-6) << w << ' ' << tolerance;
    }
  }
}

// What rests is pulled up by 12 t sin w t: it leaves the floor where that first is its weight of 10 N.
TEST_P(Contacts, RestingBlockOpensWhereAFastForceFirstLiftsIt) {
  for (const double w : {30.0, 100.0, 300.0}) {
    Scene<2> scene("pulled");
    scene.add(UniformGravity<2>{{0.0, -10.0}});
    const auto block = scene.add_particle({.mass = 1.0});
    scene.add(unilateral(OnCurve{block, Plane<2>{}}), "floor");
    scene.add(force_law(points(block), [=](auto t, auto r, auto) {
      const auto none = 0.0 * r.x();
      return vec(none, 12.0 * t * sin(w * t) + none);
    }));
    double t = 0.0;
    while (12.0 * t * std::sin(w * t) < 10.0) t += 1e-6;
    for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
      auto o = options(1.2);
      o.tolerance = tolerance;
      const auto run = simulate(scene, o);
      ASSERT_GE(run.events().size(), 1U) << w << ' ' << tolerance;
      EXPECT_NEAR(run.events()[0].time, t, 1e-5) << w << ' ' << tolerance;
    }
  }
}

TEST_P(Contacts, AllContactsThatShareALoadPush) {
  // A table on four legs, the load over one of them: the least squares would pull at the leg across.
  Scene<3> scene("table");
  scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
  const std::vector<Vec<3>> places{
      {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}, {0.1, 0.1, 0.3}};
  std::vector<Particle<3>> parts;
  for (const Vec<3>& r : places) {
    parts.push_back(scene.add_particle({.mass = parts.size() < 4 ? 0.01 : 1.0, .position = r}));
    for (std::size_t k = 0; k + 1 < parts.size(); ++k)
      scene.add(Distance{parts[k], parts.back(), (places[k] - r).norm()});
  }
  std::vector<Constraint<1>> legs;
  for (std::size_t i = 0; i < 4; ++i)
    legs.push_back(scene.add(unilateral(holonomic(points(parts[i]), [](auto r) { return r.z(); }))));
  const auto run = simulate(scene, options(0.1));
  double sum = 0.0, about_x = 0.0, about_y = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double force = run.multiplier(legs[i], 10);
    EXPECT_GE(force, 0.0);
    sum += force;
    about_x += force * places[i].y();
    about_y += force * places[i].x();
  }
  EXPECT_NEAR(sum, 1.04 * g, bound * g);
  EXPECT_NEAR(about_x, (0.1 + 0.02) * g, bound * g);
  EXPECT_NEAR(about_y, (0.1 + 0.02) * g, bound * g);
  EXPECT_FALSE(run.is_unique(legs[0], 10));
  EXPECT_TRUE(run.events().empty());
}

TEST_P(Contacts, StackCarriesWhatLiesOnIt) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto lower = scene.add_particle({.mass = 1.0}),
             upper = scene.add_particle({.mass = 2.0, .position = {0.0, 1.5}});
  const auto floor = scene.add(unilateral(holonomic(points(lower), [](auto r) { return r.y(); })));
  const auto between = scene.add(
      unilateral(holonomic(points(lower, upper), [](auto a, auto b) { return b.y() - a.y() - 1.0; })));
  const auto run = simulate(scene, options(1.0));
  ASSERT_EQ(run.events().size(), 2U);  // both impacts, at once
  EXPECT_NEAR(run.events()[0].time, std::sqrt(1.0 / g), bound);
  EXPECT_NEAR(run.impulse(floor, 0), 2.0 * std::sqrt(g), bound * g);
  EXPECT_NEAR(run.impulse(between, 0), 2.0 * std::sqrt(g), bound * g);
  EXPECT_NEAR(run.multiplier(floor, 10), 3.0 * g, bound * g);
  EXPECT_NEAR(run.multiplier(between, 10), 2.0 * g, bound * g);
}

TEST_P(Contacts, GrazedContactChangesNothing) {
  // The top of a parabola touches a ceiling, y = 1/2.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -1.0}});
  const auto ball = scene.add_particle({.mass = 1.0, .velocity = {0.3, 1.0}});
  scene.add(unilateral(holonomic(points(ball), [](auto r) { return 0.5 - r.y(); }), {.restitution = 1.0}));
  const auto run = simulate(scene, options(2.0));
  EXPECT_NEAR(run.position(ball, 10).y(), 0.0, 1e-4);  // of a height known to tolerance the speed is its root
  EXPECT_NEAR(run.energy(10), run.energy(0), bound);
}

TEST_P(Contacts, TouchWithoutForceStaysAsItIs) {
  // Balls in touch, each with a spring of its own place: they swing together, and press nothing.
  for (const double coarse : {1e-6, 1e-8, 1e-10}) {
    Scene<2> scene;
    std::vector<Particle<2>> balls;
    for (int i = 0; i < 5; ++i) {
      const double place = 0.05 * i;
      balls.push_back(scene.add_particle({.mass = 0.5, .position = {place, 0.0}, .velocity = {0.3, 0.0}}));
      scene.add(potential(points(balls.back()),
                          [place](auto r) { return 3.0 * (r.x() - place) * (r.x() - place); }));
      if (i == 0) continue;
      scene.add(unilateral(holonomic(points(balls[balls.size() - 2], balls.back()),
                                     [](auto a, auto b) { return b.x() - a.x() - 0.05; }),
                           {.restitution = 1.0}));
    }
    Options o = options(2.0);
    o.tolerance = coarse;
    const auto run = simulate(scene, o);
    EXPECT_TRUE(run.events().empty()) << coarse;
    EXPECT_NEAR(run.position(balls[4], 10).x(), 0.2 + 0.3 / std::sqrt(12.0) * std::sin(2.0 * std::sqrt(12.0)),
                100.0 * coarse);
  }
}

TEST_P(Contacts, ImpactSpeedIsRightToTheTolerance) {
  // A potential that bends at the floor: the step up to there is short, and its polynomial's derivative would
  // be as inexact as positions over that. 9.81 y + y |y|/2 is fallen through from y = 1.
  Scene<2> scene;
  const auto ball = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}});
  scene.add(potential(points(ball), [](auto r) { return g * r.y() + 0.5 * r.y() * abs(r.y()); }));
  scene.add(unilateral(OnCurve{ball, Plane<2>{}}));
  for (const double fine : {1e-8, 1e-10, 1e-12}) {
    Options o = options(0.6);
    o.tolerance = fine;
    const auto run = simulate(scene, o);
    ASSERT_GE(run.events().size(), 1U);
    EXPECT_NEAR(run.event_sample(0).velocity(ball).y(), -std::sqrt(2.0 * (g + 0.5)), 100.0 * fine);
  }
}

TEST_P(Contacts, ContradictoryContactsAreErrorsByName) {
  const auto scene = [](double height) {
    Scene<2> s("press");
    const auto load = s.add_particle({.mass = 1.0, .position = {0.0, height}}, "load");
    s.add(unilateral(holonomic(points(load), [](auto r) { return r.y(); })), "floor");
    return std::pair(s, load);
  };
  EXPECT_THAT([&] { (void)simulate(scene(-0.5).first, options(1.0)); },
              ThrowsMessage<InconsistentStart>(AllOf(HasSubstr("\"floor\""), HasSubstr("0.5"))));
  auto press = scene(1.0);
  press.first.add(holonomic(points(press.second), [](auto t, auto r) { return r.y() - (1.0 - t * t); }),
                  "drive");
  EXPECT_THAT([&] { (void)simulate(press.first, options(2.0)); },
              ThrowsMessage<IntegrationFailure>(AllOf(HasSubstr("\"floor\""), HasSubstr("t = 1"))));
}

/// Counts its copies.
struct Counted {
  int* copies;
  explicit Counted(int& count) : copies(&count) {}
  Counted(const Counted& other) : copies(other.copies) { ++*copies; }
  Counted& operator=(const Counted&) = delete;
  ~Counted() = default;
};

TEST(Unilateral, RunCopiesItsEquationsOnceHoweverOftenContactsChange) {
  // What an equation has captured may be a large table. Until 0.1 s a ball falls and a block slides; by 1.2 s
  // the ball has bounced and the block has come to rest.
  const auto copies_until = [](double t_end, Stepper stepper) {
    int copies = 0;
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -10.0}});
    const auto ball = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}}, "ball");
    const auto block = scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.0}}, "block");
    const auto height = [table = Counted(copies)](auto r) { return r.y(); };
    const auto slip = [table = Counted(copies)](auto, auto v) { return v.x(); };
    scene.add(unilateral(holonomic(points(ball), height), {.restitution = 0.5}));
    const auto floor = scene.add(holonomic(points(block), height));
    scene.add(coulomb(floor, nonholonomic(points(block), slip), 0.2));
    const int stated = copies;
    const auto run = simulate(scene, {.t_end = t_end, .samples = 2, .stepper = stepper});
    std::set<EventKind> kinds;
    for (const EventRecord& one : run.events()) kinds.insert(one.kind);
    EXPECT_EQ(kinds, t_end < 0.4 ? std::set<EventKind>{} : std::set({EventKind::struck, EventKind::sticks}));
    return copies - stated;
  };
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    EXPECT_EQ(copies_until(0.1, stepper), 3);  // one of each
    EXPECT_EQ(copies_until(1.2, stepper), 3);
  }
}

TEST(Unilateral, RefusesWhatItIsNotFor) {
  Scene<2> scene;
  const auto ball = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}});
  const auto height = [](auto r) { return r.y(); };
  EXPECT_THAT([&] { scene.add(unilateral(holonomic(points(ball), height), {.restitution = 1.5})); },
              ThrowsMessage<InvalidScene>(HasSubstr("restitution = 1.5")));
  const auto floor = scene.add(unilateral(holonomic(points(ball), height)), "floor");
  EXPECT_THAT([&] { (void)equilibrium(scene); }, ThrowsMessage<InvalidScene>(HasSubstr("\"floor\"")));
  EXPECT_THAT([&] { (void)floquet(scene, 1.0); }, ThrowsMessage<InvalidScene>(HasSubstr("\"floor\"")));
  scene.add(
      friction_law(floor, points(ball), [](auto lambda, auto, auto v) { return (-0.1 * lambda * v).eval(); }),
      "rough");
  EXPECT_THAT([&] { (void)simulate(scene, {.t_end = 1.0}); },
              ThrowsMessage<InvalidScene>(AllOf(HasSubstr("\"rough\""), HasSubstr("\"floor\""))));
}

}  // namespace
}  // namespace dalembert::contacts_test
