#include <dalembert/tests/extremes/cases/one_sided.h>

#include <cmath>

namespace dalembert::extremes {

namespace one_sided {

namespace {

/// The top of a parabola, 1/2 under g = 1, beneath an elastic ceiling. Where that is d below the top the ball
/// hits it at u = sqrt(2 d), and is thrown back by 2 u (1 + u) until t = 2. Errors E of the height make u
/// anything between those of d + E and d - E: without derivative at d = 0, the double root, where any answer
/// within sqrt(2 E) is right.
Case grazing() {
  const auto speed = [](double depth) { return std::sqrt(2.0 * std::max(depth, 0.0)); };
  return {.name = "grazing",
          .parameter = "how far a ceiling is below the top of a parabola, of which it is grazed [m]",
          .sweep = {-1e-4, -1e-8, -1e-12, 0.0, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2},
          .brief = {-1e-8, 0.0, 1e-12, 1e-6, 1e-2},
          .run =
              [speed](double depth, Stepper stepper) {
                Ball built({0.0, 0.0}, {0.3, 1.0}, 1.0);
                built.wall(0.0, -1.0, depth - 0.5, 1.0, "ceiling");
                const auto run = built.run(2.0, stepper);
                const double u = speed(depth), left = 1.0 + u;
                const double due = depth > 0.0 ? 0.5 - depth - u * left - 0.5 * left * left : 0.0;
                return Run{.error = std::abs(run.position(built.ball, 1).y() - due),
                           .statistics = run.statistics()};
              },
          .limit =
              [speed](const Run& run) {
                const double E = drift(run, 2.0), u = speed(run.parameter + E);
                return E + 2.0 * (1.0 + u) * (u - speed(run.parameter - E));
              }};
}

/// A ball falls into the corner of a floor and a wall, each of which it would reach alone at 1 s and a part
/// later: one after the other, or both at once. Height and distance know nothing of each other. An error of
/// position at an impact is doubled by it.
Case corner() {
  return {.name = "two-at-once",
          .parameter = "part of the time by which a wall is hit after the floor",
          .sweep = {0.0, 1e-16, 1e-15, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-3},
          .brief = {0.0, 1e-15, 1e-12, 1e-10, 1e-6},
          .run =
              [](double later, Stepper stepper) {
                Ball built({1.0 + later, 0.5 * g}, {-1.0, 0.0});
                built.wall(0.0, 1.0, 0.0, 1.0, "floor");
                built.wall(1.0, 0.0, 0.0, 0.5, "wall");
                const auto run = built.run(1.5, stepper);
                const Vec<2> due(0.5 * (0.5 - later), g * 0.5 - 0.5 * g * 0.25);
                return Run{.error = (run.position(built.ball, 1) - due).norm(),
                           .statistics = run.statistics()};
              },
          .limit = [](const Run& run) { return 2.0 * drift(run, 1.5); }};
}

/// A ball thrown down at 1 m/s from so little above the floor that it hits it in the first step, or at once:
/// it comes back as fast, sqrt(1 + 2 g h), after (u - 1)/g. (It is back before 0.2 s.)
Case first_step() {
  return {.name = "first-step",
          .parameter = "height above the floor of a ball thrown down at 1 m/s [m]",
          .sweep = {0.0, 1e-300, 1e-16, 1e-15, 1e-14, 1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-4, 1e-2},
          .brief = {0.0, 1e-16, 1e-12, 1e-9, 1e-6, 1e-2},
          .run =
              [](double height, Stepper stepper) {
                Ball built({0.0, height}, {0.0, -1.0});
                built.wall(0.0, 1.0, 0.0, 1.0, "floor");
                const auto run = built.run(0.15, stepper);
                const double u = std::sqrt(1.0 + 2.0 * g * height);
                const double left = 0.15 - 2.0 * height / (u + 1.0);  // of the fall, (u - 1)/g
                const double due = (u - 0.5 * g * left) * left;
                return Run{.error = std::abs(run.position(built.ball, 1).y() - due),
                           .statistics = run.statistics()};
              },
          // What is no further than 1e-8 of the scene's length touches at the start.
          .limit =
              [](const Run& run) {
                return 2.0 * drift(run, 0.15) + 2.0 * std::min(run.parameter, 1e-8 * run.statistics.length);
              }};
}

/// One particle above another, 1 m apart, dropped onto the floor from 1 m: what they come to rest with is the
/// weight of both below and that of the upper one between. The forces are those of the accelerations, (1/m_1
/// + 1/m_2) against 1/m_1: round-off grows like the ratio of masses. A state that errs by the tolerance
/// changes them by that ratio times it: where this is more than the root of the tolerance they are not
/// determined.
Case stack() {
  return {
      .name = "stack",
      .parameter = "mass of a particle over that of the one below it",
      .sweep = {1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6},
      .brief = {1e-6, 1.0, 1e6},
      .run =
          [](double ratio, Stepper stepper) {
            Scene<2> scene("stack");
            scene.add(UniformGravity<2>{{0.0, -g}});
            const auto lower = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}}, "lower");
            const auto upper = scene.add_particle({.mass = ratio, .position = {0.0, 2.1}}, "upper");
            const auto floor = scene.add(
                unilateral(holonomic(points(lower), [](auto r) { return r.y(); }), {.restitution = 0.3}),
                "floor");
            const auto between = scene.add(
                unilateral(holonomic(points(lower, upper),
                                     [](auto below, auto above) { return above.y() - below.y() - 1.0; }),
                           {.restitution = 0.3}),
                "between");
            const auto forces = [&] {
              const auto run =
                  simulate(scene, {.t_end = 5.0, .samples = 2, .tolerance = tolerance, .stepper = stepper});
              const double under = run.multiplier(floor, 1) / (g * (1.0 + ratio)) - 1.0;
              const double over = run.multiplier(between, 1) / (g * ratio) - 1.0;
              return Run{.error = larger(std::abs(under), std::abs(over)), .statistics = run.statistics()};
            };
            return unless_refused(forces, ratio * std::sqrt(tolerance) > 1.0, "no finite number");
          },
      .limit = [](const Run& run) { return 100.0 * epsilon * std::max(run.parameter, 1.0 / run.parameter); }};
}

}  // namespace

}  // namespace one_sided

std::vector<Case> contacts() {
  using namespace one_sided;
  return {grazing(), corner(), first_step(), walls(), elastic(), accumulation(), three_balls(), stack()};
}

}  // namespace dalembert::extremes
