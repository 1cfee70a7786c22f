#include <dalembert/constraints/on_curve.h>
#include <dalembert/constraints/unilateral.h>
#include <dalembert/core/forces/forces.h>
#include <dalembert/core/points/points.h>
#include <dalembert/core/scene/scene.h>
#include <dalembert/solvers/simulation.h>
#include <dalembert/tests/both_steppers.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

/// Events whose functions vary faster than the motion, and those at the end of a run.
namespace dalembert::fast_events_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class FastEvents : public testing::TestWithParam<StepperAt> {
 protected:
  [[nodiscard]] static double tolerance() { return GetParam().tolerance; }
  [[nodiscard]] static Options options(double t_end) {
    return {.t_end = t_end, .samples = 2, .tolerance = tolerance(), .stepper = GetParam().stepper};
  }
};
INSTANTIATE_TEST_SUITE_P(InBothSteppers, FastEvents, both_steppers_at({1e-4, 1e-6, 1e-8, 1e-10, 1e-12}),
                         tolerance_name);

/// Free fall at 1 m/s along x.
struct Fall {
  Scene<2> scene{"fall"};
  Particle<2> body;
  Fall() : body(scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.0}})) {
    scene.add(UniformGravity<2>{{0.0, -9.81}});
  }
};

TEST_P(FastEvents, AllEventsOfTimeAreFound) {
  for (const double rate : {30.0, 300.0}) {
    const auto run =
        simulate(Fall{}.scene, options(2.0), {{.name = "zero", .function = [rate](const auto& now) {
                                                 return std::sin(rate * now.time() + 1e-3);
                                               }}});
    const auto zeros = static_cast<std::size_t>((2.0 * rate + 1e-3) / std::numbers::pi);
    ASSERT_EQ(run.events().size(), zeros);
    for (std::size_t k = 0; k < zeros; ++k) {
      EXPECT_NEAR(run.events()[k].time, (static_cast<double>(k + 1) * std::numbers::pi - 1e-3) / rate, 1e-12);
    }
  }
}

TEST_P(FastEvents, AllEventsOfTheStateAreFound) {
  const Fall fall;
  const auto run = simulate(fall.scene, options(2.0), {{.name = "zero", .function = [&](const auto& now) {
                                                          return std::cos(40.0 * now.position(fall.body).x());
                                                        }}});
  const auto zeros = static_cast<std::size_t>(80.0 / std::numbers::pi + 0.5);
  ASSERT_EQ(run.events().size(), zeros);
  for (std::size_t k = 0; k < zeros; ++k)
    EXPECT_NEAR(run.events()[k].time, (static_cast<double>(k) + 0.5) * std::numbers::pi / 40.0,
                100.0 * tolerance());
}

TEST_P(FastEvents, BothOfTwoCloseRootsAreFound) {
  for (const double apart : {1e-1, 1e-2, 1e-3}) {
    const auto run = simulate(Fall{}.scene, options(2.0), {{.name = "zero", .function = [=](const auto& now) {
                                                              const double t = now.time();
                                                              return (t - 1.234) * (t - 1.234 - apart) *
                                                                     (1.0 + 0.3 * std::sin(20.0 * t));
                                                            }}});
    ASSERT_EQ(run.events().size(), 2U) << apart;
    EXPECT_NEAR(run.events()[0].time, 1.234, 1e-10);
    EXPECT_NEAR(run.events()[1].time, 1.234 + apart, 1e-10);
  }
}

TEST_P(FastEvents, TouchOfZeroIsNoEvent) {
  const auto run = simulate(
      Fall{}.scene, options(2.0),
      {{.name = "touches", .function = [](const auto& now) { return std::pow(now.time() - 0.7321, 2); }},
       {.name = "cosine", .function = [](const auto& now) { return 1.0 - std::cos(25.0 * now.time()); }}});
  EXPECT_TRUE(run.events().empty());
}

TEST_P(FastEvents, FasterThanCanBeFollowedAreRefusedByNameUnlessStepsAreShort) {
  const std::vector<Event<2>> buzz{
      {.name = "buzz", .function = [](const auto& now) { return std::sin(3e5 * now.time() + 1e-3); }}};
  auto o = options(0.01);
  if (tolerance() > 1e-5) {
    auto far = o;
    far.t_end = 2.0;
    EXPECT_THAT([&] { (void)simulate(Fall{}.scene, far, buzz); },
                ThrowsMessage<IntegrationFailure>(AllOf(HasSubstr("\"buzz\""), HasSubstr("max_step"))));
  }
  o.max_step = 1e-4;
  const auto run = simulate(Fall{}.scene, o, buzz);
  EXPECT_EQ(run.events().size(), 954U);  // (3000 + 1e-3)/pi
}

TEST_P(FastEvents, FunctionsWithJumpsOrCornersAreFollowed) {
  const Fall fall;
  const auto run = simulate(
      fall.scene, options(2.0),
      {{.name = "jump", .function = [](const auto& now) { return now.time() < 0.77 ? -1.0 : 3.0; }},
       {.name = "corner", .function = [](const auto& now) { return std::abs(now.time() - 1.3) - 1e-3; }}});
  ASSERT_EQ(run.events().size(), 3U);
  EXPECT_NEAR(run.events()[0].time, 0.77, 1e-14);
  EXPECT_NEAR(run.events()[1].time, 1.299, 1e-12);
  EXPECT_NEAR(run.events()[2].time, 1.301, 1e-12);
}

/// Functions that turn at a kink behind 0, between all times at which a step looks at them.
TEST_P(FastEvents, KinksBehindZeroAreSeenWhereverTheyFall) {
  const Fall fall;
  for (const double depth : {3e-4, 1e-5}) {
    for (int k = 0; k < 40; ++k) {
      const double kink = 0.1 + 0.045 * k;
      const auto run =
          simulate(fall.scene, options(2.0),
                   {{.name = "steeper",
                     .function =
                         [=](const auto& now) {
                           const double t = now.time() - kink;
                           return std::max(-0.3 * t, 2.0 * t) - depth;
                         }},
                    {.name = "curved",
                     .function =
                         [=](const auto& now) {
                           return depth - std::abs(now.time() - kink) * (1.0 + std::sin(now.time()));
                         }},
                    {.name = "steepening", .function = [=](const auto& now) {
                       return std::tanh(8.0 * std::abs(now.time() - kink)) - depth;
                     }}});
      EXPECT_EQ(run.events().size(), 6U) << kink << ' ' << depth;
    }
  }
}

TEST_P(FastEvents, EventAtTheEndOfARunIsListedAndCarriedOut) {
  Fall fall;
  const auto changed = std::make_shared<int>(0);
  const std::vector<Event<2>> events{
      {.name = "mark", .function = [](const auto& now) { return now.time() - 2.0; }},
      {.name = "change",
       .function = [](const auto& now) { return 0.1 * (now.time() - 2.0); },
       .change =
           [=](Scene<2>& scene) {
             ++*changed;
             scene.replace(fall.body,
                           ParticleState<2>{.mass = 3.0, .position = {2.0, -19.62}, .velocity = {0.0, 0.0}});
           }}};
  const auto run = simulate(fall.scene, options(2.0), events);
  ASSERT_EQ(run.events().size(), 2U);
  EXPECT_EQ(run.events()[0].source, 0U);
  EXPECT_EQ(run.events()[1].source, 1U);
  EXPECT_EQ(run.events()[1].time, 2.0);
  EXPECT_EQ(*changed, 1);
  EXPECT_EQ(run.sample_after(1).velocity(fall.body).norm(), 0.0);
}

// Before a change, at it, and as close behind it as round-off tells: each once.
TEST_P(FastEvents, EventBesideAChangeIsListedOnce) {
  for (const double behind : {-1e-9, -1e-14, 0.0, 1e-14, 1e-12, 1e-11, 1e-9}) {
    const std::vector<Event<2>> events{
        {.name = "change",
         .function = [](const auto& now) { return now.time() - 1.0; },
         .change = [](Scene<2>&) {}},
        {.name = "beside", .function = [=](const auto& now) { return 0.1 * (now.time() - 1.0 - behind); }}};
    const auto run = simulate(Fall{}.scene, options(2.0), events);
    EXPECT_EQ(run.events().size(), 2U) << behind;
  }
}

// A step may be as long as a period, or several: few values of it are alike by chance at some rate.
TEST_P(FastEvents, EventsAtAnyRateAreAllFound) {
  constexpr int rates = 100;
  for (int k = 0; k < rates; ++k) {
    const double rate = 20.0 * std::pow(100.0, k / (rates - 1.0));
    const auto run =
        simulate(Fall{}.scene, options(2.0), {{.name = "zero", .function = [rate](const auto& now) {
                                                 return std::sin(rate * now.time() + 1e-3);
                                               }}});
    EXPECT_EQ(run.events().size(), static_cast<std::size_t>((2.0 * rate + 1e-3) / std::numbers::pi)) << rate;
  }
}

// A kick by 1 m/s every 0.1 s, by a function that rises through 0 there and falls through it in between,
// which was not asked for. All that follows a kick within a step lies behind it. With a second mass the scene
// has a length.
TEST_P(FastEvents, EachEventChangesTheSceneOnce) {
  constexpr double period = 0.1, first = 0.025;
  for (const bool with_another : {false, true}) {
    Scene<2> scene("kicked");
    const auto body = scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.0}});
    if (with_another) scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}});
    const Event<2> kick{
        .name = "kick",
        .function =
            [](const auto& now) { return std::sin(2.0 * std::numbers::pi * (now.time() - first) / period); },
        .crossing = Crossing::rising,
        .change =
            [=](Scene<2>& s) {
              const auto q = s.initial_positions(), v = s.initial_velocities();
              s.replace(body, ParticleState<2>{
                                  .mass = 1.0, .position = {q[0], q[1]}, .velocity = {v[0], v[1] + 1.0}});
            }};
    const auto run = simulate(scene, options(2.0), {kick});
    ASSERT_EQ(run.events().size(), 20U);
    for (std::size_t k = 0; k < 20; ++k)
      EXPECT_NEAR(run.events()[k].time, first + static_cast<double>(k) * period, 1e-12);
    EXPECT_NEAR(run.position(body, 1).y(), 20.5, 1e-10);  // the sum of 2 - t_k; roundings of 20 times
  }
}

}  // namespace
}  // namespace dalembert::fast_events_test
