#include <dalembert/dalembert.h>
#include <dalembert/tests/both_steppers.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

/// An equation that switches at the very time at which a run starts, ends, is sampled or is changed. Stated
/// as t < T or as t <= T it is the same motion.
namespace dalembert::switch_times_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double g = 10.0;

struct Switching {
  double T;
  bool before_at_T;

  template <class X>
  [[nodiscard]] bool before(const X& x) const {
    return before_at_T ? x <= T : x < T;
  }
};

/// A block of 1 kg at the origin, and another mass that has nothing to do with it.
struct Yard : Switching {
  Scene<2> scene{"yard"};
  Particle<2> block = scene.add_particle({.mass = 1.0}, "block");
  Particle<2> other = scene.add_particle({.mass = 1.0, .position = {3.0, 0.0}}, "other");

  explicit Yard(Switching at) : Switching(at) { scene.add(UniformGravity<2>{{0.0, -g}}); }

  void starts_with(double speed) { scene.replace(block, {.mass = 1.0, .velocity = {speed, 0.0}}); }
  /// A floor that moves at this speed from T on.
  void lift(double speed, double restitution = 0.0) {
    const Switching at = *this;
    const auto gap = [=](auto t, auto r) {
      if (at.before(t)) return r.y() + 0.0 * t;
      return r.y() - speed * (t - at.T);
    };
    scene.add(unilateral(holonomic(points(block), gap), {.restitution = restitution}), "floor");
  }
  /// A belt, of mu = 0.2, that runs at 2 m/s from T on.
  void belt() {
    const Switching at = *this;
    const auto slip = [=](auto t, auto /*r*/, auto v) {
      if (at.before(t)) return v.x() + 0.0 * t;
      return v.x() - 2.0 + 0.0 * t;
    };
    const auto floor = scene.add(OnCurve{block, Plane<2>{}}, "floor");
    scene.add(coulomb(floor, nonholonomic(points(block), slip), 0.2), "belt");
  }
  /// This force on the block from T on.
  void push(Vec<2> force) {
    const Switching at = *this;
    scene.add(force_law(points(block), [=](auto t, auto /*r*/, auto v) {
      if (at.before(t)) return 0.0 * v + 0.0 * t * force;
      return 0.0 * v + (1.0 + 0.0 * t) * force;
    }));
  }
  /// Changes the other mass where this is 0.
  [[nodiscard]] Event<2> load(std::function<double(const Sample<2>&)> function) const {
    return {.name = "load", .function = std::move(function), .change = [other = other](Scene<2>& changed) {
              changed.replace(other, {.mass = 2.0, .position = {5.0, 0.0}});
            }};
  }
  [[nodiscard]] Event<2> load_at_T() const {
    return load([T = T](const Sample<2>& now) { return now.time() - T; });
  }
};

class SwitchTimes : public testing::TestWithParam<StepperAt> {
 protected:
  [[nodiscard]] static Trajectory<2> run(const Yard& yard, std::vector<double> times,
                                         const std::vector<Event<2>>& events = {}) {
    const double t_start = times.front(), t_end = times.back();
    return simulate(yard.scene,
                    {.t_end = t_end,
                     .t_start = t_start,
                     .times = std::move(times),
                     .tolerance = GetParam().tolerance,
                     .stepper = GetParam().stepper},
                    events);
  }
  /// Each step may err by the tolerance in states of some metres and seconds.
  [[nodiscard]] static double bound(const Trajectory<2>& run) {
    return 10.0 * static_cast<double>(run.statistics().steps) * GetParam().tolerance;
  }
  static void expect_last(const Trajectory<2>& run, const Yard& yard, Vec<2> position) {
    EXPECT_NEAR(run.position(yard.block, run.size() - 1).x(), position.x(), bound(run)) << yard.T;
    EXPECT_NEAR(run.position(yard.block, run.size() - 1).y(), position.y(), bound(run)) << yard.T;
  }
  /// By some of these times steps and samples come exactly to T, by others they miss it by a rounding.
  static void for_each_switch(const std::function<void(Switching)>& test) {
    for (const double T : {0.113, 0.152, 0.204, 0.5, 0.7})
      for (const bool before_at_T : {false, true}) test({T, before_at_T});
  }
};
INSTANTIATE_TEST_SUITE_P(InBothSteppers, SwitchTimes, both_steppers_at({1e-4, 1e-7, 1e-10}), tolerance_name);

constexpr double after = 0.1;                        // of a run behind its switch
constexpr double fallen = -0.5 * g * after * after;  // in that time

TEST_P(SwitchTimes, FloorFallsAwayAtAChange) {
  for_each_switch([](Switching at) {
    Yard yard(at);
    yard.lift(-2.0);
    expect_last(run(yard, {0.0, at.T, at.T + after}, {yard.load_at_T()}), yard, {0.0, fallen});
  });
}

// e = 0.5: from a floor that rises at 2 m/s at 3.
TEST_P(SwitchTimes, FloorStrikesAtAChange) {
  for_each_switch([](Switching at) {
    Yard yard(at);
    yard.lift(2.0, 0.5);
    const auto flight = run(yard, {0.0, at.T, at.T + after}, {yard.load_at_T()});
    expect_last(flight, yard, {0.0, 3.0 * after + fallen});
  });
}

constexpr double dragged = 0.5 * 0.2 * g * after * after;  // by a belt, which it is slower than

TEST_P(SwitchTimes, BeltStartsAtAChange) {
  for_each_switch([](Switching at) {
    Yard yard(at);
    yard.belt();
    expect_last(run(yard, {0.0, at.T, at.T + after}, {yard.load_at_T()}), yard, {dragged, 0.0});
  });
}

// From a table that ends at x = T the block, which moves at 1 m/s, falls.
TEST_P(SwitchTimes, TableEndsWhereSomethingChanges) {
  for_each_switch([](Switching at) {
    Yard yard(at);
    yard.starts_with(1.0);
    const auto table = [=](auto r) {
      if (at.before(r.x())) return r.y() + 0.0 * r.x();
      return r.y() + 20.0 * (r.x() - at.T) * (r.x() - at.T);
    };
    yard.scene.add(unilateral(holonomic(points(yard.block), table)), "table");
    const auto block = yard.block;
    const auto edge = yard.load([=](const Sample<2>& now) { return now.position(block).x() - at.T; });
    expect_last(run(yard, {0.0, at.T + after}), yard, {at.T + after, fallen});
    expect_last(run(yard, {0.0, at.T + after}, {edge}), yard, {at.T + after, fallen});
  });
}

// mu = 0.3 holds the block, up to a push of 3 N. Where the force jumps it is read before it.
TEST_P(SwitchTimes, PushesBeginAtASample) {
  for_each_switch([](Switching at) {
    Yard slides(at), lifted(at), pressed(at);
    slides.push({7.0, 0.0});
    const auto rough = slides.scene.add(OnCurve{slides.block, Plane<2>{}}, "floor");
    slides.scene.add(coulomb(rough, Slip{slides.block, Plane<2>{}}, 0.3), "rough");
    expect_last(run(slides, {0.0, at.T, at.T + after}), slides, {0.5 * (7.0 - 3.0) * after * after, 0.0});
    lifted.push({0.0, 30.0});
    lifted.scene.add(unilateral(OnCurve{lifted.block, Plane<2>{}}), "floor");
    expect_last(run(lifted, {0.0, at.T, at.T + after}), lifted, {0.0, 0.5 * 20.0 * after * after});
    pressed.push({0.0, -40.0});
    const auto floor = pressed.scene.add(OnCurve{pressed.block, Plane<2>{}}, "floor");
    for (const auto& times : {std::vector{0.0, at.T, at.T + after}, {0.0, at.T}})
      EXPECT_NEAR(run(pressed, times).multiplier(floor, 1), g, bound(run(pressed, times))) << at.T;
  });
}

TEST_P(SwitchTimes, ForcesEndWithTheRunBeforeTheirJump) {
  for_each_switch([](Switching at) {
    Yard lifted(at);
    lifted.push({0.0, 30.0});
    const auto floor = lifted.scene.add(unilateral(OnCurve{lifted.block, Plane<2>{}}), "floor");
    const auto rest = run(lifted, {0.0, at.T});
    EXPECT_NEAR(rest.multiplier(floor, 1), g, bound(rest)) << at.T;
  });
}

// m y" = -y/C - g + F/m behind T on a yielding floor at its rest, y = -C m g + C F (1 - cos(t - T)) with C =
// m = 1. Read from the steps, with a ledger of the work that the push does.
TEST_P(SwitchTimes, PushBeginsOnAYieldingFloorWhereStepsAndLedgerAreRead) {
  for_each_switch([](Switching at) {
    Yard yard(at);
    yard.scene.replace(yard.block, {.mass = 1.0, .position = {0.0, -g}});
    yard.push({0.0, 3.0});
    const auto floor = yard.scene.add(compliant(OnCurve{yard.block, Plane<2>{}}, 1.0), "floor");
    const auto run = simulate(yard.scene, {.t_end = 2.0,
                                           .times = {0.0, at.T, 2.0},
                                           .tolerance = GetParam().tolerance,
                                           .stepper = GetParam().stepper,
                                           .dense = true,
                                           .ledger = true});
    for (const double t : {0.5 * at.T, at.T, at.T + 0.4, 2.0}) {
      const double y = -g + (t > at.T ? 3.0 * (1.0 - std::cos(t - at.T)) : 0.0);
      const auto there = run.at({t});
      EXPECT_NEAR(there.position(yard.block, 0).y(), y, bound(run)) << at.T << ' ' << t;
      EXPECT_NEAR(there.multiplier(floor, 0), -y, bound(run)) << at.T << ' ' << t;
    }
  });
}

// x" = -9 (x - d) on a smooth floor, where the end of the spring jumps from d = 0 to 0.1 m at T. Its force
// jumps, the block does not.
TEST_P(SwitchTimes, EndOfASpringJumps) {
  for_each_switch([](Switching at) {
    constexpr double omega = 3.0, x0 = 0.05, d = 0.1, t_end = 1.5;
    Yard yard(at);
    yard.scene.replace(yard.block, {.mass = 1.0, .position = {x0, 0.0}});
    yard.scene.add(OnCurve{yard.block, Plane<2>{}}, "floor");
    const auto end = [=](auto t, auto r) { return r.x() - (at.before(t) ? 0.0 : d) + 0.0 * t; };
    const auto spring =
        yard.scene.add(compliant(holonomic(points(yard.block), end), 1.0 / (omega * omega)), "spring");
    const auto its = run(yard, {0.0, at.T, t_end});
    const double x1 = x0 * std::cos(omega * at.T), v1 = -omega * x0 * std::sin(omega * at.T),
                 s = omega * (t_end - at.T);
    const double x = d + (x1 - d) * std::cos(s) + v1 / omega * std::sin(s);
    expect_last(its, yard, {x, 0.0});
    EXPECT_NEAR(its.multiplier(spring, 1), -omega * omega * x1, omega * omega * bound(its)) << at.T;
    EXPECT_NEAR(its.multiplier(spring, 2), -omega * omega * (x - d), omega * omega * bound(its)) << at.T;
  });
}

// A second phase, which takes over where the first has ended.
TEST_P(SwitchTimes, RunsStartBehindTheirSwitch) {
  for_each_switch([](Switching at) {
    Yard falls(at), strikes(at), dragged_along(at), lifted(at);
    falls.lift(-2.0);
    expect_last(run(falls, {at.T, at.T + after}), falls, {0.0, fallen});
    strikes.lift(2.0, 0.5);
    expect_last(run(strikes, {at.T, at.T + after}), strikes, {0.0, 3.0 * after + fallen});
    dragged_along.belt();
    expect_last(run(dragged_along, {at.T, at.T + after}), dragged_along, {dragged, 0.0});
    lifted.push({0.0, 30.0});
    lifted.scene.add(unilateral(OnCurve{lifted.block, Plane<2>{}}), "floor");
    expect_last(run(lifted, {at.T, at.T + after}), lifted, {0.0, 0.5 * 20.0 * after * after});
  });
}

TEST_P(SwitchTimes, VelocitiesThatAreNotThoseBehindTheStartAreRefused) {
  for_each_switch([](Switching at) {
    Yard yard(at);
    yard.scene.add(nonholonomic(points(yard.block),
                                [=](auto t, auto, auto v) {
                                  if (at.before(t)) return v.x() + 0.0 * t;
                                  return v.x() - 2.0 + 0.0 * t;
                                }),
                   "drive");
    EXPECT_THAT(
        [&] {
          (void)run(yard, {at.T, at.T + after});
        },
        ThrowsMessage<InconsistentStart>(HasSubstr("\"drive\" is violated by the initial velocities")));
    yard.starts_with(2.0);
    expect_last(run(yard, {at.T, at.T + after}), yard, {2.0 * after, fallen});
  });
}

// A wire with a corner at x = 0, at which the bead starts: (1, 0) is no velocity behind it.
TEST_P(SwitchTimes, StartAtACornerOfAWireIsRefused) {
  for (const bool before_at_0 : {false, true}) {
    const Switching corner{0.0, before_at_0};
    Yard yard(corner);
    yard.starts_with(1.0);
    const auto wire = [=](auto r) {
      if (corner.before(r.x())) return r.y() + 0.0 * r.x();
      return r.y() - r.x();
    };
    yard.scene.add(holonomic(points(yard.block), wire), "wire");
    EXPECT_THAT(
        [&] {
          (void)run(yard, {0.0, after});
        },
        ThrowsMessage<InconsistentStart>(HasSubstr("\"wire\"")));
  }
}

// Pushed back from both sides of x = 0 the block stays there: no step does.
TEST_P(SwitchTimes, StartBetweenForcesThatDriveBackIsSaidToChatter) {
  for (const bool before_at_0 : {false, true}) {
    const Switching middle{0.0, before_at_0};
    Yard yard(middle);
    yard.scene.add(force_law(points(yard.block),
                             [=](auto r, auto /*v*/) {
                               if (middle.before(r.x())) return vec(1.0, 0.0) + 0.0 * r;
                               return vec(-1.0, 0.0) + 0.0 * r;
                             }),
                   "valley");
    EXPECT_THAT(
        [&] {
          (void)run(yard, {0.0, after});
        },
        ThrowsMessage<InconsistentStart>(HasSubstr("it would chatter")));
  }
}

}  // namespace
}  // namespace dalembert::switch_times_test
