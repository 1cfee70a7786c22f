#include <dalembert/bench/extremes/bounds.h>

#include <array>
#include <cmath>

namespace dalembert::extremes {

namespace {

constexpr double tolerance = 1e-10;
constexpr double g = 9.81;

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
double drift(const Run& run, double t_end) {
  const Statistics& s = run.statistics;
  return s.length * added_up(run, tolerance, t_end / s.time);
}

/// The top of a parabola, 1/2 under g = 1, beside a ceiling that gives back what strikes it. Where that is d
/// below the top the ball strikes it at u = sqrt(2 d), and is thrown back by 2 u (1 + u) until t = 2. Errors
/// E of the height make u anything between those of d + E and d - E: without derivative at d = 0, the double
/// root, where any answer within sqrt(2 E) is right.
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
                return Result{.error = std::abs(run.position(built.ball, 1).y() - due),
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
          .parameter = "part of the time by which a wall is struck after the floor",
          .sweep = {0.0, 1e-16, 1e-15, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-3},
          .brief = {0.0, 1e-15, 1e-12, 1e-10, 1e-6},
          .run =
              [](double later, Stepper stepper) {
                Ball built({1.0 + later, 0.5 * g}, {-1.0, 0.0});
                built.wall(0.0, 1.0, 0.0, 1.0, "floor");
                built.wall(1.0, 0.0, 0.0, 0.5, "wall");
                const auto run = built.run(1.5, stepper);
                const Vec<2> due(0.5 * (0.5 - later), g * 0.5 - 0.5 * g * 0.25);
                return Result{.error = (run.position(built.ball, 1) - due).norm(),
                              .statistics = run.statistics()};
              },
          .limit = [](const Run& run) { return 2.0 * drift(run, 1.5); }};
}

/// A ball thrown down at 1 m/s from so little above the floor that it is struck in the first step, or at
/// once: it comes back as fast, sqrt(1 + 2 g h), after (u - 1)/g. (It is back before 0.2 s.)
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
                return Result{.error = std::abs(run.position(built.ball, 1).y() - due),
                              .statistics = run.statistics()};
              },
          // What is no further than 1e-8 of the scene's length touches at the start.
          .limit =
              [](const Run& run) {
                return 2.0 * drift(run, 0.15) + 2.0 * std::min(run.parameter, 1e-8 * run.statistics.length);
              }};
}

/// Between two walls 1 m apart at 1 m/s, without any force: an impact every second. Each may round the speed
/// by the few operations of its impulse, all the same way.
Case walls() {
  return {.name = "walls",
          .parameter = "elastic impacts between two walls: the speed",
          .sweep = {1e1, 1e2, 1e3, 1e4, 1e5, 1e6},
          .brief = {1e4},
          .run =
              [](double impacts, Stepper stepper) {
                Ball built({0.5, 0.0}, {1.0, 0.0}, 0.0);
                built.wall(1.0, 0.0, 0.0, 1.0, "left");
                built.wall(-1.0, 0.0, -1.0, 1.0, "right");
                const auto run = built.run(impacts, stepper);
                const bool all = run.events().size() == static_cast<std::size_t>(impacts);
                return Result{.error = all ? std::abs(run.velocity(built.ball, 1).norm() - 1.0) : infinite,
                              .statistics = run.statistics()};
              },
          .limit = [](const Run& run) { return 10.0 * epsilon * run.parameter; }};
}

/// A ball that is dropped from 1 m and never loses anything: after so many impacts, the energy by that at the
/// start. Steps err by what they may in height, E, and speed, E/T: by g E and v E/T of g 1 m.
Case elastic() {
  return {.name = "elastic",
          .parameter = "elastic impacts of a ball that was dropped: the energy",
          .sweep = {1e1, 1e2, 1e3, 1e4, 1e5},
          .brief = {1e3},
          .run =
              [](double impacts, Stepper stepper) {
                Ball built({0.0, 1.0}, {0.0, 0.0});
                built.wall(0.0, 1.0, 0.0, 1.0, "floor");
                const double fall = std::sqrt(2.0 / g);
                const auto run = built.run(2.0 * impacts * fall, stepper, 11);
                double error = run.events().size() == static_cast<std::size_t>(impacts) ? 0.0 : infinite;
                for (std::size_t i = 0; i < run.size(); ++i)
                  error = larger(error, std::abs(run.energy(i) / g - 1.0));
                return Result{.error = error, .statistics = run.statistics()};
              },
          .limit =
              [](const Run& run) {
                const double E = drift(run, 0.0);
                return E + std::sqrt(2.0 / g) * E / run.statistics.time + 10.0 * epsilon * run.parameter;
              }};
}

/// Dropped from 1 m it rests after sqrt(2 h/g) (1 + e)/(1 - e). What steps err by in speed, E/T, makes all
/// flights that follow longer, by 2/(g (1 - e)) together.
Case accumulation() {
  const auto due = [](double e) { return std::sqrt(2.0 / g) * (1.0 + e) / (1.0 - e); };
  return {.name = "accumulation",
          .parameter = "restitution of a ball that comes to rest",
          .sweep = {0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.95, 0.99, 0.999},
          .brief = {0.1, 0.5, 0.9, 0.99},
          .run =
              [due](double e, Stepper stepper) {
                Ball built({0.0, 1.0}, {0.3, 0.0});
                built.wall(0.0, 1.0, 0.0, e, "floor");
                const auto run = built.run(due(e) + 1.0, stepper);
                const Occurrence& last = run.events().back();
                return Result{
                    .error = last.what == Happened::rested ? std::abs(last.time / due(e) - 1.0) : infinite,
                    .statistics = run.statistics()};
              },
          .limit =
              [due](const Run& run) {
                const double e = run.parameter, E = drift(run, 0.0);
                return (E / run.statistics.time * 2.0 / (g * (1.0 - e)) + E) / due(e) + 100.0 * epsilon;
              }};
}

/// Three equal balls in a row, 0.3 and 0.5 m apart, the outer two on their way to the one at rest. An impact
/// of the first two, whose velocities differ by a < 0, makes that -e a and the other difference b + (1 + e)
/// a/2, and so on. Below e = 7 - 4 sqrt(3) = 0.0718 they never part: impacts without number take them to one
/// velocity, in a finite time. (S. McNamara, W. R. Young, Inelastic collapse in one dimension, 1992.)
struct ThreeBalls {
  static constexpr std::array speeds{1.0, 0.0, -0.9}, places{0.0, 0.3, 0.8};

  /// After all their impacts.
  static std::array<double, 3> due(double e) {
    double a = speeds[1] - speeds[0], b = speeds[2] - speeds[1];
    double x = places[1] - places[0], y = places[2] - places[1];
    for (int k = 0; k < 10'000 && (a < 0.0 || b < 0.0); ++k) {
      const bool first = b >= 0.0 || (a < 0.0 && x * b >= y * a);
      const double t = first ? x / -a : y / -b;
      x = first ? 0.0 : x + a * t;
      y = first ? y + b * t : 0.0;
      (first ? b : a) += 0.5 * (1.0 + e) * (first ? a : b);
      (first ? a : b) *= -e;
    }
    const double v = (speeds[0] + speeds[1] + speeds[2] - 2.0 * a - b) / 3.0;
    return {v, v + a, v + a + b};
  }
};

/// Speeds are what impacts make of them, and they and their order are right to what steps err by in speed.
Case three_balls() {
  return {.name = "chattering",
          .parameter = "restitution of three balls in a row; below 0.0718 they never part",
          .sweep = {0.0, 0.01, 0.03, 0.05, 0.07, 0.0717, 0.0719, 0.08, 0.1, 0.2, 0.5, 0.9, 1.0},
          .brief = {0.0, 0.05, 0.0717, 0.0719, 0.5},
          .run =
              [](double e, Stepper stepper) {
                Scene<2> scene("chattering");
                std::array<Particle<2>, 3> balls;
                for (std::size_t i = 0; i < 3; ++i)
                  balls[i] = scene.add_particle({.mass = 1.0,
                                                 .position = {ThreeBalls::places[i], 0.0},
                                                 .velocity = {ThreeBalls::speeds[i], 0.0}});
                for (std::size_t i = 0; i < 2; ++i)
                  scene.add(unilateral(
                      holonomic(points(balls[i], balls[i + 1]), [](auto l, auto r) { return r.x() - l.x(); }),
                      {.restitution = e}));
                const auto run = simulate(
                    scene, {.t_end = 10.0, .samples = 2, .tolerance = tolerance, .stepper = stepper});
                const auto due = ThreeBalls::due(e);
                double error = 0.0;
                for (std::size_t i = 0; i < 3; ++i)
                  error = larger(error, std::abs(run.velocity(balls[i], 1).x() - due[i]));
                return Result{.error = error, .statistics = run.statistics()};
              },
          .limit = [](const Run& run) { return drift(run, 0.0) / run.statistics.time + 100.0 * epsilon; }};
}

/// One particle above another, 1 m apart, dropped onto the floor from 1 m: what they come to rest with is the
/// weight of both below and that of the upper one between. The forces are those of the accelerations, (1/m_1
/// + 1/m_2) against 1/m_1: round-off grows like the ratio of masses.
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
            // The forces on the lighter one cancel: of its velocity that leaves roundings times the ratio.
            const double asked = std::max(tolerance, 100.0 * epsilon * std::max(ratio, 1.0 / ratio));
            const auto run =
                simulate(scene, {.t_end = 5.0, .samples = 2, .tolerance = asked, .stepper = stepper});
            const double under = run.multiplier(floor, 1) / (g * (1.0 + ratio)) - 1.0;
            const double over = run.multiplier(between, 1) / (g * ratio) - 1.0;
            return Result{.error = larger(std::abs(under), std::abs(over)), .statistics = run.statistics()};
          },
      .limit = [](const Run& run) { return 100.0 * epsilon * std::max(run.parameter, 1.0 / run.parameter); }};
}

}  // namespace

std::vector<Case> contacts() {
  return {grazing(), corner(), first_step(), walls(), elastic(), accumulation(), three_balls(), stack()};
}

}  // namespace dalembert::extremes
