#include <dalembert/models/bead_on_rough_hoop.h>
#include <dalembert/models/block_on_belt.h>
#include <dalembert/models/puck_on_rough_table.h>
#include <dalembert/tests/both_steppers.h>

#include <boost/math/quadrature/gauss.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

namespace dalembert::models::rough_events_test {
namespace {

constexpr double tolerance = 1e-10;
/// As of times (event_times.h), of what is relative to the system's own positions, velocities and forces.
constexpr double bound = 100.0 * tolerance;

class ModelsWithFriction : public testing::TestWithParam<Stepper> {
 protected:
  [[nodiscard]] static Options options(double t_end, int samples) {
    return {.t_end = t_end, .samples = samples, .tolerance = tolerance, .stepper = GetParam()};
  }
};
INSTANTIATE_TEST_SUITE_P(Steppers, ModelsWithFriction, both_steppers, stepper_name);

/// int f(sample i) dt over a run, by Boole's rule: samples are 4 n + 1.
double integral(std::span<const double> times, const auto& f) {
  constexpr double weights[] = {14.0, 32.0, 12.0, 32.0};
  const std::size_t last = times.size() - 1;
  double sum = 0.0;
  for (std::size_t i = 0; i <= last; ++i) sum += (i == 0 || i == last ? 7.0 : weights[i % 4]) * f(i);
  return 2.0 / 45.0 * (times[last] - times[0]) / static_cast<double>(last) * sum;
}

TEST_P(ModelsWithFriction, TheBlockIsWhereTheBeltAndTheSpringTakeIt) {
  // Each time it goes at X + d and sticks at X - d, at the belt's speed.
  const BlockOnBelt model;
  const auto built = model.scene();
  const auto run = simulate(built.scene, options(model.slipping_time(2) + 0.1, 2));
  const double weight = model.weight(), X = model.balance(), d = model.excess();
  ASSERT_EQ(run.events().size(), 6U);
  for (std::size_t i = 1; i < 6; ++i) {
    const double place = run.events()[i].kind == EventKind::slides ? X + d : X - d;
    EXPECT_NEAR(run.event_sample(i).position(built.block).x(), place, bound * X) << i;
    EXPECT_NEAR(run.event_sample(i).velocity(built.block).x(), model.belt, bound * model.frequency() * X)
        << i;
  }
  const auto goes = run.event_sample(5), gone = run.sample_after(5);
  EXPECT_NEAR(goes.multiplier(built.rough), model.sticking * weight, bound * weight);
  EXPECT_NEAR(gone.multiplier(built.rough), model.friction * weight, bound * weight);
}

TEST_P(ModelsWithFriction, TheConeIsNeverExceeded) {
  const auto expect_within = [](const auto& run, auto pressing, auto rough, double mu, double mu_static) {
    for (std::size_t i = 0; i < run.size(); ++i) {
      const auto friction = std::abs(run.multiplier(rough, i)), most = std::abs(run.multiplier(pressing, i));
      bool sticks = false;
      for (const EventRecord& its : run.events()) {
        if (its.time > run.times()[i]) break;
        sticks = its.kind == EventKind::sticks;
      }
      EXPECT_LE(friction, (sticks ? mu_static : mu) * most * (1.0 + bound)) << run.times()[i];
    }
  };
  const BlockOnBelt belt;
  const auto on_belt = belt.scene();
  expect_within(simulate(on_belt.scene, options(belt.slipping_time(3), 1001)), on_belt.belt, on_belt.rough,
                belt.friction, belt.sticking);
  const BeadOnRoughHoop hoop;
  const auto on_hoop = hoop.scene();
  expect_within(simulate(on_hoop.scene, options(1.1 * hoop.turns().back().time, 1001)), on_hoop.wire,
                on_hoop.rough, hoop.friction, hoop.sticking);
}

TEST_P(ModelsWithFriction, TheBeltGivesWhatBecomesHeat) {
  // Over a period the block gains nothing. By Gauss's rule with 20 points in each phase, exact to round-off.
  const BlockOnBelt model;
  const auto built = model.scene();
  const double t_end = model.slipping_time(1) + 0.1;
  Options phases = options(t_end, 0);
  std::vector<double> weights;
  const auto add = [&](double from, double until) {
    using Rule = boost::math::quadrature::gauss<double, 20>;
    for (int k = -10; k < 10; ++k) {
      const auto i = static_cast<std::size_t>(k < 0 ? -k - 1 : k);
      const double x = k < 0 ? -Rule::abscissa()[i] : Rule::abscissa()[i];
      phases.times.push_back(0.5 * (from + until) + 0.5 * (until - from) * x);
      weights.push_back(0.5 * (until - from) * Rule::weights()[i]);
    }
  };
  add(model.slipping_time(0), model.sticking_time(1));
  add(model.sticking_time(1), model.slipping_time(1));
  phases.times.push_back(t_end);
  const auto run = simulate(built.scene, phases);
  double by_belt = 0.0, on_block = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double force = weights[i] * run.multiplier(built.rough, i);
    by_belt += force * model.belt;
    on_block += force * run.velocity(built.block, i).x();
  }
  const double heat = model.heat_of_period();
  EXPECT_NEAR(by_belt, heat, bound * heat);
  EXPECT_NEAR(on_block, 0.0, bound * heat);
  EXPECT_NEAR(run.event_sample(1).energy(), run.event_sample(3).energy(), bound * heat);
}

TEST_P(ModelsWithFriction, TheBeadTurnsAndRestsWhereTheClosedFormSays) {
  for (const BeadOnRoughHoop& model :
       {BeadOnRoughHoop{}, BeadOnRoughHoop{.angle = 1.2, .friction = 0.2, .sticking = 0.3},
        BeadOnRoughHoop{.angle = 3.0, .friction = 0.05, .sticking = 0.1}}) {
    const auto built = model.scene();
    const auto turns = model.turns();
    const auto run = simulate(built.scene, options(1.1 * turns.back().time, 2));
    ASSERT_EQ(run.events().size(), turns.size());
    for (std::size_t k = 0; k < turns.size(); ++k) {
      const Vec<2> r = run.event_sample(k).position(built.bead);
      EXPECT_NEAR(std::atan2(r.x(), -r.y()), turns[k].angle, bound) << k;
    }
    const double rests = turns.back().angle;
    const Vec<2> r = run.position(built.bead, 1);
    EXPECT_LE(std::abs(std::tan(rests)), model.sticking);
    EXPECT_NEAR(std::atan2(r.x(), -r.y()), rests, bound);
    EXPECT_NEAR(std::abs(run.multiplier(built.rough, 1)),
                model.mass * model.gravity * std::abs(std::sin(rests)), bound * model.mass * model.gravity);
  }
}

TEST_P(ModelsWithFriction, WhatTheBeadAndThePuckLoseIsTheWorkOfFriction) {
  // The bead's first swing, whose wire does not turn its force: all is smooth. 400 intervals to some
  // oscillations' worth, their sixth power, are below the tolerance.
  const BeadOnRoughHoop hoop{.angle = 1.2, .friction = 0.2, .sticking = 0.3};
  const auto on_hoop = hoop.scene();
  const auto swing = simulate(on_hoop.scene, options(0.95 * hoop.turns().front().time, 401));
  const double rubbed = integral(swing.times(), [&](std::size_t i) {
    return -hoop.friction * std::abs(swing.multiplier(on_hoop.wire, i)) *
           swing.velocity(on_hoop.bead, i).norm();
  });
  const double height = hoop.mass * hoop.gravity * hoop.radius;
  EXPECT_NEAR(swing.energy(400) - swing.energy(0), rubbed, bound * height);

  const PuckOnRoughTable table;
  const auto on_table = table.scene();
  const auto slide = simulate(on_table.scene, options(0.9 * table.rest_time(), 401));
  const double work = integral(slide.times(), [&](std::size_t i) {
    return slide.constraint_force(on_table.rough, on_table.puck, i).dot(slide.velocity(on_table.puck, i));
  });
  const double energy = 0.5 * table.mass * table.speed * table.speed;
  EXPECT_NEAR(slide.energy(400) - slide.energy(0), work, bound * energy);
}

TEST_P(ModelsWithFriction, ThePuckTurnsIntoThePull) {
  const PuckOnRoughTable model;
  const auto built = model.scene();
  const auto run = simulate(built.scene, options(model.rest_time(), 101));
  const double weight = model.mass * model.gravity;
  for (std::size_t i = 0; i < 100; ++i) {
    const Vec<3> u = run.velocity(built.puck, i);
    if (u.norm() < 0.01 * model.speed) continue;  // psi errs by the speed's error over it
    const double psi = std::atan2(u.y(), u.x());
    EXPECT_NEAR(u.norm(), model.speed_along(psi), 100.0 * bound * model.speed) << i;
    EXPECT_NEAR(run.multiplier(built.rough, i).norm(), model.friction * weight, bound * weight) << i;
  }
}

}  // namespace
}  // namespace dalembert::models::rough_events_test
