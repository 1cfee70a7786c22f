#include <dalembert/core/results/ledger.h>
#include <dalembert/tests/solvers/with_events.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <ranges>
#include <string>

namespace dalembert::ledger_test {
namespace {

/// What belongs to "impacts", or to the element of that name, at a sample.
double of(const std::vector<Ledger::Account>& accounts, const std::string& name, std::size_t sample) {
  const auto account = std::ranges::find_if(accounts, [&](const Ledger::Account& one) {
    return one.name == name || one.name.ends_with(" \"" + name + '"');
  });
  if (account != accounts.end()) return account->values[sample];
  ADD_FAILURE() << "no account of " << name;
  return std::numeric_limits<double>::quiet_NaN();
}

class Ledgers : public WithEvents {
 protected:
  [[nodiscard]] static Options kept(double t_end) {
    Options with = options(t_end);
    with.ledger = true;
    return with;
  }
};
INSTANTIATE_TEST_SUITE_P(Runs, Ledgers, at_usual_tolerance, tolerance_name);

TEST_P(Ledgers, BouncingBallHasTheLossOfItsImpactsAndTheImpulseOfTheGround) {
  // It falls from h, strikes at v = sqrt(2 g h), and leaves at e v.
  constexpr double m = 2.0, h = 1.0, e = 0.5;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto ball = scene.add_particle({.mass = m, .position = {3.0, h}}, "ball");
  scene.add(unilateral(OnCurve{ball, Plane<2>{}}, {.restitution = e}), "floor");
  const auto run = simulate(scene, kept(0.6));
  const Ledger& ledger = run.ledger();
  const double strikes = std::sqrt(2.0 * h / g), v = g * strikes, allowed = bound * m * v * v;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i], P = t > strikes ? m * (1.0 + e) * v : 0.0;
    EXPECT_NEAR(of(ledger.work, "impacts", i), t > strikes ? -0.5 * m * v * v * (1.0 - e * e) : 0.0, allowed);
    EXPECT_NEAR(of(ledger.work, "constant forces", i), m * g * (h - run.position(ball, i).y()), allowed);
    EXPECT_NEAR(ledger.potential.values[i], m * g * run.position(ball, i).y(), allowed);
    EXPECT_NEAR(ledger.ground_impulse[i][1], P, allowed);
    EXPECT_NEAR(ledger.ground_moment[i][2], 3.0 * P, 3.0 * allowed);
    EXPECT_NEAR(ledger.applied_impulse[i][1], -m * g * t, allowed);
    EXPECT_NEAR(ledger.momentum[i][1], P - m * g * t, allowed);
    EXPECT_NEAR(ledger.angular_momentum[i][2], 3.0 * (P - m * g * t), 3.0 * allowed);
  }
}

TEST_P(Ledgers, StoppingBlockHasTheWorkOfFriction) {
  // It slides x = v t - mu g t^2 / 2 until v = mu g t; the moment of the floor is that of m g at x.
  // x dt less.
  constexpr double m = 2.0, v = 2.0, mu = 0.4;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto block = scene.add_particle({.mass = m, .velocity = {v, 0.0}}, "block");
  const auto floor = scene.add(unilateral(OnCurve{block, Plane<2>{}}), "floor");
  scene.add(coulomb(floor, Slip{block, Plane<2>{}}, mu), "rough");
  const auto run = simulate(scene, kept(1.0));
  const Ledger& ledger = run.ledger();
  const double rests = v / (mu * g), allowed = bound * m * v * v;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i], s = std::min(t, rests);
    const double x = v * s - 0.5 * mu * g * s * s;
    const double integral = v * s * s / 2.0 - mu * g * s * s * s / 6.0 + x * (t - s);
    EXPECT_NEAR(of(ledger.work, "rough", i), -mu * m * g * x, allowed);
    EXPECT_NEAR(of(ledger.work, "floor", i), 0.0, allowed);
    EXPECT_NEAR(ledger.kinetic.values[i], 0.5 * m * v * v - mu * m * g * x, allowed);
    EXPECT_NEAR(ledger.ground_impulse[i][0], -mu * m * g * s, allowed);
    EXPECT_NEAR(ledger.ground_impulse[i][1], m * g * t, m * g * bound);
    EXPECT_NEAR(ledger.ground_moment[i][2], m * g * integral, m * g * bound);
    EXPECT_NEAR(ledger.applied_moment[i][2], -m * g * integral, m * g * bound);
  }
}

TEST_P(Ledgers, BeadOnATurningRodHasTheWorkAndMomentOfTheDrive) {
  // r = r0 cosh(w t) along the rod; E = m w^2 r0^2 cosh(2 w t) / 2, L = m w r^2.
  constexpr double m = 2.0, r0 = 0.5, w = 1.5;
  Scene<2> scene;
  const auto bead = scene.add_particle({.mass = m, .position = {r0, 0.0}, .velocity = {0.0, w * r0}}, "bead");
  scene.add(holonomic(points(bead), [](auto t, auto r) { return r.y() * cos(w * t) - r.x() * sin(w * t); }),
            "rod");
  const auto run = simulate(scene, kept(1.0));
  const Ledger& ledger = run.ledger();
  const double E = m * w * w * r0 * r0;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i], c = std::cosh(w * t), gained = 0.5 * E * (std::cosh(2.0 * w * t) - 1.0);
    const double allowed = bound * E * std::cosh(2.0 * w * t);
    EXPECT_NEAR(of(ledger.work, "rod", i), gained, allowed);
    EXPECT_NEAR(ledger.kinetic.values[i], 0.5 * E + gained, allowed);
    EXPECT_NEAR(ledger.angular_momentum[i][2], m * w * r0 * r0 * c * c, allowed);
    EXPECT_NEAR(ledger.ground_moment[i][2], m * w * r0 * r0 * (c * c - 1.0), allowed);
    EXPECT_NEAR(ledger.ground_impulse[i][0], ledger.momentum[i][0] - ledger.momentum[0][0], allowed);
  }
}

TEST_P(Ledgers, InnerRodsOfABodyHaveNoAccount) {
  // What no user stated is one account: the body, a rod of length 1 on a pivot, is held together without
  // work.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto body =
      add_thin_rod(scene, ThinRodState<2>{.mass = 1.0, .start = {0.0, 0.0}, .end = {1.0, 0.0}}, "rod");
  scene.add(Coincident{Fixed<2>{}, body.start()}, "pivot");
  const auto plate =
      add_body(scene, BodyState<2>{.mass = 1.0, .inertia = 0.1, .centre = {1.0, 0.0}}, "plate");
  scene.add(Coincident{body.end(), plate.point_at({1.0, 0.0})}, "hinge");
  const auto run = simulate(scene, kept(1.0));
  const Ledger& ledger = run.ledger();
  std::vector<std::string> names;
  for (const auto& account : ledger.work) names.push_back(account.name);
  EXPECT_THAT(names, testing::ElementsAre("constant forces", "Coincident \"pivot\"", "Coincident \"hinge\"",
                                          "what holds bodies together", "impacts", "changes of the scene"));
  for (std::size_t i = 0; i < run.size(); ++i)
    EXPECT_NEAR(of(ledger.work, "what holds bodies together", i), 0.0, bound * g);
}

TEST_P(Ledgers, CompliantRodHasItsElasticEnergyAndAChangeTheEnergyItPutIn) {
  // x = A cos(w t) about the rod's length, w^2 = 1 / (m C); at a quarter of the period the user doubles the
  // velocity.
  constexpr double m = 2.0, A = 0.1, C = 0.02;
  const double w = 1.0 / std::sqrt(m * C), quarter = 0.5 * std::numbers::pi / w, E = 0.5 * A * A / C;
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = m, .position = {1.0 + A, 0.0}}, "bob");
  scene.add(compliant(Distance{Fixed<2>{}, bob, 1.0}, C), "rod");
  const Event<2> kick{
      "kick", [=](const auto& now) { return now.time() - quarter; }, Crossing::rising, false,
      [=](Scene<2>& s) {
        s.replace(bob, ParticleState<2>{.mass = m, .position = {1.0, 0.0}, .velocity = {-2.0 * A * w, 0.0}});
      }};
  const auto run = simulate(scene, kept(1.5 * quarter), {kick});
  const Ledger& ledger = run.ledger();
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i], factor = t > quarter ? 2.0 : 1.0, x = factor * A * std::cos(w * t);
    EXPECT_NEAR(of(ledger.elastic, "rod", i), 0.5 * x * x / C, bound * E);
    EXPECT_NEAR(of(ledger.work, "rod", i),
                factor * factor * E - 0.5 * x * x / C - (t > quarter ? 3.0 * E : 0.0), bound * E);
    EXPECT_NEAR(of(ledger.work, "changes of the scene", i), t > quarter ? 3.0 * E : 0.0, bound * E);
    EXPECT_NEAR(ledger.kinetic.values[i], factor * factor * E - 0.5 * x * x / C, bound * E);
  }
}

TEST(LedgerOfARun, IsReadWhereItWasAskedFor) {
  Scene<2> scene;
  scene.add_particle({.mass = 1.0});
  const auto run = simulate(scene, {.t_end = 1.0, .samples = 2, .length = 1.0});
  EXPECT_THAT([&] { (void)run.ledger(); },
              testing::ThrowsMessage<InvalidArgument>(testing::HasSubstr(".ledger = true")));
  const auto kept =
      simulate(scene, {.t_end = 1.0, .samples = 2, .dense = true, .ledger = true, .length = 1.0});
  const std::vector<double> times{0.3};
  const auto between = kept.at(times);
  EXPECT_THAT([&] { (void)between.ledger(); }, testing::ThrowsMessage<InvalidArgument>(
                                                   testing::HasSubstr("ask the run, not what at() reads")));
}

}  // namespace
}  // namespace dalembert::ledger_test
