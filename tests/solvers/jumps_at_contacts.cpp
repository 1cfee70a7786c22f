#include <dalembert/dalembert.h>
#include <dalembert/tests/both_steppers.h>

#include <gtest/gtest.h>

#include <cmath>

/// Forces, drives and floors that jump where something rests, sticks or lies.
namespace dalembert::jumps_at_contacts_test {
namespace {

constexpr double g = 10.0, m = 2.0;

class JumpsAtContacts : public testing::TestWithParam<Stepper> {
 protected:
  /// A block on a one-sided floor.
  Scene<2> scene_;
  Particle<2> block_ = scene_.add_particle({.mass = m}, "block");
  Constraint<1> floor_ = scene_.add(unilateral(OnCurve{block_, Plane<2>{}}), "floor");

  JumpsAtContacts() { scene_.add(UniformGravity<2>{{0.0, -g}}); }
  [[nodiscard]] static Options options(double t_end) {
    return {.t_end = t_end, .samples = 3, .tolerance = tolerance, .stepper = GetParam()};
  }
  /// (x, y) from t = 1 on.
  void add_force(double x, double y) {
    scene_.add(force_law(points(block_), [x, y](auto t, auto, auto) {
      if (t < 1.0) return vec(0.0 * t, 0.0 * t);
      return vec(x + 0.0 * t, y + 0.0 * t);
    }));
  }
  static constexpr double tolerance = 1e-8;
  /// Motions are polynomials, which steps follow to the tolerance; a few dozen of them.
  static constexpr double error = 100.0 * tolerance;
};
INSTANTIATE_TEST_SUITE_P(BothSteppers, JumpsAtContacts, both_steppers, stepper_name);

TEST_P(JumpsAtContacts, LiftWhatRests) {
  add_force(0.0, 30.0);
  const auto run = simulate(scene_, options(2.0));
  ASSERT_EQ(run.events().size(), 1U);
  EXPECT_EQ(run.events()[0].kind, EventKind::opened);
  EXPECT_NEAR(run.events()[0].time, 1.0, error);
  EXPECT_NEAR(run.event_sample(0).multiplier(floor_), m * g, error);
  EXPECT_EQ(run.sample_after(0).multiplier(floor_), 0.0);
  EXPECT_NEAR(run.multiplier(floor_, 1), m * g, error);  // at t = 1, before it
  EXPECT_NEAR(run.position(block_, 2).y(), (30.0 / m - g) / 2.0, error);
}

TEST_P(JumpsAtContacts, AreReadBetweenSamplesAndKeptInALedger) {
  add_force(0.0, 30.0);
  Options own = options(2.0);
  own.dense = own.ledger = true;  // every step is audited
  const auto run = simulate(scene_, own);
  EXPECT_NEAR(run.at({0.5}).multiplier(floor_, 0), m * g, error);
  EXPECT_NEAR(run.at({1.5}).position(block_, 0).y(), (30.0 / m - g) / 8.0, error);
}

TEST_P(JumpsAtContacts, PressWhatRests) {
  add_force(0.0, -30.0);
  const auto run = simulate(scene_, options(2.0));
  EXPECT_TRUE(run.events().empty());
  EXPECT_NEAR(run.multiplier(floor_, 0), m * g, error);
  EXPECT_NEAR(run.multiplier(floor_, 2), m * g + 30.0, error);
}

TEST_P(JumpsAtContacts, LetSlideWhatSticks) {
  constexpr double mu = 0.3, mu_static = 0.5, F = 14.0;
  const auto friction = scene_.add(coulomb(floor_, Slip{block_, Plane<2>{}}, mu, mu_static));
  add_force(F, 0.0);
  const auto run = simulate(scene_, options(2.0));
  ASSERT_EQ(run.events().size(), 1U);
  EXPECT_NEAR(run.events()[0].time, 1.0, error);
  EXPECT_NEAR(run.event_sample(0).multiplier(friction), 0.0, error);
  EXPECT_NEAR(run.sample_after(0).multiplier(friction), -mu * m * g, error);
  EXPECT_NEAR(run.position(block_, 2).x(), (F / m - mu * g) / 2.0, error);
}

// What is held by friction is held by more of it.
TEST_P(JumpsAtContacts, LoadWhatSticks) {
  const auto friction = scene_.add(coulomb(floor_, Slip{block_, Plane<2>{}}, 0.3, 0.5));
  add_force(9.0, 0.0);
  const auto run = simulate(scene_, options(2.0));
  EXPECT_TRUE(run.events().empty());
  EXPECT_NEAR(run.multiplier(friction, 0), 0.0, error);
  EXPECT_NEAR(run.multiplier(friction, 2), -9.0, error);
}

// A belt that reverses at once: no friction is an impulse, so the block slides, and sticks after 2 / (mu g).
TEST_P(JumpsAtContacts, LetSlideOnABeltThatReverses) {
  constexpr double mu = 0.2;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto block = scene.add_particle({.mass = m, .velocity = {1.0, 0.0}});
  const auto floor = scene.add(OnCurve{block, Plane<2>{}});
  const auto belt = [](auto t, auto, auto v) {
    if (t < 1.0) return v.x() - 1.0;
    return v.x() + 1.0;
  };
  scene.add(coulomb(floor, nonholonomic(points(block), belt), mu));
  const auto run = simulate(scene, options(3.0));
  ASSERT_EQ(run.events().size(), 2U);
  EXPECT_EQ(run.events()[0].kind, EventKind::slides);
  EXPECT_NEAR(run.events()[0].time, 1.0, error);
  EXPECT_EQ(run.events()[1].kind, EventKind::sticks);
  EXPECT_NEAR(run.events()[1].time, 1.0 + 2.0 / (mu * g), error);
  EXPECT_NEAR(run.velocity(block, 2).x(), -1.0, error);
}

/// A beam on three props, whose shares of its weight nothing determines.
struct Beam {
  Scene<2> scene;
  RigidBody<2> body;

  Beam(double mu, double x, double y) {
    scene.add(UniformGravity<2>{{0.0, -g}});
    body = add_body(scene, BodyState<2>{.mass = 1.0, .inertia = 2.0}, "beam");
    for (const double at : {-1.0, 0.0, 1.0}) {
      const auto foot = body.point_at({at, 0.0});
      const auto prop = scene.add(unilateral(OnCurve{foot, Plane<2>{}}));
      if (mu > 0.0) scene.add(coulomb(prop, Slip{foot, Plane<2>{}}, mu));
    }
    scene.add(force_law(points(body.point({0.0, 0.0})), [x, y](auto t, auto, auto) {
      if (t < 1.0) return vec(0.0 * t, 0.0 * t);
      return vec(x + 0.0 * t, y + 0.0 * t);
    }));
  }
  [[nodiscard]] Vec<2> centre(const Trajectory<2>& run) const {
    return run.position(body.point_at({0.0, 0.0}), run.size() - 1);
  }
};

TEST_P(JumpsAtContacts, LiftABeamOffAllItsProps) {
  const Beam beam(0.0, 0.0, 12.0);
  const auto run = simulate(beam.scene, options(2.0));
  EXPECT_EQ(run.events().size(), 3U);
  EXPECT_LT((beam.centre(run) - vec(0.0, (12.0 - g) / 2.0)).norm(), error);
}

TEST_P(JumpsAtContacts, LetABeamSlideOnAllItsProps) {
  const Beam beam(0.3, 5.0, 0.0);
  const auto run = simulate(beam.scene, options(2.0));
  EXPECT_EQ(run.events().size(), 3U);
  EXPECT_LT((beam.centre(run) - vec((5.0 - 0.3 * g) / 2.0, 0.0)).norm(), error);
}

/// A floor that moves with this velocity from t = 1 on, and the block on it.
struct Lift {
  Scene<2> scene;
  Particle<2> block;

  Lift(double speed, double restitution) {
    scene.add(UniformGravity<2>{{0.0, -g}});
    block = scene.add_particle({.mass = m}, "block");
    const auto height = [speed](auto t, auto r) {
      if (t < 1.0) return r.y() + 0.0 * t;
      return r.y() - speed * (t - 1.0);
    };
    scene.add(unilateral(holonomic(points(block), height), {.restitution = restitution}), "lift");
  }
};

// It falls freely until the floor, at constant speed, is reached again: g s/2 = speed.
TEST_P(JumpsAtContacts, DropTheFloor) {
  const Lift lift(-2.0, 0.0);
  const auto run = simulate(lift.scene, options(1.2));
  ASSERT_EQ(run.events().size(), 1U);
  EXPECT_EQ(run.events()[0].kind, EventKind::opened);
  EXPECT_NEAR(run.events()[0].time, 1.0, error);
  EXPECT_NEAR(run.position(lift.block, 2).y(), -0.5 * g * 0.04, error);
}

// The floor strikes the block, which leaves it e times as fast.
TEST_P(JumpsAtContacts, StrikeWhatRests) {
  const Lift lift(2.0, 0.5);
  const auto run = simulate(lift.scene, options(1.1));
  ASSERT_FALSE(run.events().empty());
  EXPECT_EQ(run.events()[0].kind, EventKind::struck);
  EXPECT_NEAR(run.events()[0].time, 1.0, error);
  EXPECT_NEAR(run.velocity(lift.block, 2).y(), 3.0 - g * 0.1, error);
}

}  // namespace
}  // namespace dalembert::jumps_at_contacts_test
