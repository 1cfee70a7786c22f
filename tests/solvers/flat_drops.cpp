#include <dalembert/tests/solvers/with_events.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dalembert::flat_drops_test {
namespace {

/// Bodies that fall on several feet: where these hit together, and where they do not.
class FlatDrops : public WithEvents {};
INSTANTIATE_TEST_SUITE_P(Runs, FlatDrops, both_steppers_at({1e-8, 1e-10, 1e-11, 1e-12}), tolerance_name);

constexpr double e = 0.5;

/// A ball of restitution e, dropped from h: it flies for 2 e^k u/g, u = sqrt(2 g h), until it rests.
struct Ball {
  double h, first = std::sqrt(2.0 * h / g), rests = first * (1.0 + e) / (1.0 - e);

  [[nodiscard]] double height(double t) const {
    if (t < first) return h - 0.5 * g * t * t;
    double u = e * g * first;
    for (t -= first; t >= 2.0 * u / g && u > 0.0; u *= e) t -= 2.0 * u / g;
    return std::max(u * t - 0.5 * g * t * t, 0.0);
  }
};

TEST_P(FlatDrops, BounceAsABall) {
  // All feet hit at once, on each hop, wherever samples are: it does not turn.
  const Ball ball{1.0};
  for (const std::size_t feet : {3U, 4U, 5U})
    for (const int samples : {3, 301}) {
      Scene<3> scene("flat drop");
      scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
      const auto body = add_body(
          scene, BodyState<3>{.mass = 3.0, .inertia = {0.5, 0.6, 0.7}, .centre = {0.3, 0.2, 0.25 + ball.h}},
          "body");
      for (std::size_t i = 0; i < feet; ++i) {
        const double at = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(feet);
        const auto foot = body.point({0.7 * std::cos(at), 0.7 * std::sin(at), -0.25});
        scene.add(unilateral(OnSurface{foot, Plane<3>{}}, {.restitution = e}));
      }
      Options o = options(2.0);
      o.samples = samples;
      const auto run = simulate(scene, o);
      const auto& events = run.events();
      ASSERT_EQ(events.size() % feet, 0U) << feet << ' ' << samples;
      for (std::size_t k = 0; k < events.size(); ++k) {
        EXPECT_EQ(events[k].time, events[k - k % feet].time) << feet << ' ' << samples;
        EXPECT_EQ(events[k].kind, k + feet < events.size() ? EventKind::struck : EventKind::rested);
      }
      EXPECT_NEAR(events.back().time, ball.rests, bound * ball.rests) << feet << ' ' << samples;
      for (std::size_t i = 0; i < run.size(); ++i) {
        EXPECT_NEAR(run.position(body.centre(), i).z() - 0.25, ball.height(run.times()[i]), bound) << feet;
        EXPECT_NEAR(angular_velocity(run.sample(i), body).norm(), 0.0, bound) << feet << ' ' << samples;
      }
    }
}

TEST_P(FlatDrops, FeetOfDifferentHeightHitOneByOne) {
  // The higher foot is above the lower one by a hundred times what positions are known to. The first impact
  // turns the body, P = (1 + e) u/S_11; the other foot goes to the floor at -u + S_12 P then, and hits it
  // when it has come down. Positions that err by the tolerance in each of two times shift these by that over
  // u.
  constexpr double m = 2.0, I = 0.5, a = 0.6, S_11 = 1.0 / m + a * a / I, S_12 = 1.0 / m - a * a / I;
  const Ball ball{1.0};
  const double higher = bound, u = g * ball.first, P = (1.0 + e) * u / S_11, next = u - S_12 * P;
  Scene<2> scene("tilted drop");
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto body = add_body(
      scene, BodyState<2>{.mass = m, .inertia = I, .centre = {0.0, 0.25 + ball.h}, .angle = 0.0}, "body");
  const auto low = scene.add(unilateral(OnCurve{body.point({a, -0.25}), Plane<2>{}}, {.restitution = e}));
  const auto high =
      scene.add(unilateral(OnCurve{body.point({-a, higher - 0.25}), Plane<2>{}}, {.restitution = e}));
  const auto run = simulate(scene, options(ball.first + 0.01));
  ASSERT_GE(run.events().size(), 2U);
  const EventRecord &first = run.events()[0], &second = run.events()[1];
  EXPECT_EQ(first.source, static_cast<std::size_t>(low.index));
  EXPECT_EQ(second.source, static_cast<std::size_t>(high.index));
  EXPECT_NEAR(second.time - first.time, higher / next, 2.0 * tolerance / u);
  EXPECT_NEAR(angular_velocity(run.sample_after(0), body), a * P / I, bound * u);
}

/// A ball is thrown up from a table that goes up and down, A sin(w t), bounces down to rest on it, and leaves
/// again where the table's acceleration is -a: sin(w t) = a/(A w^2). Its last hops are so short that its gap
/// is hardly above round-off.
TEST(HopsOnATable, EndInRestUntilTheTableFallsAway) {
  constexpr double A = 0.1, w = 12.0, a = 10.0, t_end = 0.6;
  const double leaves = (2.0 * std::numbers::pi + std::asin(a / (A * w * w))) / w, flies = t_end - leaves;
  const double y = A * std::sin(w * leaves) + (A * w * std::cos(w * leaves) - 0.5 * a * flies) * flies;
  for (const Stepper stepper : {Stepper::ida, Stepper::erk})
    for (const double tolerance : {1e-10, 3e-12, 1e-12, 3e-13, 1e-13})
      for (const double e : {0.5, 0.55, 0.6}) {
        Scene<2> scene;
        scene.add(UniformGravity<2>{{0.0, -a}});
        const auto ball = scene.add_particle({.mass = 2.0, .velocity = {0.0, A * w}});
        const Translating table{Plane<2>{}, [](auto t) { return vec(0.0 * t, A * sin(w * t)); }};
        scene.add(unilateral(OnCurve{ball, table}, {.restitution = e}));
        const auto run =
            simulate(scene, {.t_end = t_end, .samples = 3, .tolerance = tolerance, .stepper = stepper});
        const EventRecord& last = run.events().back();
        EXPECT_EQ(last.kind, EventKind::opened) << tolerance << ' ' << e;
        EXPECT_NEAR(last.time, leaves, 100.0 * tolerance) << tolerance << ' ' << e;
        EXPECT_NEAR(run.position(ball, 2).y(), y, 100.0 * tolerance) << tolerance << ' ' << e;
      }
}

}  // namespace
}  // namespace dalembert::flat_drops_test
