#include <dalembert/tests/extremes/cases/one_sided.h>

#include <array>
#include <cmath>

namespace dalembert::extremes::one_sided {

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
                return Run{.error = all ? std::abs(run.velocity(built.ball, 1).norm() - 1.0) : infinite,
                           .statistics = run.statistics()};
              },
          .limit = [](const Run& run) { return 10.0 * epsilon * run.parameter; }};
}

/// A ball dropped from 1 m that never loses anything: after n impacts, its energy against that at the start.
/// Steps err by what they may in height, E, and speed, E/T: by g E and v E/T of g 1 m.
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
                return Run{.error = error, .statistics = run.statistics()};
              },
          .limit =
              [](const Run& run) {
                const double E = drift(run, 0.0);
                return E + std::sqrt(2.0 / g) * E / run.statistics.time + 10.0 * epsilon * run.parameter;
              }};
}

/// Dropped from 1 m it rests after sqrt(2 h/g) (1 + e)/(1 - e). What steps err by in speed, E/T, makes all
/// flights that follow longer, by 2/(g (1 - e)) together. What they err by in height, E, makes an impact late
/// by E over its speed: the third, which is the first to tell that they accumulate, by E/(v e^2).
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
                const EventRecord& last = run.events().back();
                return Run{
                    .error = last.kind == EventKind::rested ? std::abs(last.time / due(e) - 1.0) : infinite,
                    .statistics = run.statistics()};
              },
          .limit =
              [due](const Run& run) {
                const double e = run.parameter, E = drift(run, 0.0);
                const double longer = E / run.statistics.time * 2.0 / (g * (1.0 - e)),
                             late = E / (std::sqrt(2.0 * g) * e * e);
                return (longer + late) / due(e) + 100.0 * epsilon;
              }};
}

namespace {

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

}  // namespace

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
                return Run{.error = error, .statistics = run.statistics()};
              },
          .limit = [](const Run& run) { return drift(run, 0.0) / run.statistics.time + 100.0 * epsilon; }};
}

}  // namespace dalembert::extremes::one_sided
