#include <dalembert/models/bouncing_ball.h>
#include <dalembert/models/bouncing_pendulum.h>
#include <dalembert/models/event_model.h>
#include <dalembert/models/newtons_cradle.h>
#include <dalembert/models/particle_off_sphere.h>
#include <dalembert/models/rocking_block.h>
#include <dalembert/models/slack_string.h>
#include <dalembert/models/sliding_ladder.h>
#include <dalembert/tests/both_steppers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace dalembert::models::events_test {
namespace {

constexpr double tolerance = 1e-10;
/// Of positions, velocities and impulses relative to the system's own, as of times (event_times.h).
constexpr double bound = 100.0 * tolerance;
/// What solving for an impulse, with a few constraints, leaves of round-off: some tens of operations.
constexpr double solved = 100.0 * std::numeric_limits<double>::epsilon();

class ModelsWithEvents : public testing::TestWithParam<Stepper> {
 protected:
  [[nodiscard]] static Options options(double t_end, int samples = 2) {
    return {.t_end = t_end, .samples = samples, .tolerance = tolerance, .stepper = GetParam()};
  }
};
INSTANTIATE_TEST_SUITE_P(Steppers, ModelsWithEvents, both_steppers, stepper_name);

/// Of all that happened the k-th impact of a contact.
template <int D>
std::size_t struck(const Trajectory<D>& run, Constraint<1> contact, int k = 0) {
  for (std::size_t i = 0; i < run.events().size(); ++i) {
    const EventRecord& its = run.events()[i];
    if (its.kind == EventKind::struck && its.source == static_cast<std::size_t>(contact.index) && k-- == 0)
      return i;
  }
  throw Error("no such impact");
}

TEST_P(ModelsWithEvents, HaveThemAtTheTimesOfTheClosedForms) {
  for (const EventModel& model : models_with_events()) {
    for (const double each : {1e-6, 1e-8, 1e-10}) {
      for (const Timed& row : model.events({GetParam(), each}))
        EXPECT_NEAR(row.time.time, row.reference, row.limit * row.reference)
            << model.name << ", " << row.event << " at " << each;
    }
  }
}

/// The last step ends in an impact, and several samples lie within it: y = u t - g t^2/2 of the last flight.
TEST_P(ModelsWithEvents, FlyUntilAnImpactAtTheEnd) {
  const BouncingBall model{.restitution = 0.8};
  const auto built = model.scene();
  for (const double tolerance : {1e-5, 1e-9}) {
    for (int last = 5; last < 10; ++last) {
      const auto run = simulate(
          built.scene, {.t_end = model.impact_time(last), .tolerance = tolerance, .stepper = GetParam()});
      const double u = std::pow(0.8, last) * std::sqrt(2.0 * model.gravity * model.height);
      for (const Sample<2>& now : run) {
        const double t = now.time() - model.impact_time(last - 1);
        if (t <= 0.0) continue;
        EXPECT_NEAR(now.position(built.ball).y(), u * t - 0.5 * model.gravity * t * t, 100.0 * tolerance);
      }
    }
  }
}

TEST_P(ModelsWithEvents, LeaveTheSphereForAParabola) {
  const ParticleOffSphere model;
  const auto built = model.scene();
  const double lands = model.leaving_time() + model.falling_time();
  const auto run = simulate(built.scene, options(1.2 * lands));
  ASSERT_EQ(run.events().size(), 2U);
  EXPECT_NEAR(run.event_sample(0).position(built.particle).y(), std::cos(model.leaving_angle()), bound);
  const Vec<2> v = model.landing_velocity();
  EXPECT_LE((run.event_sample(1).position(built.particle) - model.landing_place()).norm(), bound * v.norm());
  EXPECT_LE((run.event_sample(1).velocity(built.particle) - v).norm(), bound * v.norm());
  EXPECT_NEAR(run.impulse(built.floor, 1), -model.mass * v.y(), bound * v.norm());
  EXPECT_EQ(run.impulse(built.sphere, 1), 0.0);
  // It goes on along the floor, which carries it.
  EXPECT_NEAR(run.velocity(built.particle, 1).x(), v.x(), bound * v.norm());
  EXPECT_NEAR(run.multiplier(built.floor, 1), model.mass * model.gravity, bound * model.gravity);
  EXPECT_EQ(run.multiplier(built.sphere, 1), 0.0);
  EXPECT_TRUE(run.is_unique(built.sphere, 1));
}

TEST_P(ModelsWithEvents, CatchTheBobOnAStringThatTakesOneComponent) {
  const SlackString model;
  const auto built = model.scene();
  const auto run = simulate(built.scene, options(1.1 * model.catch_time()));
  ASSERT_GE(run.events().size(), 2U);
  EXPECT_NEAR(run.event_sample(0).position(built.bob).y(), std::sin(model.slack_angle()), bound);
  const auto before = run.event_sample(1), after = run.sample_after(1);
  const Vec<2> r = model.catch_place(), v = model.catch_velocity();
  const double scale = bound * model.speed, along = v.dot(r) / model.length;
  EXPECT_LE((before.position(built.bob) - r).norm(), scale);
  EXPECT_LE((before.velocity(built.bob) - v).norm(), scale);
  EXPECT_LE((after.velocity(built.bob) - (v - along * r / model.length)).norm(), scale);
  EXPECT_NEAR(-run.impulse(built.string, 1), model.mass * along, scale);
  EXPECT_NEAR(after.energy(), before.energy() - model.mass * along * along / 2.0, scale * model.speed);
}

TEST_P(ModelsWithEvents, GiveThePendulumsRodItsPartOfTheImpulse) {
  const BouncingPendulum model;
  const auto built = model.scene();
  const auto run = simulate(built.scene, options(1.1 * model.rest_time()));
  const double scale = bound * model.mass * model.length * model.impact_rate(0);
  for (int k = 0; k < 5; ++k) {
    const std::size_t i = struck(run, built.wall, k);
    const double across = model.mass * model.length * (1.0 + model.restitution) * model.impact_rate(k);
    EXPECT_NEAR(run.impulse(built.wall, i), across / std::cos(model.wall), scale) << k;
    EXPECT_NEAR(std::abs(run.impulse(built.rod, i)), across * std::tan(model.wall), scale) << k;
  }
  const double weight = model.mass * model.gravity;
  EXPECT_NEAR(run.multiplier(built.wall, 1), weight * std::tan(model.wall), bound * weight);
  EXPECT_NEAR(-run.multiplier(built.rod, 1), weight / std::cos(model.wall), bound * weight);
}

TEST_P(ModelsWithEvents, KeepTheEnergyOfAnElasticPendulum) {
  const BouncingPendulum model{.wall = -0.2, .restitution = 1.0};
  const auto built = model.scene();
  const auto run = simulate(built.scene, options(1.1 * model.impact_time(9)));
  const double energy = model.mass * model.gravity * model.length;
  EXPECT_NEAR(run.energy(1), run.energy(0), bound * energy);
}

TEST_P(ModelsWithEvents, LayTheLadderDownWithImpulsesAtBothEnds) {
  const SlidingLadder model;
  const auto built = model.scene();
  const auto run = simulate(built.scene, options(1.1 * model.lying_time(), 23));
  const double m = model.mass, g = model.gravity, lying = std::numbers::pi / 2.0;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Vec<2> along = run.position(built.ladder.end(), i) - run.position(built.ladder.start(), i);
    const double cosine = -along.y() / model.length, sine = along.x() / model.length;
    const bool held = run.times()[i] < model.leaving_time();
    const double wall = 0.75 * m * g * sine * (3.0 * cosine - 2.0 * std::cos(model.angle));
    EXPECT_NEAR(run.multiplier(built.wall, i), held ? wall : 0.0, bound * m * g) << i;
    EXPECT_GE(run.multiplier(built.floor, i), 0.0) << i;
  }
  const std::size_t down = struck(run, built.lies_down);
  const double U = model.length * model.rate_after_leaving(lying), scale = bound * m * U;
  EXPECT_NEAR(run.impulse(built.lies_down, down), m * U / 3.0, scale);
  EXPECT_NEAR(run.impulse(built.floor, down), m * U / 6.0, scale);
  EXPECT_NEAR(run.event_sample(down).velocity(built.ladder.centre()).y(), -U / 2.0, scale);
  const auto after = run.sample_after(down);
  EXPECT_LE((after.velocity(built.ladder.centre()) - Vec<2>(model.drift(), 0.0)).norm(), scale);
  EXPECT_NEAR(after.energy(), m * model.drift() * model.drift() / 2.0, scale * U);
}

TEST_P(ModelsWithEvents, SlowTheBlockDownByHousnersRatio) {
  for (const auto floor : {RockingBlock::Floor::rough, RockingBlock::Floor::smooth}) {
    const RockingBlock model{.floor = floor};
    const auto built = model.scene();
    const auto run = simulate(built.scene, options(1.01 * model.impact_time(3)));
    const double sine = std::sin(std::atan2(model.half_width, model.half_height));
    if (floor == RockingBlock::Floor::rough) {
      EXPECT_NEAR(model.ratio(), 1.0 - 1.5 * sine * sine, solved);
    }
    for (int k = 0; k < 4; ++k) {
      const Constraint<1> lands = k % 2 == 0 ? built.left : built.right,
                          rises = k % 2 == 0 ? built.right : built.left;
      const std::size_t i = struck(run, lands, k / 2);
      const auto before = run.event_sample(i), after = run.sample_after(i);
      const double w = angular_velocity(before, built.block), w_after = angular_velocity(after, built.block);
      EXPECT_NEAR(w_after, model.ratio() * w, solved * model.impact_rate(0)) << k;
      // The corner that lands has all of the impulse upwards: m b (w + w+).
      const double gained = momentum(after, built.block).y() - momentum(before, built.block).y();
      EXPECT_NEAR(run.impulse(lands, i), gained, solved * model.mass) << k;
      EXPECT_NEAR(gained, model.mass * model.half_width * std::abs(w + w_after), solved * model.mass) << k;
      EXPECT_EQ(run.impulse(rises, i), 0.0) << k;
      EXPECT_NEAR(kinetic_energy(after, built.block),
                  model.ratio() * model.ratio() * kinetic_energy(before, built.block), solved)
          << k;
    }
  }
}

TEST_P(ModelsWithEvents, ShareTheCradlesSpeedByMoreausLaw) {
  for (const int N : {2, 3, 5}) {
    for (const double e : {0.5, 1.0}) {
      const NewtonsCradle model{.balls = N, .restitution = e};
      const auto built = model.scene();
      const auto run = simulate(built.scene, options(1.1 * model.impact_time(0)));
      const double V = model.frequency() * model.amplitude;
      const auto after = run.sample_after(struck(run, built.contacts[0]));
      EXPECT_NEAR(after.velocity(built.balls[0]).x(), (1.0 - (N - 1) * e) * V / N, bound * V)
          << N << ' ' << e;
      for (std::size_t i = 1; i < built.balls.size(); ++i)
        EXPECT_NEAR(after.velocity(built.balls[i]).x(), (1.0 + e) * V / N, bound * V) << N << ' ' << e;
      // The others go on together, pressed against each other.
      const double force = model.mass * model.gravity;
      for (int j = 1; j < N - 1; ++j)
        EXPECT_NEAR(run.multiplier(built.contacts[static_cast<std::size_t>(j)], 1), model.pressing_force(j),
                    bound * force)
            << N << ' ' << e;
    }
  }
}

TEST_P(ModelsWithEvents, UndoTheCradlesFirstImpactByTheSecond) {
  const NewtonsCradle model;
  const auto built = model.scene();
  const auto run = simulate(built.scene, options(1.1 * model.impact_time(1)));
  const double V = model.frequency() * model.amplitude;
  const auto after = run.sample_after(struck(run, built.contacts[0], 1));
  EXPECT_NEAR(after.velocity(built.balls[0]).x(), -V, bound * V);
  for (std::size_t i = 1; i < built.balls.size(); ++i)
    EXPECT_NEAR(after.velocity(built.balls[i]).x(), 0.0, bound * V);
  const double energy = model.mass * V * V / 2.0;
  EXPECT_NEAR(run.energy(1), run.energy(0), bound * energy);
}

TEST_P(ModelsWithEvents, HandTheSpeedThroughACradleWithGaps) {
  const NewtonsCradle model{.gap = 0.002};
  const auto built = model.scene();
  const auto run = simulate(built.scene, options(1.01 * model.impact_time(model.balls - 1)));
  const double V = model.frequency() * model.amplitude;
  for (int k = 1; k < model.balls; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const auto after = run.sample_after(struck(run, built.contacts[i - 1]));
    const double gaps = std::sqrt(k) * model.gap;
    EXPECT_NEAR(after.velocity(built.balls[i]).x(),
                model.frequency() * std::sqrt(model.amplitude * model.amplitude - gaps * gaps), bound * V)
        << k;
    EXPECT_NEAR(after.velocity(built.balls[i - 1]).x(), 0.0, bound * V) << k;
  }
}

}  // namespace
}  // namespace dalembert::models::events_test
