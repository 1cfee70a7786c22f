#include "scenes.h"

#include <gtest/gtest.h>

#include <cmath>

/// Runs against closed forms. Each step errs by tolerance times (scale + |value|) at most, in position
/// and in velocity; what a velocity is off by moves the position for the rest of the run. So with k
/// steps a position is off by at most
///
///   k tolerance (X + V T) growth,                                                          (1)
///
/// X and V being twice the sizes of position and velocity, and `growth` how much the motion itself
/// magnifies a deviation (1 for stable ones).
namespace dalembert::motion_test {
namespace {

constexpr double tolerance = 1e-9;

template <int D>
double accumulated(const Trajectory<D>& run, double X, double V, double growth = 1.0) {
  const double T = run.times().back() - run.times().front();
  return static_cast<double>(run.statistics().steps) * tolerance * (X + V * T) * growth;
}

// r = v t + g t^2/2, v_y falls from 4 to -5.81 in 1 s; the path's own length is v^2/g = 1.6.
TEST(Motion, AThrownStoneFliesAParabola) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto stone = scene.add_particle({.mass = 2.0, .velocity = {3.0, 4.0}});
  const auto run = simulate(scene, {.t_end = 1.0, .samples = 11, .tolerance = tolerance});
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i];
    const Vec<2> expected(3.0 * t, 4.0 * t - 0.5 * 9.81 * t * t);
    EXPECT_LE((run.position(stone, i) - expected).norm(), accumulated(run, 2.0 * 3.0, 2.0 * 5.81));
    EXPECT_EQ(run.constraint_force(stone, i), Vec<2>::Zero());
  }
}

// Released at rest: nothing in the scene has a length but what it falls in its time.
TEST(Motion, AStoneReleasedFromRestFalls) {
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
  const auto stone = scene.add_particle({.mass = 2.0});
  const auto run = simulate(scene, {.t_end = 2.0, .samples = 11, .tolerance = tolerance});
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i];
    EXPECT_NEAR(run.position(stone, i).z(), -0.5 * 9.81 * t * t, accumulated(run, 2.0 * 39.3, 2.0 * 39.3));
  }
}

// So does one with a breath of a velocity: it must not set the scale.
TEST(Motion, AStoneReleasedAlmostAtRestFalls) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto stone = scene.add_particle({.mass = 2.0, .velocity = {1e-9, 0.0}});
  const auto run = simulate(scene, {.t_end = 2.0, .samples = 11, .tolerance = tolerance});
  EXPECT_NEAR(run.position(stone, 10).y(), -2.0 * 9.81, accumulated(run, 2.0 * 39.3, 2.0 * 39.3));
  EXPECT_LT(run.statistics().steps, 1000);
}

TEST(Motion, AParticleWithoutForcesKeepsItsVelocity) {
  Scene<2> scene;
  const auto p = scene.add_particle({.mass = 1.0, .position = {1.0, 2.0}, .velocity = {3.0, -4.0}});
  const auto still = scene.add_particle({.mass = 1.0, .position = {1.0, 2.0}});
  const auto run = simulate(scene, {.t_end = 2.0, .samples = 3, .tolerance = tolerance});
  EXPECT_LE((run.position(p, 2) - Vec<2>(7.0, -6.0)).norm(), accumulated(run, 14.0, 8.0));
  EXPECT_LE((run.position(still, 2) - Vec<2>(1.0, 2.0)).norm(), accumulated(run, 14.0, 8.0));
}

// x = 1 + 0.5 cos(omega t) about the relaxed length 1, omega = sqrt(k/m) = 4.
TEST(Motion, ASpringOscillates) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 2.0, .position = {1.5, 0.0}});
  scene.add(Spring{Fixed<2>{}, bob, 32.0, 1.0});
  const auto run = simulate(scene, {.t_end = 5.0, .samples = 51, .tolerance = tolerance});
  for (std::size_t i = 0; i < run.size(); ++i) {
    EXPECT_NEAR(run.position(bob, i).x(), 1.0 + 0.5 * std::cos(4.0 * run.times()[i]),
                accumulated(run, 2.0 * 1.5, 2.0 * 2.0 / (4.0 * 5.0)))  // velocity errors: V/omega, not V T
        << run.times()[i];
    // Energy m v^2/2 + k x^2/2 = 4: its error is k A and m v times those of position and velocity.
    EXPECT_NEAR(run.energy(i), 4.0, 32.0 * 2.0 * accumulated(run, 2.0 * 1.5, 2.0 * 2.0 / (4.0 * 5.0)));
  }
}

// m x'' = -d x' - k x with d = 2 m gamma: x = e^(-gamma t) (cos w t + gamma/w sin w t), k = m (w^2 +
// gamma^2).
TEST(Motion, ADampedOscillatorDecays) {
  constexpr double gamma = 0.5, w = 3.0, m = 2.0;
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = m, .position = {11.0, 0.0}});
  scene.add(Spring{Fixed<2>{{10.0, 0.0}}, bob, m * (w * w + gamma * gamma)});
  scene.add(Damper{Fixed<2>{}, bob, 2.0 * m * gamma});  // far away: its direction is constant on the line
  const auto run = simulate(scene, {.t_end = 4.0, .samples = 21, .tolerance = tolerance});
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i];
    EXPECT_NEAR(run.position(bob, i).x(),
                10.0 + std::exp(-gamma * t) * (std::cos(w * t) + gamma / w * std::sin(w * t)),
                accumulated(run, 2.0 * 11.0, 2.0 * 11.0));
  }
}

// A knife edge on an incline with slope acceleration s along x, turning at the given rate w (notes,
// mln37; Neimark and Fufaev 1972): v along (cos w t, sin w t),
//   x = s/(2 w^2) sin^2 w t,   y = s/(2 w^2) (w t - sin(2 w t)/2),   lambda = 2 m s sin w t.
// It drifts across the slope and never runs away.
TEST(Motion, AKnifeEdgeDriftsAcrossItsSlope) {
  constexpr double s = 3.0, w = 2.0, m = 1.5;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{s, 0.0}});
  const auto edge = scene.add_particle({.mass = m});
  const auto blade = scene.add(nonholonomic(
      points(edge), [](auto t, auto, auto v) { return v.y() * cos(w * t) - v.x() * sin(w * t); }));
  const auto run = simulate(scene, {.t_end = 5.0, .samples = 51, .tolerance = tolerance});
  const double A = s / (2.0 * w * w);
  const double bound = accumulated(run, 2.0 * s * 25.0, 2.0 * s * 5.0);  // the scale: falling for 5 s
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i];
    const Vec<2> expected(A * std::pow(std::sin(w * t), 2), A * (w * t - 0.5 * std::sin(2.0 * w * t)));
    EXPECT_LE((run.position(edge, i) - expected).norm(), bound) << t;
    // lambda reads v through gamma = -w (v along the blade), so it is off by m w times the velocity's error.
    EXPECT_NEAR(run.multiplier(blade, i), 2.0 * m * s * std::sin(w * t), m * w * bound) << t;
    const Vec<2> across(-std::sin(w * t), std::cos(w * t));
    EXPECT_LE((run.constraint_force(blade, edge, i) - 2.0 * m * s * std::sin(w * t) * across).norm(),
              m * w * bound);
  }
}

// A bead on a straight wire through the origin that turns at w in the horizontal plane: r'' = w^2 r,
// so r = cosh w t and the wire pushes with N = 2 m w r' = 2 m w^2 sinh w t. Deviations grow like r.
TEST(Motion, ABeadOnATurningWireIsFlungOut) {
  constexpr double w = 1.5, m = 2.0, T = 2.0;
  Scene<2> scene;
  const auto bead = scene.add_particle({.mass = m, .position = {1.0, 0.0}, .velocity = {0.0, w}});
  const auto wire = scene.add(
      holonomic(points(bead), [](auto t, auto r) { return r.y() * cos(w * t) - r.x() * sin(w * t); }));
  const auto run = simulate(scene, {.t_end = T, .samples = 21, .tolerance = tolerance});
  const double far = std::cosh(w * T), fast = w * std::sinh(w * T) + w * far;
  const double bound = accumulated(run, 2.0 * far, 2.0 * fast / (w * T), far);  // velocity errors: V/w
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i];
    const double r = std::cosh(w * t);
    EXPECT_LE((run.position(bead, i) - r * Vec<2>(std::cos(w * t), std::sin(w * t))).norm(), bound) << t;
    EXPECT_NEAR(run.multiplier(wire, i), 2.0 * m * w * w * std::sinh(w * t), 2.0 * m * w * w * bound) << t;
  }
}

// On a wire so nearly straight that its radius, 1e9, says nothing of the motion: x = cos t. The
// scene's length is what the spring's force moves the bead in the time of the run, 2^2.
TEST(Motion, ABeadOnANearlyStraightWireOscillatesAsOnAStraightOne) {
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    Scene<2> scene;
    const auto bead = scene.add_particle({.mass = 1.0, .position = {1.0, 0.5e-9}});
    scene.add(OnCurve{bead, [](auto r) { return r.y() - 0.5e-9 * r.x() * r.x(); }});
    scene.add(potential(points(bead), [](auto r) { return 0.5 * r.x() * r.x(); }));
    const auto run =
        simulate(scene, {.t_end = 2.0, .samples = 5, .tolerance = tolerance, .stepper = stepper});
    for (std::size_t i = 0; i < run.size(); ++i) {
      EXPECT_NEAR(run.position(bead, i).x(), std::cos(run.times()[i]),
                  accumulated(run, 4.0 + 1.0, 4.0 + 1.0));
    }
  }
}

// Pulled along by its driven end: a bob that rides behind a pivot at constant velocity keeps it, and
// the rod carries its weight only.
TEST(Motion, APendulumOnAnEvenlyMovingPivotHangsStill) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -10.0}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {0.0, -1.0}, .velocity = {2.0, 0.0}});
  const auto rod = scene.add(Distance{driven([](auto t) { return vec(2.0 * t, 0.0); }), bob, 1.0});
  const auto run = simulate(scene, {.t_end = 2.0, .samples = 5, .tolerance = tolerance});
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double bound = accumulated(run, 2.0 * 4.0, 2.0 * 3.2);
    EXPECT_LE((run.position(bob, i) - Vec<2>(2.0 * run.times()[i], -1.0)).norm(), bound);
    EXPECT_NEAR(-run.multiplier(rod, i), 10.0, 10.0 * bound);
  }
}

}  // namespace
}  // namespace dalembert::motion_test
