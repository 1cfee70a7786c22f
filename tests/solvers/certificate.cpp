#include <dalembert/dalembert.h>
#include <dalembert/models/bouncing_ball.h>
#include <dalembert/models/double_pendulum.h>
#include <dalembert/models/four_bar.h>
#include <dalembert/models/particle_off_sphere.h>
#include <dalembert/models/plane_pendulum.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace dalembert::certificate_test {
namespace {

using testing::HasSubstr;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// An estimate is the difference from a run that is at least five times as accurate.
void expect_within_a_fifth(double estimated, double truth, const std::string& what) {
  EXPECT_GE(estimated, 0.8 * truth) << what;
  EXPECT_LE(estimated, 1.25 * truth) << what;
}

class CertificateBy : public testing::TestWithParam<Stepper> {};

std::string stepper_name(const testing::TestParamInfo<Stepper>& info) { return name(info.param); }
INSTANTIATE_TEST_SUITE_P(BothSteppers, CertificateBy, testing::Values(Stepper::ida, Stepper::erk),
                         stepper_name);

/// A cart, x = t^2, takes another along from x = 1, which an event couples to it: both go on at half its
/// speed and acceleration. A sample lies at that time, of which either run may show either side.
TEST_P(CertificateBy, ASampleAtAChangeIsAtAJump) {
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    Scene<2> scene;
    const auto first = scene.add_particle({.mass = 1.0}), second = scene.add_particle({.mass = 1.0});
    scene.add(PointGravity{first, 1.0, Vec<2>{2.0, 0.0}});
    const auto coupling = scene.add(
        nonholonomic(points(first, second), [](auto, auto, auto v, auto w) { return v.x() - w.x(); }));
    scene.release(coupling);
    const Event<2> couple{.name = "couple",
                          .function = [=](const Sample<2>& now) { return now.position(first).x() - 1.0; },
                          .crossing = Crossing::rising,
                          .change = [=](Scene<2>& its) { its.impose(coupling); }};
    const auto found =
        certify(scene, {.t_end = 2.0, .samples = 5, .tolerance = tolerance, .stepper = GetParam()}, {couple});
    EXPECT_TRUE(found.complete()) << found.statement();
    EXPECT_EQ(found.doubt(3), Doubt::none) << tolerance;
    const double before = found.run().velocity(second, 2).x();
    EXPECT_TRUE(std::abs(before) < 1e-3 || std::abs(before - 1.0) < 1e-3) << before;
    const double error = std::abs(found.run().velocity(second, 4).x() - 2.0);
    EXPECT_LE(error, 1.25 * found.velocity_error(second, 4) + 1e-14);
  }
}

/// An event that changes nothing begins a run anew, with other round-off.
TEST_P(CertificateBy, AChangeOfNothingIsNoJump) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {0.6, -0.8}});
  const auto rod = scene.add(Distance{Fixed<2>{}, bob, 1.0});
  const auto at_1 = [](const Sample<2>& now) { return now.time() - 1.0; };
  const Event<2> nothing{.name = "nothing", .function = at_1, .change = [](Scene<2>&) {}};
  for (const double tolerance : {1e-5, 1e-8}) {
    const auto found = certify(
        scene, {.t_end = 2.0, .samples = 3, .tolerance = tolerance, .stepper = GetParam()}, {nothing});
    EXPECT_EQ(found.doubt(1), Doubt::none);
    EXPECT_LT(found.multiplier_error(rod, 1), 1e3 * tolerance);
  }
}

/// x = t^2 reaches 1 at about 1: then the other one is put 3 further, and goes on as before.
TEST_P(CertificateBy, WhatAChangeMovesIsNotKnownThere) {
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    Scene<2> scene;
    const auto clock = scene.add_particle({.mass = 1.0}),
               moved = scene.add_particle({.mass = 1.0, .position = {0.0, 5.0}, .velocity = {0.5, 0.0}});
    scene.add(PointGravity{clock, 1.0, Vec<2>{2.0, 0.0}});
    const Event<2> move{
        .name = "move",
        .function = [=](const Sample<2>& now) { return now.position(clock).x() - 1.0; },
        .crossing = Crossing::rising,
        .change =
            [=](Scene<2>& its) {
              its.replace(moved, {.mass = 1.0, .position = {3.5, 5.0}, .velocity = {0.5, 0.0}});
            }};
    const auto found =
        certify(scene, {.t_end = 2.0, .samples = 5, .tolerance = tolerance, .stepper = GetParam()}, {move});
    EXPECT_TRUE(found.complete()) << found.statement();
    EXPECT_EQ(found.position_error(moved, 2), infinity);
    EXPECT_LT(found.velocity_error(moved, 2), 1e-13);
    const double error = std::abs(found.run().position(moved, 4).x() - 4.0);
    EXPECT_LE(error, 1.25 * found.position_error(moved, 4));
    EXPECT_LT(found.position_error(moved, 4), 10.0 * tolerance);
  }
}

/// A load of 10 N is exchanged for one of 20 where something else passes its middle, beside what weighs 1e8
/// N: a sample near that time may show either.
TEST_P(CertificateBy, AForceJumpsAlsoBesideALargerOne) {
  for (const double heavy : {1.0, 1e7}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -10.0}});
    const auto swings = scene.add_particle({.mass = 1.0, .position = {0.0, 10.0}});  // y = 12 - 2 cos t
    scene.add(OnCurve{swings, Plane<2>{{0.0, 0.0}, {1.0, 0.0}}});
    scene.add(Spring{Fixed<2>{}, swings, 1.0, 22.0});
    const auto bob = scene.add_particle({.mass = heavy, .position = {101.0, 0.0}});
    scene.add(Distance{Fixed<2>{{100.0, 0.0}}, bob, 1.0});
    const auto load = scene.add_particle({.mass = 1.0, .position = {5.0, -1.0}});
    const auto rod = scene.add(Distance{Fixed<2>{{5.0, 0.0}}, load, 1.0});
    const Event<2> exchange{.name = "exchange",
                            .function = [=](const Sample<2>& now) { return now.position(swings).y() - 12.0; },
                            .crossing = Crossing::rising,
                            .change =
                                [=](Scene<2>& its) {
                                  its.replace(load, {.mass = 2.0, .position = {5.0, -1.0}});
                                }};
    const double middle = 0.5 * std::numbers::pi;
    std::vector<double> times;
    for (int k = -100; k <= 100; ++k) times.push_back(middle + 1e-6 * k);
    const auto found =
        certify(scene, {.t_end = 3.0, .times = times, .tolerance = 1e-5, .stepper = GetParam()}, {exchange});
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double error =
          std::abs(std::abs(found.run().multiplier(rod, i)) - (times[i] < middle ? 10.0 : 20.0));
      EXPECT_LE(error, 1.25 * found.multiplier_error(rod, i) + 1e-9) << heavy << ' ' << times[i] - middle;
    }
  }
}

/// A load of 1 kg is set on a cable of k = 1e10 N/m: T = 10 (1 - cos(1e5 t)) for ever, of an amplitude of
/// 1e-9 m. Both implicit runs damp it; neither may say that T is 10. A load at rest on it is known, and one
/// whose vibration is damped at 1e4/s is from soon on; and what swings beside it on its own.
TEST(Certificate, VibrationsThatImplicitStepsPassOverCount) {
  constexpr double k = 1e10;
  enum class Load { vibrates, rests, damped };
  for (const Load which : {Load::vibrates, Load::rests, Load::damped}) {
    Scene<2> scene("load");
    scene.add(UniformGravity<2>{{0.0, -10.0}});
    const double stretched = which == Load::rests ? 10.0 / k : 0.0;
    const auto load = scene.add_particle({.mass = 1.0, .position = {0.0, -1.0 - stretched}});
    const auto cable = scene.add(compliant(Distance{Fixed<2>{}, load, 1.0}, 1.0 / k));
    if (which == Load::damped)
      scene.add(force_law(points(load), [](auto, auto v) { return (-2e4 * v).eval(); }));
    const auto bob = scene.add_particle({.mass = 1.0, .position = {6.0, 0.0}});
    const auto rod = scene.add(Distance{Fixed<2>{{5.0, 0.0}}, bob, 1.0});
    const auto found = certify(scene, {.t_end = 1.0, .sample_interval = 0.25, .tolerance = 1e-6});
    for (std::size_t i = 1; i < 5; ++i) {
      EXPECT_LT(found.multiplier_error(rod, i), 1e-2);
      EXPECT_LT(found.error([=](const auto& now) { return now.position(bob); }, i), 1e-3);
      if (which != Load::vibrates) {
        EXPECT_LT(found.multiplier_error(cable, i), 1e-3);
      } else {
        const double T = 10.0 * (1.0 - std::cos(1e5 * found.run().times()[i]));
        EXPECT_GE(found.multiplier_error(cable, i), 0.8 * std::abs(-found.run().multiplier(cable, i) - T));
      }
    }
  }
}

/// Dropped from h with restitution 1/2 it rests at 3 sqrt(2 h/g), after infinitely many impacts, of which the
/// better run lists more: what either gives at the last of them is of another time, and no error.
TEST_P(CertificateBy, ARestAfterInfinitelyManyImpactsHasATimeAndNoState) {
  const double g = 9.81;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto ball = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}, .velocity = {1.0, 0.0}});
  const auto floor = scene.add(unilateral(OnCurve{ball, Plane<2>{}}, {.restitution = 0.5}));
  const auto certificate = certify(scene, {.t_end = 2.0, .tolerance = 1e-6, .stepper = GetParam()});
  ASSERT_TRUE(certificate.complete()) << certificate.statement();
  const std::size_t rest = certificate.run().events().size() - 1;
  const double truth = std::abs(certificate.run().events()[rest].time - 3.0 * std::sqrt(2.0 / g));
  EXPECT_EQ(certificate.run().events()[rest].kind, EventKind::rested);
  EXPECT_GE(certificate.event_time_error(rest), 0.8 * truth);
  EXPECT_LT(certificate.event_time_error(rest), 1e-6);
  EXPECT_EQ(certificate.event_doubt(rest), Doubt::at_a_jump);
  EXPECT_THAT(certificate.statement(), HasSubstr("only the time is known"));
  EXPECT_EQ(certificate.impulse_error(floor, rest), infinity);
  EXPECT_LT(certificate.largest().position.error, 1e-6);  // 5e-5 with that of the last impact
}

/// Dropped from h with restitution e it leaves the floor at e sqrt(2 g h).
TEST_P(CertificateBy, TellsTheErrorBehindAnImpact) {
  const double g = 9.81;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto ball = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}});
  scene.add(unilateral(OnCurve{ball, Plane<2>{}}, {.restitution = 0.5}));
  const auto certificate = certify(scene, {.t_end = 0.8, .tolerance = 1e-6, .stepper = GetParam()});
  ASSERT_EQ(certificate.run().events().size(), 1U);
  const auto upwards = [ball](const Sample<2>& now) { return now.velocity(ball).y(); };
  const double truth = std::abs(upwards(certificate.run().sample_after(0)) - 0.5 * std::sqrt(2.0 * g));
  EXPECT_GE(certificate.error_after(upwards, 0), 0.8 * truth);
  EXPECT_LT(certificate.error_after(upwards, 0), 1e-6);
  EXPECT_THROW((void)certificate.error_after(upwards, 1), InvalidArgument);
}

/// Against sin(phi/2) = k sn(K - omega0 t).
TEST_P(CertificateBy, TellsTheErrorsOfAPendulum) {
  const models::PlanePendulum model;
  const auto built = model.scene();
  const auto bead = built.beads.front();
  const auto rod = built.rods.front();
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const auto certificate =
        certify(built.scene, {.t_end = 10.0, .tolerance = tolerance, .stepper = GetParam()});
    ASSERT_TRUE(certificate.complete()) << certificate.statement();
    double position = 0.0, tension = 0.0, position_error = 0.0, tension_error = 0.0;
    for (std::size_t i = 0; i < certificate.run().size(); ++i) {
      const auto due = model.reference(certificate.run().times()[i]);
      position = std::max(position, (certificate.run().position(bead, i) - due.positions[0]).norm());
      tension = std::max(tension, std::abs(-certificate.run().multiplier(rod, i) - due.forces[0]));
      position_error = std::max(position_error, certificate.position_error(bead, i));
      tension_error = std::max(tension_error, certificate.multiplier_error(rod, i));
    }
    expect_within_a_fifth(position_error, position, "position");
    expect_within_a_fifth(tension_error, tension, "tension");
    EXPECT_EQ(certificate.largest().position.error, position_error);
    EXPECT_EQ(certificate.largest().force.error, tension_error);
  }
}

/// A block on a spring and a rough line: half-turns of a circular function about +-mu m g/k, each ended by a
/// turn, until the spring holds less than friction; by hand.
TEST_P(CertificateBy, TellsTheErrorsOfFriction) {
  const double m = 2.0, g = 9.81, k = 50.0, mu = 0.2, x0 = 0.5;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto block = scene.add_particle({.mass = m, .position = {x0, 0.0}}, "block");
  const Plane<2> plane;
  const auto floor = scene.add(OnCurve{block, plane}, "floor");
  const auto rough = scene.add(coulomb(floor, Slip{block, plane}, mu, mu), "rough");
  scene.add(force_law(points(block), [=](auto, auto x, auto) { return (Vec<2>{-k, 0.0} * x[0]).eval(); }));
  const auto certificate = certify(scene, {.t_end = 4.0, .tolerance = 1e-6, .stepper = GetParam()});
  ASSERT_TRUE(certificate.complete()) << certificate.statement();
  const auto& run = certificate.run();
  const double omega = std::sqrt(k / m), half_turn = std::numbers::pi / omega, hold = mu * m * g / k;
  double position = 0.0, force = 0.0, position_error = 0.0, force_error = 0.0;
  for (std::size_t i = 0; i < run.size(); ++i) {
    double from = x0, t = run.times()[i], x = from, friction = 0.0;
    for (double sign = 1.0;; sign = -sign) {
      if (std::abs(from) <= hold) {  // it stays
        x = from;
        friction = k * from;
        break;
      }
      x = sign * hold + (from - sign * hold) * std::cos(omega * std::min(t, half_turn));
      friction = sign * mu * m * g;
      if (t <= half_turn) break;
      from = x;
      t -= half_turn;
    }
    position = std::max(position, std::abs(run.position(block, i).x() - x));
    if (i > 0) force = std::max(force, std::abs(run.constraint_force(rough, block, i).x() - friction));
    position_error = std::max(position_error, certificate.position_error(block, i));
    force_error = std::max(force_error, certificate.multiplier_error(rough, i));
  }
  expect_within_a_fifth(position_error, position, "position");
  expect_within_a_fifth(force_error, force, "friction");
}

/// m e'' = m g - e/C from e = 0 at rest: the force e/C is m g (1 - cos w t).
TEST_P(CertificateBy, TellsTheErrorsOfACompliantRod) {
  const double m = 1.0, g = 9.81, stiffness = 400.0;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto bob = scene.add_particle({.mass = m, .position = {0.0, -1.0}}, "bob");
  const auto rod = scene.add(compliant(Distance{Fixed<2>{{0.0, 0.0}}, bob, 1.0}, 1.0 / stiffness), "rod");
  const auto certificate =
      certify(scene, {.t_end = 3.1, .samples = 8, .tolerance = 1e-6, .stepper = GetParam()});
  ASSERT_TRUE(certificate.complete()) << certificate.statement();
  const auto& run = certificate.run();
  double tension = 0.0, tension_error = 0.0;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double due = m * g * (1.0 - std::cos(std::sqrt(stiffness / m) * run.times()[i]));
    tension = std::max(tension, std::abs(-run.multiplier(rod, i) - due));
    tension_error = std::max(tension_error, certificate.multiplier_error(rod, i));
  }
  expect_within_a_fifth(tension_error, tension, "tension");
}

/// Two equal rods side by side share a tension in a way that the motion does not determine; the sum is the
/// one of a pendulum, and so are the positions.
TEST_P(CertificateBy, TellsTheErrorsOfARedundantPendulum) {
  const models::PlanePendulum model;
  const auto built = model.scene();
  Scene<2> scene = built.scene;
  const auto bead = built.beads.front();
  const auto second = scene.add(Distance{Fixed<2>{{0.0, 0.0}}, bead, model.length}, "second rod");
  const auto certificate = certify(scene, {.t_end = 5.0, .tolerance = 1e-6, .stepper = GetParam()});
  ASSERT_TRUE(certificate.complete()) << certificate.statement();
  const auto& run = certificate.run();
  double position = 0.0, position_error = 0.0, tension = 0.0, tension_error = 0.0;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const auto due = model.reference(run.times()[i]);
    const auto sum = [&](const Sample<2>& now) {
      return -now.multiplier(built.rods.front()) - now.multiplier(second);
    };
    position = std::max(position, (run.position(bead, i) - due.positions[0]).norm());
    position_error = std::max(position_error, certificate.position_error(bead, i));
    tension = std::max(tension, std::abs(sum(run.sample(i)) - due.forces[0]));
    tension_error = std::max(tension_error, certificate.error(sum, i));
  }
  expect_within_a_fifth(position_error, position, "position");
  expect_within_a_fifth(tension_error, tension, "tension");
}

TEST_P(CertificateBy, HandsOutTheRunThatWasAskedFor) {
  const auto built = models::PlanePendulum{}.scene();
  const Options options{.t_end = 1.0, .tolerance = 1e-6, .stepper = GetParam()};
  const auto certificate = certify(built.scene, options);
  const auto run = simulate(built.scene, options);
  ASSERT_EQ(certificate.run().size(), run.size());
  for (std::size_t i = 0; i < run.size(); ++i)
    EXPECT_EQ(certificate.run().position(built.beads[0], i), run.position(built.beads[0], i));
  EXPECT_LT(certificate.reference().statistics().accuracy, 0.2 * run.statistics().accuracy);
}

TEST_P(CertificateBy, IsTheSameTwice) {
  const auto built = models::PlanePendulum{}.scene();
  const Options options{.t_end = 1.0, .tolerance = 1e-6, .stepper = GetParam()};
  EXPECT_EQ(certify(built.scene, options).statement(), certify(built.scene, options).statement());
}

/// t_k and m (1 + e) u_k, a geometric series each.
TEST_P(CertificateBy, TellsTheErrorsOfImpacts) {
  const models::BouncingBall model{.restitution = 0.8};
  const auto built = model.scene();
  const auto certificate = certify(built.scene, {.t_end = 0.5 * (model.impact_time(4) + model.impact_time(5)),
                                                 .tolerance = 1e-5,
                                                 .stepper = GetParam()});
  const auto& run = certificate.run();
  ASSERT_GE(run.events().size(), 5U);
  for (std::size_t k = 0; k < 5; ++k) {
    const double u = std::pow(0.8, static_cast<double>(k)) * std::sqrt(2.0 * model.gravity * model.height);
    const double time = std::abs(run.events()[k].time - model.impact_time(static_cast<int>(k))),
                 impulse = std::abs(run.impulse(built.floor, k) - model.mass * 1.8 * u);
    // By erk a parabola is exact: then the error is said to be round-off, five times the 1e4 roundings to
    // which impacts are told from none.
    constexpr double round_off = 5e4 * std::numeric_limits<double>::epsilon();
    EXPECT_GE(certificate.event_time_error(k), 0.8 * time);
    EXPECT_LE(certificate.event_time_error(k), std::max(1.25 * time, round_off * 4.0));
    EXPECT_GE(certificate.impulse_error(built.floor, k), 0.8 * impulse);
    EXPECT_LE(certificate.impulse_error(built.floor, k), std::max(1.25 * impulse, round_off * 20.0));
  }
}

/// A ball that rests after infinitely many impacts, of which the better run lists more.
TEST_P(CertificateBy, FollowsABallToRest) {
  const models::BouncingBall model{.restitution = 0.5};
  const auto built = model.scene();
  const auto certificate =
      certify(built.scene,
              {.t_end = 1.5 * model.rest_time(), .samples = 11, .tolerance = 1e-6, .stepper = GetParam()});
  EXPECT_GT(certificate.reference().events().size(), certificate.run().events().size());
  ASSERT_TRUE(certificate.complete()) << certificate.statement();
  ASSERT_EQ(certificate.run().events().back().kind, EventKind::rested);
  EXPECT_GE(certificate.event_time_error(certificate.run().events().size() - 1),
            0.8 * std::abs(certificate.run().events().back().time - model.rest_time()));
}

/// Of a sample at an impact nobody knows the velocity: it depends on which comes first.
TEST(Certificate, DoesNotKnowVelocitiesWhereAnImpactMayBeBeforeOrAfter) {
  const models::PlanePendulum model;
  const auto hung = model.scene();
  Scene<2> scene = hung.scene;
  const auto bead = hung.beads[0];
  scene.add(unilateral(holonomic(points(bead), [](auto r) { return r.x(); }), {.restitution = 0.9}), "wall");
  const double impact = model.period() / 4.0;
  const auto certificate = certify(
      scene, {.t_end = 1.5 * impact, .times = {0.5 * impact, impact, 1.2 * impact}, .tolerance = 1e-5});
  EXPECT_EQ(certificate.doubt(1), Doubt::at_a_jump);
  EXPECT_EQ(certificate.velocity_error(bead, 1), infinity);
  EXPECT_LT(certificate.position_error(bead, 1), 1e-2);
  EXPECT_LT(certificate.velocity_error(bead, 0), 1e-2);
  EXPECT_LT(certificate.velocity_error(bead, 2), 1e-2);
  EXPECT_THAT(certificate.statement(), HasSubstr("not known at 1 samples"));
}

/// A ball that falls for 1 s and d: two runs may give the same time for its impact and both be off by
/// round-off. Beyond the error of that time the velocity is known, and on the right side.
TEST_P(CertificateBy, KnowsTheVelocityBesideAnImpactOnlyBeyondTheErrorOfItsTime) {
  const double g = 9.81;
  int known = 0;
  for (const double d : {1e-15, 3e-15, 1e-14, 4e-14, 1e-13, 1e-12, 1e-9}) {
    for (const double fall : {1.0 - d, 1.0 + d}) {
      Scene<2> scene;
      scene.add(UniformGravity<2>{{0.0, -g}});
      const auto ball = scene.add_particle({.mass = 0.3, .position = {0.0, 0.5 * g * fall * fall}});
      scene.add(unilateral(OnCurve{ball, Plane<2>{}}, {.restitution = 0.8}));
      const double after = 0.8 * g * fall - g * (1.0 - fall);
      for (const double tolerance : {1e-8, 1e-11}) {
        const auto certificate =
            certify(scene, {.t_end = 1.5, .times = {1.0}, .tolerance = tolerance, .stepper = GetParam()});
        const double error = std::abs(certificate.run().velocity(ball, 0).y() - (fall > 1.0 ? -g : after));
        EXPECT_GE(certificate.velocity_error(ball, 0), 0.8 * error) << fall - 1.0;
        if (certificate.doubt(0) == Doubt::none) ++known;
        if (d < certificate.event_time_error(0)) {
          EXPECT_EQ(certificate.doubt(0), Doubt::at_a_jump);
        }
      }
    }
  }
  EXPECT_GE(known, 4);  // 1e-9 is far from round-off
}

/// The clock of a late start is rounded, to 2^-52 of 1e6. That is not multiplied by what a contact takes for
/// 0, which is a part of the motion.
TEST_P(CertificateBy, KnowsTheTimesOfImpactsToRoundOffOfTheClockAtALateStart) {
  const double g = 9.81, start = 1e6;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto ball = scene.add_particle({.mass = 0.3, .position = {0.0, 1.0}});
  scene.add(unilateral(OnCurve{ball, Plane<2>{}}, {.restitution = 0.8}));
  const auto certificate =
      certify(scene, {.t_end = start + 2.0, .t_start = start, .tolerance = 1e-8, .stepper = GetParam()});
  const double fall = std::sqrt(2.0 / g);
  const double first = std::abs(certificate.run().events()[0].time - start - fall),
               second = std::abs(certificate.run().events()[1].time - start - 2.6 * fall);
  EXPECT_GE(certificate.event_time_error(0), 0.8 * first);
  EXPECT_GE(certificate.event_time_error(1), 0.8 * second);
  // A few hundred roundings of the clock; the 5e4 of what is 0 would be 1e-5.
  EXPECT_LT(certificate.event_time_error(1), 1000.0 * std::numeric_limits<double>::epsilon() * start);
}

/// A double pendulum from high up, at a loose tolerance: neighbouring motions part by e in about a tenth of a
/// second, so that the difference is of the size of the motion long before the end.
TEST(Certificate, SaysHowFarAChaoticMotionIsKnown) {
  const models::DoublePendulum model{.angle1 = 3.0, .angle2 = 3.0};
  const auto built = model.scene();
  const Options options{.t_end = 40.0, .samples = 401, .tolerance = 1e-5, .stepper = Stepper::erk};
  const auto certificate = certify(built.scene, options);
  EXPECT_FALSE(certificate.complete());
  const double until = certificate.runs().known_until();
  EXPECT_GT(until, 1.0);
  EXPECT_LT(until, 39.0);
  EXPECT_THAT(certificate.statement(), HasSubstr("the runs have parted"));
  const std::size_t last = certificate.run().size() - 1;
  EXPECT_EQ(certificate.doubt(last), Doubt::horizon);
  EXPECT_EQ(certificate.position_error(built.beads[1], last), infinity);
  // Before that its estimates are those of a much tighter run.
  const auto tight =
      simulate(built.scene, {.t_end = 40.0, .samples = 401, .tolerance = 1e-12, .stepper = Stepper::erk});
  double truth = 0.0, estimated = 0.0;
  for (std::size_t i = 0; certificate.run().times()[i] < until; ++i) {
    truth = std::max(
        truth, (certificate.run().position(built.beads[1], i) - tight.position(built.beads[1], i)).norm());
    estimated = std::max(estimated, certificate.position_error(built.beads[1], i));
  }
  expect_within_a_fifth(estimated, truth, "before the horizon");
}

/// A free fall is exact to round-off in every explicit run: no difference tells its error.
TEST(Certificate, IsNeverSmallerThanRoundOff) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto stone = scene.add_particle({.mass = 1.0, .velocity = {1.0, 2.0}});
  const auto certificate = certify(scene, {.t_end = 10.0, .tolerance = 1e-8, .stepper = Stepper::erk});
  const auto& run = certificate.run();
  for (std::size_t i = 1; i < run.size(); ++i) {
    const double t = run.times()[i];
    const double truth = (run.position(stone, i) - Vec<2>(t, 2.0 * t - 0.5 * 9.81 * t * t)).norm();
    EXPECT_GE(certificate.position_error(stone, i), 0.2 * truth);  // errors by chance may be alike
    EXPECT_GT(certificate.position_error(stone, i), 0.0);
  }
}

TEST(Certificate, SaysWhereThereIsNoBetterRun) {
  const auto built = models::PlanePendulum{}.scene();
  const auto certificate = certify(built.scene, {.t_end = 10.0, .tolerance = 1e-13, .stepper = Stepper::erk});
  EXPECT_FALSE(certificate.complete());
  EXPECT_EQ(certificate.doubt(50), Doubt::no_better_run);
  EXPECT_THAT(certificate.statement(), HasSubstr("there is no more accurate run"));
}

/// A pendulum released at the height of its pivot rises to it again. In a run that errs it rises higher, or
/// less high: by more than 1e-7 at so loose a tolerance.
TEST(Certificate, SaysWhereSomethingHappensInOneRunOnly) {
  const models::PlanePendulum model;
  const auto built = model.scene();
  const auto bead = built.beads[0];
  const std::vector<Event<2>> events{
      {"is up", [=](const auto& now) { return now.position(bead).y() + 1e-7; }, Crossing::rising},
      {"is higher", [=](const auto& now) { return now.position(bead).y() - 1e-7; }, Crossing::rising}};
  const auto certificate = certify(built.scene, {.t_end = 0.8 * model.period(), .tolerance = 1e-3}, events);
  EXPECT_FALSE(certificate.complete());
  EXPECT_EQ(certificate.doubt(100), Doubt::other_events);
  EXPECT_EQ(certificate.position_error(bead, 100), infinity);
  EXPECT_LT(certificate.position_error(bead, 50), 0.1);
  EXPECT_THAT(certificate.statement(), HasSubstr(" happens at t = "));
}

/// Vibrations of a spring of 1e8 N/m: explicit steps would have to follow them.
TEST(Certificate, ComparesTwoImplicitRunsOfAStiffScene) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  scene.add(compliant(Distance{Fixed<2>{{0.0, 0.0}}, bob, 1.0}, 1e-8), "rod");
  const auto certificate = certify(scene, {.t_end = 1.0, .tolerance = 1e-6});
  EXPECT_THAT(certificate.statement(), HasSubstr("by ida at tolerance 1e-06, against ida at 1e-08"));
  EXPECT_TRUE(certificate.complete()) << certificate.statement();
}

/// The N-four-bar's rods are all in line at an instant, and their forces not determined.
TEST(Certificate, DoesNotKnowAForceThatIsNotDetermined) {
  Scene<2> scene;
  const auto stone = scene.add_particle({.mass = 1.0});
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto left = scene.add(Distance{Fixed<2>{{-1.0, 0.0}}, stone, 1.0}, "left");
  const auto certificate = certify(scene, {.t_end = 1.0});
  const auto undetermined = [](const Sample<2>&) -> double { throw UndeterminedForce("not now"); };
  EXPECT_EQ(certificate.error(undetermined, 3), infinity);
  EXPECT_LT(certificate.multiplier_error(left, 3), 1e-3);
}

TEST(Certificate, RefusesWhatMakesNoSense) {
  const auto built = models::PlanePendulum{}.scene();
  EXPECT_THROW((void)certify(built.scene, {.t_end = -1.0}), InvalidArgument);
  EXPECT_THROW((void)certify(built.scene, {.t_end = 1.0, .tolerance = 0.0}), InvalidArgument);
  const auto certificate = certify(built.scene, {.t_end = 1.0});
  const auto other = models::PlanePendulum{}.scene();
  EXPECT_THROW((void)certificate.position_error(built.beads[0], 101), InvalidArgument);
  EXPECT_THROW((void)certificate.position_error(other.beads[0], 0), InvalidArgument);
  EXPECT_THROW((void)certificate.event_time_error(0), InvalidArgument);
  EXPECT_THROW((void)certificate.impulse_error(built.rods[0], 0), InvalidArgument);
}

/// What stops the run that was asked for stops the certificate.
TEST(Certificate, StopsWithTheRun) {
  const auto built = models::PlanePendulum{}.scene();
  EXPECT_THROW((void)certify(built.scene, {.t_end = 10.0, .max_steps = 5}), IntegrationFailure);
}

/// A bob at rest below its pivot pulls with its weight; of a door on two hinges one above the other only the
/// sum of the vertical forces is determined.
TEST(ForceReport, NamesEveryConstraintWithItsLargestForceAndMeaning) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -10.0}});
  const auto bob = scene.add_particle({.mass = 2.0, .position = {0.0, -1.0}}, "bob");
  scene.add(Distance{Fixed<2>{{0.0, 0.0}}, bob, 1.0}, "rod");
  const Options options{.t_end = 1.0};
  EXPECT_EQ(report(simulate(scene, options)),
            "Distance \"rod\": largest 20 at t = 0, unique; force in the rod: < 0 pulls its ends together, "
            "tension is -lambda\n");
  EXPECT_THAT(report(certify(scene, options)), HasSubstr("largest 20 +- "));
  scene.add(Distance{Fixed<2>{{0.0, 0.0}}, bob, 1.0}, "another");
  EXPECT_THAT(report(simulate(scene, options)), HasSubstr("\"rod\": largest 10 at t = 0, not unique"));
}

/// Of a run as short as this one steps are as long as the first of them allow: two of the same steps show no
/// error.
TEST(Certificate, ErrorOfAShortRunIsKnown) {
  constexpr double g = 9.81, t_end = 0.3;
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -g}});
    const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "bob");
    scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");
    const Options options{.t_end = t_end, .samples = 2, .tolerance = tolerance, .stepper = Stepper::erk};
    const auto short_run = certify(scene, options);
    Options exact = options;
    exact.tolerance = 1e-13;
    const double truth = (simulate(scene, exact).position(bob, 1) - short_run.run().position(bob, 1)).norm();
    constexpr double rounding = 1e-13;  // of the exact run
    EXPECT_LE(truth, 1.5 * short_run.position_error(bob, 1) + rounding) << tolerance;
  }
}

}  // namespace
}  // namespace dalembert::certificate_test
