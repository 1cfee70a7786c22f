#include <dalembert/dalembert.h>
#include <dalembert/tests/both_steppers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

/// Pushes that `if`, floor or a table let last from one time to another, on what rests until then: long steps
/// pass several switches, of which the first have no effect.
namespace dalembert::pushes_by_time_test {
namespace {

constexpr double t_end = 10.0;

class PushesByTime : public testing::TestWithParam<StepperAt> {
 protected:
  /// Where a spring of 1 N/m brings 1 kg that a force f(t) pushes.
  template <class Force>
  [[nodiscard]] double pushed(const Force& f, bool ledger = false) const {
    Scene<2> scene;
    const auto body = scene.add_particle({.mass = 1.0}, "body");
    scene.add(Spring{Fixed<2>{}, body, 1.0});
    scene.add(force_law(points(body), [f](auto t, auto, auto) { return vec(f(t), 0.0 * t); }));
    const auto run = simulate(scene, {.t_end = t_end,
                                      .samples = 11,
                                      .tolerance = GetParam().tolerance,
                                      .stepper = GetParam().stepper,
                                      .ledger = ledger,
                                      .length = 1.0});
    return run.position(body, 10).x();
  }
  /// By a force of 1 N from a to b: the integral of sin(t_end - t).
  static double by_unit_force(double a, double b) { return std::cos(t_end - b) - std::cos(t_end - a); }
  /// A step errs by the tolerance, and a run of pushes of 3 N by a few dozen of them; a missed push by 0.1.
  [[nodiscard]] double error() const { return 300.0 * GetParam().tolerance; }
};
INSTANTIATE_TEST_SUITE_P(Runs, PushesByTime, both_steppers_at({1e-4, 1e-7, 1e-10}), tolerance_name);

TEST_P(PushesByTime, OfOnePieceOfFloorAreFelt) {
  const double right = 3.0 * by_unit_force(5.0, 6.0);
  EXPECT_NEAR(pushed([](auto t) { return floor(t) == 5.0 ? 3.0 + 0.0 * t : 0.0 * t; }), right, error());
  EXPECT_NEAR(pushed([](auto t) {
                const auto piece = floor(t);
                return piece > 4.5 && piece < 5.5 ? 3.0 + 0.0 * t : 0.0 * t;
              }),
              right, error());
}

TEST_P(PushesByTime, FromOnePieceOfFloorOnAreFelt) {
  EXPECT_NEAR(pushed([](auto t) { return floor(t) > 4.5 ? 3.0 + 0.0 * t : 0.0 * t; }),
              3.0 * by_unit_force(5.0, 10.0), error());
}

/// 0 at both ends, and at t_end if it went on: neither the switch nor the end of a step shows it.
TEST_P(PushesByTime, ByHalfASineAreFelt) {
  constexpr double a = 3.0, w = 0.5, pi = std::numbers::pi, k = pi / w;
  const auto push = [](auto t) { return t > a && t < a + w ? 3.0 * sin(k * (t - a)) : 0.0 * t; };
  // x(a + w) and its rate, of x'' + x = 3 sin(k (t - a)) from rest, then a free vibration.
  const double c = 3.0 / (1.0 - k * k), x = c * (std::sin(k * w) - k * std::sin(w)),
               v = c * k * (std::cos(k * w) - std::cos(w)), rest = t_end - a - w;
  EXPECT_NEAR(pushed(push), x * std::cos(rest) + v * std::sin(rest), error());
}

/// Between pieces in one line nothing changes; the piece behind these is not in line.
TEST_P(PushesByTime, OfATableAreThoseOfEachOfItsPieces) {
  const auto push = [](auto t) {
    const auto piece = floor(t);
    return piece > 6.5 ? 1.0 * (t - 7.0) : 0.0 * (t - piece);
  };
  const double rest = t_end - 7.0;  // x'' + x = t - 7 from rest
  EXPECT_NEAR(pushed(push), rest - std::sin(rest), error());
}

/// Of more than friction holds: 6 N on 1 kg with mu m g = 3 N, and what then slides comes to rest.
TEST_P(PushesByTime, LetARoughBlockSlideOnce) {
  for (const double a : {0.3, 0.5, 0.75}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -10.0}});
    const auto block = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
    const auto table = scene.add(OnCurve{block, Plane<2>{}});
    scene.add(coulomb(table, Slip{block, Plane<2>{}}, 0.3));
    scene.add(force_law(points(block), [a](auto t, auto, auto) {
      return vec(t > a && t < a + 0.2 ? 6.0 + 0.0 * t : 0.0 * t, 0.0 * t);
    }));
    const auto run =
        simulate(scene, {.t_end = 2.0, .tolerance = GetParam().tolerance, .stepper = GetParam().stepper});
    ASSERT_EQ(run.events().size(), 2U) << a;
    EXPECT_EQ(run.events()[0].kind, EventKind::slides);
    EXPECT_NEAR(run.events()[0].time, a, 1e-12);
    for (const auto& from : {run.event_sample(0), run.sample_after(0)}) {
      const auto rest = simulate(
          scene, from, {.t_end = 2.0, .tolerance = GetParam().tolerance, .stepper = GetParam().stepper});
      EXPECT_NEAR(rest.position(block, 100).x(), run.position(block, 100).x(), error()) << a;
    }
    EXPECT_EQ(run.events()[1].kind, EventKind::sticks);
    EXPECT_NEAR(run.events()[1].time, a + 0.4, error());
  }
}

TEST_P(PushesByTime, AreKeptInALedger) {
  constexpr double period = 0.6;
  double right = 0.0;
  for (int k = 0; k * period < t_end; ++k)
    right += by_unit_force(k * period, std::min((k + 0.5) * period, t_end));
  EXPECT_NEAR(pushed([](auto t) { return fmod(t, 0.6) < 0.3 ? 1.0 + 0.0 * t : 0.0 * t; }, true), right,
              error());
}

class PotentialsOfTime : public PushesByTime {};
INSTANTIATE_TEST_SUITE_P(Runs, PotentialsOfTime, both_steppers_at({1e-6, 1e-9}), tolerance_name);

/// The energy jumps with the potential: by no work, and no law is broken.
TEST_P(PotentialsOfTime, MaySwitchAtASampleOrBetween) {
  for (const double at : {2.0, 2.001, 2.03}) {
    Scene<2> scene;
    const auto body = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "body");
    scene.add(potential(points(body),
                        [at](auto t, auto r) { return (t > at ? 2.0 : 0.5) * r.squaredNorm() + 0.0 * t; }));
    const auto run =
        simulate(scene, {.t_end = 4.0, .tolerance = GetParam().tolerance, .stepper = GetParam().stepper});
    const double rest = 4.0 - at;
    EXPECT_NEAR(run.position(body, 100).x(),
                std::cos(at) * std::cos(2.0 * rest) - 0.5 * std::sin(at) * std::sin(2.0 * rest), error());
  }
}

/// With something to be found each sample is looked at twice: what happens there comes first. An instant that
/// is read again shows no less. F = 40 N from 0.7 s on.
TEST_P(PotentialsOfTime, MaySwitchAtASampleWhateverElseMayHappen) {
  constexpr double at = 0.7;
  for (const double level : {-1.0, 0.1}) {
    for (const bool at_once : {false, true}) {
      Scene<2> scene;
      const auto body = scene.add_particle({.mass = 2.0, .velocity = {1.0, 0.0}}, "body");
      scene.add(potential(points(body), [at_once](auto t, auto r) {
        return (at_once ? t < at : t <= at) ? 0.0 * r.x() : -40.0 * r.x();
      }));
      const Event<2> passes{.name = "passes",
                            .function = [=](const Sample<2>& now) { return now.position(body).x() - level; }};
      const auto run = simulate(
          scene,
          {.t_end = 1.4, .samples = 11, .tolerance = GetParam().tolerance, .stepper = GetParam().stepper},
          {passes});
      EXPECT_NEAR(run.position(body, 10).x(), 1.4 + 0.5 * 20.0 * at * at, 10.0 * error());
      EXPECT_EQ(run.events().size(), level > 0.0 ? 1U : 0U);
    }
  }
}

}  // namespace
}  // namespace dalembert::pushes_by_time_test
