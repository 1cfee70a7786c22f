#pragma once

#include <dalembert/tests/extremes/cases/bounds.h>

#include <string>

/// What the cases of one-sided constraints share.
namespace dalembert::extremes::one_sided {

inline constexpr double tolerance = 1e-10;

/// A particle of 1 kg that moves in a plane, under gravity or none.
struct Ball {
  Scene<2> scene{"ball"};
  Particle<2> ball;

  Ball(const Vec<2>& r, const Vec<2>& v, double gravity = g) {
    if (gravity > 0.0) scene.add(UniformGravity<2>{{0.0, -gravity}});
    ball = scene.add_particle({.mass = 1.0, .position = r, .velocity = v}, "ball");
  }
  /// n . r >= c, n = (x, y).
  Constraint<1> wall(double x, double y, double c, double restitution, const std::string& name) {
    return scene.add(unilateral(holonomic(points(ball), [=](auto r) { return x * r.x() + y * r.y() - c; }),
                                {.restitution = restitution}),
                     name);
  }
  [[nodiscard]] Trajectory<2> run(double t_end, Stepper stepper, int samples = 2) const {
    return simulate(scene, {.t_end = t_end,
                            .samples = samples,
                            .tolerance = tolerance,
                            .stepper = stepper,
                            .max_steps = 1'000'000'000});
  }
};

/// What steps add up to within t_end, in metres: added_up in lengths of the scene.
[[nodiscard]] inline double drift(const Run& run, double t_end) {
  const Statistics& s = run.statistics;
  return s.length * added_up(run, tolerance, t_end / s.time);
}

/// Many impacts, or without end.
[[nodiscard]] Case walls();
[[nodiscard]] Case elastic();
[[nodiscard]] Case accumulation();
[[nodiscard]] Case three_balls();

}  // namespace dalembert::extremes::one_sided
