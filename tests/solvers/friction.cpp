#include "../both_steppers.h"
#include <dalembert/dalembert.h>
#include <dalembert/eigen.h>

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace dalembert::friction_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double g = 9.81;
constexpr double tolerance = 1e-8;
/// What the models of the catalogue keep to: errors of less than 1000 times the tolerance. Sliding friction
/// lets neighbouring motions approach each other.
constexpr double error = 1000.0 * tolerance;
/// A multiplier solved for in systems of a few unknowns of condition below ten: some roundings.
constexpr double rounding = 1e-13;

auto coulomb(double mu) {
  return [mu](auto lambda, auto, auto v) { return (-mu * abs(lambda) * v.normalized()).eval(); };
}

class Sliding : public testing::TestWithParam<Stepper> {
 protected:
  [[nodiscard]] static Options options(double t_end) {
    return {.t_end = t_end, .samples = 21, .tolerance = tolerance, .stepper = GetParam()};
  }
};
INSTANTIATE_TEST_SUITE_P(ByBothSteppers, Sliding, both_steppers, stepper_name);

/// A bead that slides down an incline: N = m g cos(alpha), a = g (sin(alpha) - mu cos(alpha)). The plane is
/// rigid, or a spring already as far compressed as N compresses it.
void expect_slides_down(const Options& options, double compliance) {
  const double alpha = 0.6, mu = 0.3, m = 2.0, v0 = 0.5;
  const Vec<2> normal(std::sin(alpha), std::cos(alpha)), down(std::cos(alpha), -std::sin(alpha));
  const double N = m * g * std::cos(alpha);
  const double a = g * (std::sin(alpha) - mu * std::cos(alpha));
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto bead =
      scene.add_particle({.mass = m, .position = -compliance * N * normal, .velocity = v0 * down});
  const auto plane =
      scene.add(compliant(OnCurve{bead, Plane<2>{Vec<2>::Zero(), normal}}, compliance), "incline");
  scene.add(friction_law(plane, points(bead), coulomb(mu)), "rough");
  const auto run = simulate(scene, options);
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i];
    const double s = v0 * t + 0.5 * a * t * t;
    EXPECT_NEAR(run.position(bead, i).dot(down), s, error * (1.0 + s));
    EXPECT_NEAR(run.velocity(bead, i).dot(down), v0 + a * t, error * (1.0 + s));
    // A spring's force errs by its stiffness times the position, so by the tolerance of the motion.
    EXPECT_NEAR(run.multiplier(plane, i), N, N * (compliance > 0.0 ? error : rounding));
  }
}

// A body beside it, whose inner forces are large: the friction makes all be factored as one matrix, of whose
// pivots KLU lets some be a thousand times too small. Sums of some hundred terms are right to 100 roundings
// of them, a fiftieth of what is allowed at 1e-12; without refinement it was up to 0.04 here and 0.4
// elsewhere.
TEST_P(Sliding, KeepsNewtonsEquationsToRoundOffBesideABody) {
  const Vec<3> axis = Vec<3>(0.3, -0.8, 0.5).normalized();
  for (const double turn : {0.2, 0.9, 1.7, 2.6}) {
    Scene<3> scene;
    scene.add(UniformGravity<3>{{1.0, -2.0, -g}});
    const auto body = add_body(
        scene,
        {.mass = 0.6,
         .inertia = {0.039, 0.032, 0.018},
         .centre = {0.7, 0.3, -0.4},
         .axes = Eigen::AngleAxisd(turn, eigen(axis.cross(Vec<3>::UnitX()).normalized())).toRotationMatrix()},
        "body");
    add_joint(scene, Revolute{Ground<3>{}, body, Vec<3>(0.0, 0.0, 0.0), axis}, "hinge");
    const auto bead = scene.add_particle({.mass = 0.8, .velocity = {0.5, 0.5, 0.0}}, "bead");
    const auto plane = scene.add(OnSurface{bead, Plane<3>{{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}}, "plane");
    scene.add(friction_law(plane, points(bead), [](auto lambda, auto, auto v) {
      return (-0.3 * abs(lambda) / sqrt(v.squaredNorm() + 0.01) * v).eval();
    }));
    Options tight = options(1.5);
    tight.tolerance = 1e-12;
    const auto run = simulate(scene, tight);
    const auto& worst = run.audit().worst;
    const auto newton = std::ranges::find(worst, Law::newton, &Finding::law);
    ASSERT_NE(newton, worst.end());
    EXPECT_LT(newton->ratio(), 0.02) << newton->element;
  }
}

TEST_P(Sliding, IsUniformlyAcceleratedDownARoughIncline) { expect_slides_down(options(1.0), 0.0); }

// What is pulled along a table without weight presses on it by round-off, of either sign, which |N| must not
// hear: the motion is that of the pull, and can be read between samples, in whatever direction.
TEST_P(Sliding, HasNoFrictionOnATableThatIsNotPressed) {
  const double m = 1.3, f = 2.0, v0 = 0.7, t = 0.37;
  for (int k = 0; k < 40; ++k) {
    const double angle = 0.16 * k;
    const Vec<2> normal(std::cos(angle), std::sin(angle)), along(-normal.y(), normal.x());
    Scene<2> scene;
    const auto bead = scene.add_particle({.mass = m, .velocity = v0 * along});
    const auto table = scene.add(OnCurve{bead, Plane<2>{Vec<2>::Zero(), normal}}, "table");
    scene.add(PointGravity{bead, m, f / m * along}, "pull");
    scene.add(friction_law(table, points(bead), coulomb(0.3)), "rough");
    Options dense = options(1.0);
    dense.dense = true;
    const auto run = simulate(scene, dense);
    EXPECT_NEAR(run.at({t}).position(bead, 0).dot(along), v0 * t + 0.5 * f / m * t * t, error);
    EXPECT_NEAR(run.at({t}).multiplier(table, 0), 0.0, f * rounding);
  }
}

TEST_P(Sliding, IsTheSameDownACompliantIncline) { expect_slides_down(options(1.0), 1e-3); }

// Without gravity N = m v^2 / R and m v' = -mu N: v = v0 / (1 + mu v0 t / R),
// theta = ln(1 + mu v0 t / R) / mu. The bead is inside: the hoop pushes it inwards, lambda = -N.
TEST_P(Sliding, SlowsDownLogarithmicallyRoundARoughHoop) {
  const double mu = 0.3, m = 2.0, R = 1.5, v0 = 4.0;
  Scene<2> scene;
  const auto bead = scene.add_particle({.mass = m, .position = {R, 0.0}, .velocity = {0.0, v0}});
  const auto hoop = scene.add(OnCurve{bead, Sphere<2>{{0.0, 0.0}, R}}, "hoop");
  scene.add(friction_law(hoop, points(bead), coulomb(mu)), "rough");
  const auto run = simulate(scene, options(3.0));
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double growth = 1.0 + mu * v0 * run.times()[i] / R;
    const double theta = std::log(growth) / mu, v = v0 / growth;
    const Vec<2> outwards(std::cos(theta), std::sin(theta)), along(-std::sin(theta), std::cos(theta));
    EXPECT_LE((run.position(bead, i) - R * outwards).norm(), error * R);
    EXPECT_LE((run.velocity(bead, i) - v * along).norm(), error * v0);
    EXPECT_NEAR(run.multiplier(hoop, i), -m * v * v / R, error * m * v0 * v0 / R);
  }
}

/// A block on a rough table and a bead on a rough upright guide, joined by a rod of length L: a ladder that
/// slides down. With the block at (x, 0), the bead at (0, y), x = L s, y = L c, x' = u > 0, y' = w < 0, the
/// rod pushes with lambda along (-s, c) on the bead and (s, -c) on the block, so that the table bears
/// N = m1 g + lambda c and the guide lambda s. For lambda > 0
///
///   m1 x'' = lambda s - mu1 (m1 g + lambda c),   m2 y'' = -m2 g + lambda c + mu2 lambda s.      (1)
///
/// Into s x'' + c y'' + (u^2 + w^2)/L = 0:
///
///   lambda (s^2/m1 - mu1 s c/m1 + c^2/m2 + mu2 s c/m2) = mu1 s g + c g - (u^2 + w^2)/L.         (2)
struct Ladder {
  double mu1, mu2, m1 = 2.0, m2 = 3.0, L = 1.3;
  bool one_sided = false;  ///< the table's law takes N, not |N|

  struct State {
    double x, u;
  };
  [[nodiscard]] double height(double x) const { return std::sqrt(L * L - x * x); }
  [[nodiscard]] double sinking(const State& at) const { return -at.x * at.u / height(at.x); }
  [[nodiscard]] double rod(const State& at) const {
    const double s = at.x / L, c = height(at.x) / L, w = sinking(at);
    return (mu1 * s * g + c * g - (at.u * at.u + w * w) / L) /
           (s * s / m1 - mu1 * s * c / m1 + c * c / m2 + mu2 * s * c / m2);
  }
  [[nodiscard]] double table(const State& at) const { return m1 * g + rod(at) * height(at.x) / L; }
  [[nodiscard]] double acceleration(const State& at) const {
    return (rod(at) * at.x / L - mu1 * table(at)) / m1;
  }
  /// Runge-Kutta of order 4 in steps of h < 1e-4: its error, h^4 of the motion, is below round-off.
  [[nodiscard]] State moved(State at, double duration) const {
    const int steps = static_cast<int>(std::ceil(duration / 1e-4));
    const double h = duration / steps;
    const auto rate = [this](const State& s) { return State{s.u, acceleration(s)}; };
    const auto along = [](const State& s, double f, const State& k) {
      return State{s.x + f * k.x, s.u + f * k.u};
    };
    for (int i = 0; i < steps; ++i) {
      const State k1 = rate(at), k2 = rate(along(at, 0.5 * h, k1)), k3 = rate(along(at, 0.5 * h, k2)),
                  k4 = rate(along(at, h, k3));
      at = {at.x + h / 6.0 * (k1.x + 2.0 * k2.x + 2.0 * k3.x + k4.x),
            at.u + h / 6.0 * (k1.u + 2.0 * k2.u + 2.0 * k3.u + k4.u)};
    }
    return at;
  }

  Scene<2> scene{"ladder"};
  Particle<2> block, bead;
  Constraint<1> floor, guide, rung;

  Ladder(double mu_table, double mu_guide, const State& start, bool table_one_sided = false)
      : mu1(mu_table), mu2(mu_guide), one_sided(table_one_sided) {
    scene.add(UniformGravity<2>{{0.0, -g}});
    block = scene.add_particle({.mass = m1, .position = {start.x, 0.0}, .velocity = {start.u, 0.0}});
    bead = scene.add_particle(
        {.mass = m2, .position = {0.0, height(start.x)}, .velocity = {0.0, sinking(start)}});
    floor = scene.add(OnCurve{block, Plane<2>{{0.0, 0.0}, {0.0, 1.0}}}, "table");
    guide = scene.add(OnCurve{bead, Plane<2>{{0.0, 0.0}, {1.0, 0.0}}}, "guide");
    rung = scene.add(Distance{block, bead, L}, "rod");
    if (one_sided) {
      scene.add(friction_law(floor, points(block),
                             [mu = mu1](auto N, auto, auto v) { return (-mu * N * v.normalized()).eval(); }),
                "rough table");
    } else {
      scene.add(friction_law(floor, points(block), coulomb(mu1)), "rough table");
    }
    scene.add(friction_law(guide, points(bead), coulomb(mu2)), "rough guide");
  }
};

TEST(SlidingLadder, HasTheMultipliersOfTheLinearSystemByHand) {
  for (const double x : {0.3, 0.7, 1.1}) {
    const Ladder::State at{x, 0.4};
    const Ladder ladder(0.4, 0.25, at);
    const double s = x / ladder.L;
    ASSERT_GT(ladder.rod(at), 0.0);  // (2) takes that for granted
    const Simulation<2> now(ladder.scene, {.t_end = 1.0});
    const double scale = ladder.table(at);
    EXPECT_NEAR(now.multiplier(ladder.rung), ladder.rod(at), rounding * scale);
    EXPECT_NEAR(now.multiplier(ladder.floor), ladder.table(at), rounding * scale);
    EXPECT_NEAR(now.multiplier(ladder.guide), ladder.rod(at) * s, rounding * scale);
  }
}

TEST_P(Sliding, LadderFollowsTheEquationByHand) {
  const Ladder::State start{0.5, 0.8};
  const Ladder ladder(0.4, 0.25, start);
  const auto run = simulate(ladder.scene, options(0.3));
  for (std::size_t i = 1; i < run.size(); ++i) {
    const auto at = ladder.moved(start, run.times()[i]);
    ASSERT_GT(ladder.rod(at), 0.0);
    EXPECT_NEAR(run.position(ladder.block, i).x(), at.x, error * ladder.L);
    EXPECT_NEAR(run.velocity(ladder.block, i).x(), at.u, error * 1.0);
    EXPECT_NEAR(run.multiplier(ladder.rung, i), ladder.rod(at), error * ladder.table(at));
    EXPECT_NEAR(run.multiplier(ladder.floor, i), ladder.table(at), error * ladder.table(at));
  }
}

// With mu1 = 6 the bracket of (2) is negative at 45 degrees: 0.25 - 1.5 + 0.17.
TEST(SlidingLadder, RefusesAStartWithNoUniqueAccelerationByName) {
  const Ladder ladder(6.0, 0.0, {0.9, 0.4});
  for (const auto stepper : {Stepper::ida, Stepper::erk}) {
    EXPECT_THAT([&] { (void)simulate(ladder.scene, {.t_end = 1.0, .stepper = stepper}); },
                ThrowsMessage<InconsistentStart>(AllOf(HasSubstr("FrictionLaw \"rough table\""),
                                                       HasSubstr("OnCurve \"table\""),
                                                       HasSubstr("no acceleration, or no unique one"))));
  }
}

// Drawn inwards, u < 0, friction's sign reverses and the bracket of (2) is positive whatever mu1: a law in N
// has one solution. With |N| the table may just as well hold the block down, N < 0, and that is unbounded.
TEST(SlidingLadder, DrawnBackHasOneAccelerationIfTheTableOnlyPushes) {
  const Ladder::State inwards{0.9, -0.4};
  const Ladder one_sided(6.0, 0.0, inwards, true), two_sided(6.0, 0.0, inwards);
  const Simulation<2> at(one_sided.scene, {.t_end = 1.0});
  const Ladder by_hand(-6.0, 0.0, inwards);
  EXPECT_NEAR(at.multiplier(one_sided.rung), by_hand.rod(inwards), rounding * by_hand.table(inwards));
  EXPECT_THAT([&] { (void)simulate(two_sided.scene, {.t_end = 1.0}); },
              ThrowsMessage<InconsistentStart>(HasSubstr("FrictionLaw \"rough table\"")));
}

// Fast enough, the rod pulls the block off the table, N < 0, and |N| holds it back: a solution like any
// other. Where the bracket of (2) turns negative, between x = 0.1 and 0.2, there begin to be more than one.
TEST_P(Sliding, StopsByNameInPainlevesParadox) {
  const Ladder ladder(6.0, 0.0, {0.1, 10.0});
  const auto bracket = [&](double x) {
    const double s = x / ladder.L, c = ladder.height(x) / ladder.L;
    return s * s / ladder.m1 - ladder.mu1 * s * c / ladder.m1 + c * c / ladder.m2;
  };
  ASSERT_GT(bracket(0.1), 0.0);
  ASSERT_LT(bracket(0.2), 0.0);
  try {
    (void)simulate(ladder.scene, {.t_end = 0.1, .samples = 101, .stepper = GetParam()});
    FAIL() << "no acceleration, or no unique one exists beyond x = 0.2";
  } catch (const IntegrationFailure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("FrictionLaw \"rough table\""));
    const auto run = failure.trajectory<2>();
    EXPECT_GT(run.size(), 2U);
    for (std::size_t i = 0; i < run.size(); ++i) EXPECT_GT(bracket(run.position(ladder.block, i).x()), 0.0);
  }
}

/// A block on a level table, N = m g: a law may have no value or no derivative at lambda = 0, as Hertz's
/// N^(1/3) has none, and is never asked for it.
TEST_P(Sliding, ALawNeedsNoDerivativeWhereThereIsNoForce) {
  const double c = 0.1, v0 = 3.0;
  double least = g;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto block = scene.add_particle({.mass = 1.0, .velocity = {v0, 0.0}});
  const auto table = scene.add(OnCurve{block, Plane<2>{}});
  scene.add(friction_law(table, points(block), [c, &least](auto lambda, auto, auto v) {
    if constexpr (std::is_same_v<decltype(lambda), double>) least = std::min(least, std::abs(lambda));
    return (-c * pow(lambda, 1.0 / 3.0) * v).eval();
  }));
  const auto run = simulate(scene, options(1.0));
  EXPECT_NEAR(run.velocity(block, run.size() - 1).x(), v0 * std::exp(-c * std::cbrt(g)), error * v0);
  EXPECT_GT(least, 0.5 * g);
}

}  // namespace
}  // namespace dalembert::friction_test
