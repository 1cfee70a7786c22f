#include "../both_steppers.h"
#include <dalembert/dalembert.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

/// Loads that several one-sided contacts share.
namespace dalembert::contact_shares_test {
namespace {

constexpr double g = 10.0;
/// What a few solves of a few unknowns leave of forces up to 100.
constexpr double rounding = 1e-11;

class ContactShares : public testing::TestWithParam<StepperAt> {
 protected:
  [[nodiscard]] static Options options(double t_end, int samples) {
    const auto [stepper, tolerance] = GetParam();
    return {.t_end = t_end, .samples = samples, .tolerance = tolerance, .stepper = stepper};
  }
};
INSTANTIATE_TEST_SUITE_P(BothSteppers, ContactShares, both_steppers_at({1e-6, 1e-9}), tolerance_name);

/// A beam on three props at -1, 0 and 1.
struct Beam {
  Scene<2> scene{"beam"};
  RigidBody<2> body;
  std::vector<Constraint<1>> props;

  Beam(double mass, double centre) {
    scene.add(UniformGravity<2>{{0.0, -g}});
    body = add_body(scene, BodyState<2>{.mass = mass, .inertia = 2.0, .centre = {centre, 0.0}}, "beam");
    for (const double x : {-1.0, 0.0, 1.0})
      props.push_back(scene.add(unilateral(OnCurve{body.point_at({x, 0.0}), Plane<2>{}})));
  }
  /// Of forces `half`(t) up at -1 and down at 1: 2 half clockwise.
  void add_couple(auto half) {
    scene.add(force_law(points(body.point({-1.0, 0.0}), body.point({1.0, 0.0})),
                        [half](auto t, auto r, auto, auto, auto) {
                          const auto f = half(t) + 0.0 * r.x();
                          return std::make_tuple(vec(0.0 * f, f), vec(0.0 * f, -f));
                        }));
  }
};

// N = (n, 6 - 2 n, 54 + n) for any n between 0 and 3; the least sum of squares is at n = 0.
TEST_P(ContactShares, BeamOnThreePropsIsPushedByAll) {
  const Beam beam(6.0, 0.9);
  const auto run = simulate(beam.scene, options(1.0, 3));
  const double by_hand[] = {0.0, 6.0, 54.0};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(run.multiplier(beam.props[k], 2), by_hand[k], rounding);
    EXPECT_GE(run.multiplier(beam.props[k], 2), 0.0);
    EXPECT_FALSE(run.is_unique(beam.props[k], 2));
  }
  EXPECT_TRUE(run.events().empty());
}

/// A table of 10 kg, its centre at (0.6, 0.65), on four legs at (+-1, +-1): one-sided, and rough if mu > 0.
struct Table {
  Scene<3> scene{"table"};
  RigidBody<3> body;
  std::vector<Constraint<1>> legs;
  std::vector<Constraint<2>> frictions;

  /// The feet are at height 0, the centre is at 1/2.
  explicit Table(double mu) {
    scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
    const BodyState<3> state{.mass = 10.0, .inertia = {2.0, 2.0, 3.0}, .centre = {0.6, 0.65, 0.5}};
    body = add_body(scene, state, "table");
    for (const double x : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0}) {
        const auto foot = body.point_at({x, y, 0.0});
        legs.push_back(scene.add(unilateral(OnSurface{foot, Plane<3>{}})));
        if (mu > 0.0) frictions.push_back(scene.add(coulomb(legs.back(), Slip{foot, Plane<3>{}}, mu)));
      }
  }
};

// N = (17.5 - n, 2.5 + n, n, 80 - n) for any n between 0 and 17.5; the least sum of squares is at n = 17.5.
TEST_P(ContactShares, TableOnFourLegsIsPushedByAll) {
  const Table table(0.0);
  const auto run = simulate(table.scene, options(1.0, 3));
  const double by_hand[] = {0.0, 20.0, 17.5, 62.5};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(run.multiplier(table.legs[k], 2), by_hand[k], rounding);
    EXPECT_FALSE(run.is_unique(table.legs[k], 2));
  }
}

// The same on rough legs, pushed along the floor by less than 0.3 times its weight of 100: friction in
// proportion to the normal forces holds it, of 28/30 of the bound at each leg; where nothing presses there is
// none.
TEST_P(ContactShares, RoughTableIsHeld) {
  Table table(0.3);
  table.scene.add(PointGravity{table.body.point_at({0.6, 0.65, 0.0}), 1.0, Vec<3>(28.0, 0.0, 0.0)});
  const auto run = simulate(table.scene, options(1.0, 3));
  EXPECT_TRUE(run.events().empty());
  EXPECT_NEAR(run.position(table.body.centre(), 2).x(), 0.6, rounding);
  const double by_hand[] = {0.0, 20.0, 17.5, 62.5};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(run.multiplier(table.legs[k], 2), by_hand[k], rounding);
    EXPECT_FALSE(run.is_unique(table.legs[k], 2));
    EXPECT_NEAR(run.multiplier(table.frictions[k], 2)[0], -0.28 * by_hand[k], rounding);
    EXPECT_NEAR(run.multiplier(table.frictions[k], 2)[1], 0.0, rounding);
  }
}

// Pulled along x by P = 20 sin t at the height of its centre, so that N1 + N2 = 20 - P/4: friction holds it.
TEST_P(ContactShares, RoughTableIsHeldUnderAVaryingPull) {
  Table table(0.3);
  table.scene.add(force_law(points(table.body.centre()), [](auto t, auto r, auto) {
    const auto zero = 0.0 * r.x();
    return std::make_tuple(vec(20.0 * sin(t) + zero, zero, zero));
  }));
  const auto run = simulate(table.scene, options(2.0, 21));
  EXPECT_TRUE(run.events().empty());
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double P = 20.0 * std::sin(run.times()[i]);
    const auto N = [&](std::size_t k) { return run.multiplier(table.legs[k], i); };
    const auto T = [&](std::size_t k) { return run.multiplier(table.frictions[k], i); };
    EXPECT_NEAR(N(0) + N(1) + N(2) + N(3), 10.0 * g, rounding);
    EXPECT_NEAR(N(0) + N(1), 20.0 - P / 4.0, rounding);
    EXPECT_NEAR(T(0)[0] + T(1)[0] + T(2)[0] + T(3)[0], -P, rounding);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_LE(T(k).norm(), 0.3 * N(k) + rounding);
  }
}

/// A ladder of length 2 and 1 kg at 65 degrees on a rough floor, at a rough wall; somebody of 3 kg has
/// climbed the part t of it at the time t.
struct Ladder {
  static constexpr double angle = 65.0 * std::numbers::pi / 180.0, climber = 30.0;
  Scene<2> scene{"ladder"};
  Constraint<1> foot, top;

  Ladder(double mu_floor, double mu_wall) {
    const Vec<2> end(2.0 * std::cos(angle), 2.0 * std::sin(angle));
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto body =
        add_body(scene, BodyState<2>{.mass = 1.0, .inertia = 1.0 / 3.0, .centre = 0.5 * end}, "ladder");
    const auto low = body.point_at({0.0, 0.0}), high = body.point_at(end);
    const Plane<2> wall{.point = end, .normal = {-1.0, 0.0}};
    foot = scene.add(unilateral(OnCurve{low, Plane<2>{}}));
    top = scene.add(unilateral(OnCurve{high, wall}));
    scene.add(coulomb(foot, Slip{low, Plane<2>{}}, mu_floor));
    scene.add(coulomb(top, Slip{high, wall}, mu_wall));
    scene.add(force_law(points(low, high), [](auto t, auto r, auto, auto, auto) {
      const auto zero = 0.0 * r.x();
      return std::make_tuple(vec(zero, zero - climber * (1.0 - t)), vec(zero, zero - climber * t));
    }));
  }
};

// Both ends slide as soon as both are at their bounds: N_floor + mu_wall N_wall = 40, N_wall = mu_floor
// N_floor, and about the foot N_wall (tan + mu_wall) = 10/2 + 30 s. By the forces of least norm the wall's
// friction would exceed its bound from the start.
TEST_P(ContactShares, LadderSlidesWhereBothEndsReachTheirBounds) {
  for (const double mu_floor : {0.3, 0.32})
    for (const double mu_wall : {0.2, 0.4}) {
      const double N_wall = mu_floor * 40.0 / (1.0 + mu_floor * mu_wall);
      const double slides = (N_wall * (std::tan(Ladder::angle) + mu_wall) - 5.0) / Ladder::climber;
      const Ladder ladder(mu_floor, mu_wall);
      Options own = options(slides + 0.01, 2);
      own.times = {0.0, 0.5 * slides, slides - 1e-5, slides + 0.01};
      const auto run = simulate(ladder.scene, own);
      ASSERT_EQ(run.events().size(), 2u);
      for (const EventRecord& one : run.events()) {
        EXPECT_EQ(one.kind, EventKind::slides);
        EXPECT_NEAR(one.time, slides, rounding);
      }
      for (std::size_t i = 0; i < 3; ++i) EXPECT_FALSE(run.is_unique(ladder.foot, i));
      EXPECT_TRUE(run.is_unique(ladder.foot, 3));
      // N_wall changes by some 10 in the time of 1, its share with it.
      EXPECT_NEAR(run.multiplier(ladder.top, 2), N_wall, 100.0 * 1e-5);
    }
}

// A ladder of weight 40 between a floor and a wall that hold both ways, its foot pulled away by 5 t. Both
// ends slide as soon as both are at their bounds: N_floor + mu_wall N_wall = 40, about the foot N_wall (tan +
// mu_wall) = 20, and 5 t = mu_floor N_floor - N_wall. By the forces of least norm the wall pulls.
TEST_P(ContactShares, LadderSlidesAtTheSameTimeWhereFloorAndWallHoldBothWays) {
  constexpr double mu_floor = 0.4, mu_wall = 0.3, angle = 1.1;
  const double N_wall = 20.0 / (std::tan(angle) + mu_wall), N_floor = 40.0 - mu_wall * N_wall;
  const double slides = (mu_floor * N_floor - N_wall) / 5.0;
  const Vec<2> low(3.0 * std::cos(angle), 0.0), high(0.0, 3.0 * std::sin(angle));
  Scene<2> scene("ladder");
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto body =
      add_body(scene, BodyState<2>{.mass = 4.0, .inertia = 3.0, .centre = 0.5 * (low + high)}, "ladder");
  const auto foot = body.point_at(low), top = body.point_at(high);
  const Plane<2> wall{.normal = {1.0, 0.0}};
  const auto floors = scene.add(OnCurve{foot, Plane<2>{}}), walls = scene.add(OnCurve{top, wall});
  const auto on_floor = scene.add(coulomb(floors, Slip{foot, Plane<2>{}}, mu_floor));
  const auto on_wall = scene.add(coulomb(walls, Slip{top, wall}, mu_wall));
  scene.add(
      force_law(points(foot), [](auto t, auto r, auto) { return vec(5.0 * t + 0.0 * r.x(), 0.0 * r.x()); }));
  Options own = options(slides + 0.01, 2);
  own.times = {0.0, 1e-9, 0.5 * slides, 0.9 * slides, 0.96 * slides, slides - 1e-5};
  const auto run = simulate(scene, own);
  ASSERT_EQ(run.events().size(), 2u);
  for (const EventRecord& one : run.events()) {
    EXPECT_EQ(one.kind, EventKind::slides);
    EXPECT_NEAR(one.time, slides, 10.0 * rounding);  // of a force of 15, at a rate of 5
  }
  for (std::size_t i = 0; i < own.times.size(); ++i) {
    EXPECT_FALSE(run.is_unique(walls, i));
    EXPECT_LE(std::abs(run.multiplier(on_floor, i)), mu_floor * std::abs(run.multiplier(floors, i)));
    EXPECT_LE(std::abs(run.multiplier(on_wall, i)), mu_wall * std::abs(run.multiplier(walls, i)) + rounding);
  }
  EXPECT_NEAR(run.multiplier(on_wall, 0), run.multiplier(on_wall, 1), 1e-6);  // at first they are continuous
}

// The same ladder twice, and a block that shares nothing, not coupled: neither knows of the other, and so
// their shares do not. (Where the largest part of both was made small together, one slid early.)
TEST_P(ContactShares, LaddersSlideAsIfTheyWereAlone) {
  constexpr double mu_floor = 0.4, mu_wall = 0.3, angle = 1.1;
  const double N_wall = 20.0 / (std::tan(angle) + mu_wall), N_floor = 40.0 - mu_wall * N_wall;
  const double slides = (mu_floor * N_floor - N_wall) / 5.0;
  Scene<2> scene("ladders");
  scene.add(UniformGravity<2>{{0.0, -g}});
  for (const double x : {0.0, 10.0}) {
    const Vec<2> low(x + 3.0 * std::cos(angle), 0.0), high(x, 3.0 * std::sin(angle));
    const auto body = add_body(scene, BodyState<2>{.mass = 4.0, .inertia = 3.0, .centre = 0.5 * (low + high)},
                               "ladder " + std::to_string(x));
    const auto foot = body.point_at(low), top = body.point_at(high);
    const Plane<2> wall{.point = high, .normal = {1.0, 0.0}};
    const auto floors = scene.add(OnCurve{foot, Plane<2>{}}), walls = scene.add(OnCurve{top, wall});
    scene.add(coulomb(floors, Slip{foot, Plane<2>{}}, mu_floor));
    scene.add(coulomb(walls, Slip{top, wall}, mu_wall));
    scene.add(force_law(points(foot),
                        [](auto t, auto r, auto) { return vec(5.0 * t + 0.0 * r.x(), 0.0 * r.x()); }));
  }
  const auto block = scene.add_particle({.mass = 1.0, .position = {20.0, 0.0}});
  const auto floor = scene.add(unilateral(OnCurve{block, Plane<2>{}}));
  scene.add(coulomb(floor, Slip{block, Plane<2>{}}, mu_floor));
  const auto run = simulate(scene, options(slides + 0.01, 2));
  ASSERT_EQ(run.events().size(), 4u);
  for (const EventRecord& one : run.events()) EXPECT_NEAR(one.time, slides, 100.0 * rounding);  // at x = 10
}

/// A brake on a disc, pressed by the middle one of three feet of a body of weight 10: it holds as long as
/// that foot can press enough, up to all of the weight.
TEST_P(ContactShares, BrakeHoldsByAllThatMayPressIt) {
  Scene<2> scene("brake");
  scene.add(UniformGravity<2>{{0.0, -10.0}});
  const auto body = add_body(scene, BodyState<2>{.mass = 1.0, .inertia = 1.0, .centre = {0.0, 1.0}}, "body");
  const auto disc = scene.add_rotor({.inertia = 1.0}, "disc");
  scene.add(OnCurve{body.centre(), Plane<2>{.normal = {1.0, 0.0}}});
  for (const double x : {-1.0, 0.0, 1.0}) {
    const auto foot = scene.add(unilateral(OnCurve{body.point({x, -1.0}), Plane<2>{}}));
    if (x == 0.0)
      scene.add(coulomb(foot, nonholonomic(points(disc), [](auto, auto w) { return 1.0 * w[0]; }), 0.5));
  }
  scene.add(force_law(points(disc), [](auto t, auto angle, auto) { return vec(t + 0.0 * angle[0]); }));
  const auto run = simulate(scene, options(4.99, 2));  // to 0.5 x 10
  EXPECT_TRUE(run.events().empty());
  EXPECT_EQ(run.angular_velocity(disc, 1), 0.0);
}

/// A body of weight 10 on three legs at different heights, pulled at its centre by 10 t.
struct Stand {
  Scene<2> scene{"stand"};
  std::vector<Constraint<1>> legs, frictions;

  Stand() {
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto body = add_body(scene, BodyState<2>{.mass = 1.0, .inertia = 0.4}, "stand");
    const Vec<2> feet[] = {{-1.0, -1.0}, {0.0, -0.5}, {1.0, -1.0}};
    const double mu[] = {0.2, 0.4, 0.2};
    for (std::size_t k = 0; k < 3; ++k) {
      const Plane<2> floor{.point = feet[k]};
      const auto foot = body.point_at(feet[k]);
      legs.push_back(scene.add(unilateral(OnCurve{foot, floor})));
      frictions.push_back(scene.add(coulomb(legs.back(), Slip{foot, floor}, mu[k])));
    }
    scene.add(force_law(points(body.centre()), [](auto t, auto r, auto) {
      const auto zero = 0.0 * r.x();
      return std::make_tuple(vec(10.0 * t + zero, zero));
    }));
  }
};

// With all friction at its bounds, sum (x - h mu) N = 0 and P = sum mu N: -1.2 N_1 - 0.2 N_2 + 0.8 N_3 = 0
// and N_1 + N_2 + N_3 = 10 allow at most P = 3.6, by N = (0, 8, 2). By the normal forces of least norm it
// would be less. What slides then depends on the shares.
TEST_P(ContactShares, LegsAtDifferentHeightsBearWhatTheyCan) {
  const Stand stand;
  const auto run = simulate(stand.scene, options(0.3599, 31));
  EXPECT_TRUE(run.events().empty());
  const double mu[] = {0.2, 0.4, 0.2}, height[] = {1.0, 0.5, 1.0}, place[] = {-1.0, 0.0, 1.0};
  for (std::size_t i = 0; i < run.size(); ++i) {
    double push = 0.0, pull = 10.0 * run.times()[i], moment = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double N = run.multiplier(stand.legs[k], i), T = run.multiplier(stand.frictions[k], i);
      EXPECT_GE(N, 0.0);
      EXPECT_LE(std::abs(T), mu[k] * N + rounding);
      push += N;
      pull += T;
      moment += place[k] * N + height[k] * T;
    }
    EXPECT_NEAR(push, 10.0, rounding);
    EXPECT_NEAR(pull, 0.0, rounding);
    EXPECT_NEAR(moment, 0.0, rounding);
  }
  try {
    (void)simulate(stand.scene, options(0.4, 2));
    FAIL() << "slides by shares that nothing determines";
  } catch (const IntegrationFailure& failure) {
    EXPECT_NEAR(failure.time(), 0.36, rounding);
    EXPECT_THAT(failure.what(), testing::HasSubstr("which the motion does not determine"));
  }
}

// It slides on all four legs, each of which shares the load in a way that the motion does not determine, and
// rests. About the centre, 1/2 above the floor, friction of 30 has the moment 15 against (0.8, 0.6): the
// sums of N x and N y are 12 and 9, by least norm 3 and 9/4 more or less at each leg.
TEST_P(ContactShares, TableSlidesStraightWhateverItsShares) {
  constexpr double mu = 0.3, speed = 1.5, rests = speed / (mu * g);
  Scene<3> scene("table");
  scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
  const auto body = add_body(scene,
                             BodyState<3>{.mass = 10.0,
                                          .inertia = {2.0, 2.0, 3.0},
                                          .centre = {0.0, 0.0, 0.5},
                                          .velocity = {0.8 * speed, 0.6 * speed, 0.0}},
                             "table");
  std::vector<Constraint<1>> legs;
  std::vector<Constraint<2>> frictions;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) {
      const auto foot = body.point_at({x, y, 0.0});
      legs.push_back(scene.add(unilateral(OnSurface{foot, Plane<3>{}})));
      frictions.push_back(scene.add(coulomb(legs.back(), Slip{foot, Plane<3>{}}, mu, 1.2 * mu)));
    }
  const double tolerance = GetParam().tolerance;
  const auto run = simulate(scene, options(2.0 * rests, 5));
  ASSERT_EQ(run.events().size(), 4u);
  for (const EventRecord& one : run.events()) {
    EXPECT_EQ(one.kind, EventKind::sticks);
    EXPECT_NEAR(one.time, rests, tolerance);
  }
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = std::min(run.times()[i], rests);
    EXPECT_NEAR(run.position(body.centre(), i).x(), 0.8 * (speed * t - mu * g * t * t / 2.0), tolerance);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const double N = 25.0 + (k / 2 == 0 ? -3.0 : 3.0) + (k % 2 == 0 ? -2.25 : 2.25);
    EXPECT_NEAR(run.multiplier(legs[k], 1), N, std::sqrt(tolerance));
    EXPECT_FALSE(run.is_unique(legs[k], 1));
    EXPECT_NEAR(run.multiplier(frictions[k], 1)[0], -0.8 * mu * N, std::sqrt(tolerance));
    EXPECT_NEAR(run.multiplier(legs[k], 4), 25.0, rounding);
    EXPECT_NEAR(run.multiplier(frictions[k], 4).norm(), 0.0, rounding);
  }
}

// A couple about the vertical turns it, its centre in the middle, when it reaches mu sum N r = 0.3 * 100 *
// sqrt(2), whatever the shares; how it turns then depends on them.
TEST_P(ContactShares, TableHoldsACoupleUpToItsLimit) {
  Scene<3> scene("table");
  scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
  const auto body = add_body(
      scene, BodyState<3>{.mass = 10.0, .inertia = {2.0, 2.0, 3.0}, .centre = {0.0, 0.0, 0.5}}, "table");
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) {
      const auto foot = body.point_at({x, y, 0.0});
      const auto leg = scene.add(unilateral(OnSurface{foot, Plane<3>{}}));
      scene.add(coulomb(leg, Slip{foot, Plane<3>{}}, 0.3));
    }
  scene.add(force_law(points(body.point_at({1.0, 0.0, 0.5}), body.point_at({-1.0, 0.0, 0.5})),
                      [](auto t, auto r, auto, auto, auto) {
                        const auto zero = 0.0 * r.x(), f = 25.0 * t + zero;
                        return std::make_tuple(vec(zero, f, zero), vec(zero, -f, zero));
                      }));
  const double turns = 0.3 * 100.0 * std::numbers::sqrt2 / 50.0;
  const auto held = simulate(scene, options(turns - 1e-6, 2));
  EXPECT_TRUE(held.events().empty());
  try {
    (void)simulate(scene, options(1.0, 2));
    FAIL() << "turns by shares that nothing determines";
  } catch (const IntegrationFailure& failure) {
    EXPECT_NEAR(failure.time(), turns, rounding);
  }
}

/// A bead of weight 10 between two rough walls, which touches both; pressed against the one by P.
struct Slot {
  Scene<2> scene{"slot"};
  std::vector<Constraint<1>> walls;

  explicit Slot(double P) {
    scene.add(UniformGravity<2>{{P, -g}});
    const auto bead = scene.add_particle({.mass = 1.0}, "bead");
    for (const double side : {-1.0, 1.0}) {
      const Plane<2> wall{.normal = {side, 0.0}};
      walls.push_back(scene.add(unilateral(OnCurve{bead, wall})));
      scene.add(coulomb(walls.back(), Slip{bead, wall}, 0.6));
    }
  }
};

// That the walls press each other through the bead would hold it under any load. Only the wall that the load
// presses does; where that is not enough, how it slides depends on what nothing determines.
TEST_P(ContactShares, WallsOfASlotDoNotPressEachOther) {
  const Slot held(20.0);
  const auto run = simulate(held.scene, options(1.0, 2));
  EXPECT_TRUE(run.events().empty());
  EXPECT_NEAR(run.multiplier(held.walls[0], 1), 20.0, rounding);
  EXPECT_EQ(run.multiplier(held.walls[1], 1), 0.0);
  EXPECT_THROW((void)simulate(Slot(10.0).scene, options(1.0, 2)), Error);
}

// Only the middle prop is rough: a push of 25 along the floor needs 50 of the weight of 60 there, of which
// least norm gives 20.
TEST_P(ContactShares, RoughPropTakesTheLoadThatItNeeds) {
  constexpr double mu = 0.5, push = 25.0;
  Beam beam(6.0, 0.0);
  const auto middle = beam.body.point_at({0.0, 0.0});
  const auto friction = beam.scene.add(coulomb(beam.props[1], Slip{middle, Plane<2>{}}, mu));
  beam.scene.add(PointGravity{middle, 1.0, Vec<2>(push, 0.0)});
  const auto run = simulate(beam.scene, options(1.0, 2));
  EXPECT_TRUE(run.events().empty());
  EXPECT_NEAR(run.multiplier(friction, 1), -push, rounding);
  EXPECT_GE(run.multiplier(beam.props[1], 1), push / mu);
  double sum = 0.0;
  for (const auto& prop : beam.props) sum += run.multiplier(prop, 1);
  EXPECT_NEAR(sum, 60.0, rounding);
  EXPECT_NEAR(run.multiplier(beam.props[0], 1), run.multiplier(beam.props[2], 1), rounding);
}

// Only one of two blocks that a rod joins presses the floor: that one's friction balances the push of 2.
TEST_P(ContactShares, BlockThatPressesBearsTheRod) {
  Scene<2> scene("blocks");
  std::vector<Constraint<1>> frictions;
  std::vector<Particle<2>> blocks;
  for (const double x : {0.0, 1.0}) {
    const auto block = scene.add_particle({.mass = 1.0, .position = {x, 0.0}});
    const auto floor = scene.add(unilateral(OnCurve{block, Plane<2>{}}));
    frictions.push_back(scene.add(coulomb(floor, Slip{block, Plane<2>{}}, 0.3)));
    blocks.push_back(block);
  }
  scene.add(Distance{blocks[0], blocks[1], 1.0});
  scene.add(PointGravity{blocks[0], 1.0, Vec<2>(2.0, -g)});
  const auto run = simulate(scene, options(1.0, 3));
  EXPECT_NEAR(run.multiplier(frictions[0], 2), -2.0, rounding);
  EXPECT_NEAR(run.multiplier(frictions[1], 2), 0.0, rounding);
  EXPECT_NEAR(run.position(blocks[1], 2).x(), 1.0, rounding);
}

// Beside a bead that leaves a ball at cos = 2/3: where the one contact ceases to push, the beam's shares
// stay.
TEST_P(ContactShares, StayWhereAnotherContactOpens) {
  Beam beam(6.0, 0.9);
  const auto bead = beam.scene.add_particle({.mass = 1.0, .position = {10.0 + std::sin(0.1), std::cos(0.1)}});
  beam.scene.add(unilateral(OnCurve{bead, Sphere<2>{{10.0, 0.0}, 1.0}}), "ball");
  const auto run = simulate(beam.scene, options(1.2, 121));
  ASSERT_EQ(run.events().size(), 1U);
  EXPECT_EQ(run.events().front().kind, EventKind::opened);
  for (std::size_t i = 0; i < run.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(run.multiplier(beam.props[k], i), (std::array{0.0, 6.0, 54.0})[k], rounding);
}

// N1 + N2 + N3 = 10, N3 - N1 = 8 sin 3t: a couple of 10 would tip it.
TEST_P(ContactShares, SharesBalanceAVaryingCouple) {
  Beam beam(1.0, 0.0);
  beam.add_couple([](auto t) { return 4.0 * sin(3.0 * t); });
  const auto run = simulate(beam.scene, options(4.0, 41));
  EXPECT_TRUE(run.events().empty());
  for (std::size_t i = 0; i < run.size(); ++i) {
    const auto N = [&](std::size_t k) { return run.multiplier(beam.props[k], i); };
    EXPECT_GE(std::min({N(0), N(1), N(2)}), 0.0);
    EXPECT_NEAR(N(0) + N(1) + N(2), g, rounding);
    EXPECT_NEAR(N(2) - N(0), 8.0 * std::sin(3.0 * run.times()[i]), rounding);
  }
}

// It tips over the last prop when the couple 20 t passes 10, at t = 1/2; about that prop the moment of
// inertia is 3, and 3 omega' = -(20 t - 10) for small angles. The contacts that open say so once.
TEST_P(ContactShares, ShareEndsWhereTheBeamTips) {
  Beam beam(1.0, 0.0);
  beam.add_couple([](auto t) { return 10.0 * t; });
  for (const double tolerance : {GetParam().tolerance, 1e-12}) {
    Options own = options(0.6, 3);
    own.tolerance = tolerance;
    const auto run = simulate(beam.scene, own);
    ASSERT_EQ(run.events().size(), 2U);
    for (const auto& event : run.events()) {
      EXPECT_EQ(event.kind, EventKind::opened);
      EXPECT_NEAR(event.time, 0.5, 10.0 * tolerance);
    }
    // The angle stays below 1.2e-3, of which the equation neglects the square.
    EXPECT_NEAR(angular_velocity(run.sample(2), beam.body), -10.0 * 0.1 * 0.1 / 3.0, 1e-6);
  }
}

// A bead slides along a floor without restitution and bounces off a wall that leans over it, so that both are
// struck at once. Along the floor it falls with a: impacts follow in 2 e^k v/a, v^2 = 2 a d, and end after
// 2 v e/(a (1 - e)). The floor is at rest all the while, which must not end the bounces.
TEST_P(ContactShares, WallAboveAFloorBounces) {
  constexpr double a = 4.0, d = 0.5, e = 0.3;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{a, -g}});
  const auto bead = scene.add_particle({.mass = 1.0});
  scene.add(unilateral(OnCurve{bead, Plane<2>{}}, {.restitution = 0.0}), "floor");
  scene.add(unilateral(OnCurve{bead, Plane<2>{{d, 0.0}, {-0.8, -0.6}}}, {.restitution = e}), "wall");
  const double v = std::sqrt(2.0 * a * d), first = v / a;
  double flight = 2.0 * e * v / a, begins = first;
  for (int k = 1; k < 5; ++k) {
    begins += flight;
    flight *= e;
  }
  Options own = options(2.0, 2);
  own.times = {begins + flight / 2.0, 2.0};  // the top of the fifth flight
  const auto run = simulate(scene, own);
  const double height = a * flight * flight / 8.0, error = 1000.0 * GetParam().tolerance;
  EXPECT_NEAR(d - run.position(bead, 0).x(), height, error * d);
  EXPECT_NEAR(run.position(bead, 1).x(), d, error * d);
  EXPECT_EQ(run.events().back().kind, EventKind::rested);
  EXPECT_NEAR(run.events().back().time, first + 2.0 * v * e / (a * (1.0 - e)), error * first);
}

}  // namespace
}  // namespace dalembert::contact_shares_test
