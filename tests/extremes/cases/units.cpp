#include <dalembert/models/plane_pendulum.h>
#include <dalembert/tests/extremes/cases/bounds.h>

#include <cmath>

namespace dalembert::extremes {

namespace {

/// How many of one's units a metre, a second and a kilogram are.
struct Units {
  double length = 1.0, time = 1.0, mass = 1.0;
  [[nodiscard]] double speed() const { return length / time; }
  [[nodiscard]] double acceleration() const { return speed() / time; }
  [[nodiscard]] double force() const { return mass * acceleration(); }
};

/// A pendulum, a second bob on a spring from its own, and a damper.
Statistics run_in(const Units& u, Stepper stepper) {
  Scene<2> scene("units");
  scene.add(UniformGravity<2>{{0.0, -9.81 * u.acceleration()}});
  const auto a =
      scene.add_particle({.mass = u.mass, .position = {u.length, 0.0}, .velocity = {0.0, 0.5 * u.speed()}});
  const auto b = scene.add_particle({.mass = 2.0 * u.mass, .position = {1.5 * u.length, 0.5 * u.length}});
  scene.add(Distance{Fixed<2>{}, a, u.length});
  scene.add(Spring{a, b, 40.0 * u.force() / u.length, 0.5 * u.length});
  scene.add(Damper{Fixed<2>{}, b, 2.0 * u.force() / u.speed()});
  // At this tolerance round-off has no say in the choice of steps.
  return simulate(scene, {.t_end = 3.0 * u.time, .tolerance = 1e-6, .stepper = stepper}).statistics();
}

/// The part by which the number of steps differs from that in metres, seconds and kilograms.
Case units_of(const char* what, Units (*units)(double)) {
  return {.name = std::string("units-of-") + what,
          .parameter = std::string("units of ") + what + " to one of SI: steps compared",
          .sweep = {1e-12, 1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9, 1e12},
          .brief = {1e-12, 1e12},
          .run =
              [units](double unit, Stepper stepper) {
                const double steps = static_cast<double>(run_in({}, stepper).steps);
                const Statistics statistics = run_in(units(unit), stepper);
                return Run{.error = std::abs(static_cast<double>(statistics.steps) / steps - 1.0),
                           .statistics = statistics};
              },
          .limit = [](const Run&) { return 0.05; }};
}

/// Time is known to epsilon t0/2, and each step begins and ends at a rounded time: the pendulum, no faster
/// than 1.5 sqrt(g l), is displaced by as much in every step.
double of_rounded_times(const Run& run) {
  return static_cast<double>(run.statistics.steps) * 0.5 * epsilon * run.parameter * 1.5 * std::sqrt(9.81);
}

constexpr double late_tolerance = 1e-8, late_duration = 3.0, pivot_speed = 0.1;

Case late_start() {
  return {.name = "late-start",
          .parameter = "t_start of a pendulum [s]",
          .sweep = {0.0, 1e3, 1e6, 1e9},
          .brief = {1e6},
          .run =
              [](double t0, Stepper stepper) {
                const models::PlanePendulum pendulum{};
                models::HangingRods built = pendulum.scene();
                const Trajectory<2> run = simulate(built.scene, {.t_end = t0 + late_duration,
                                                                 .t_start = t0,
                                                                 .tolerance = late_tolerance,
                                                                 .stepper = stepper});
                double error = 0.0;
                for (std::size_t i = 0; i < run.size(); ++i) {
                  const Vec<2> exact = pendulum.reference(run.times()[i] - t0).positions[0];
                  error = larger(error, (run.position(built.beads[0], i) - exact).norm());
                }
                return Run{.error = error, .statistics = run.statistics()};
              },
          .limit =
              [](const Run& run) {
                return added_up(run, late_tolerance, late_duration * std::sqrt(9.81)) + of_rounded_times(run);
              }};
}

/// The same pendulum on a pivot that moves along x at a constant speed, which no force tells from one at
/// rest. At 1e9 s the pivot's place is known to 1e-8 m, less well than the implicit stepper's steps have to
/// be: it may refuse.
Case late_drive() {
  return {.name = "late-drive",
          .parameter = "t_start of a pendulum whose pivot passes the origin then [s]",
          .sweep = {0.0, 1e3, 1e6, 1e9},
          .brief = {1e6, 1e9},
          .run =
              [](double t0, Stepper stepper) {
                return unless_refused(
                    [&] {
                      Scene<2> scene("late-drive");
                      scene.add(UniformGravity<2>{{0.0, -9.81}});
                      const auto bob = scene.add_particle(
                          {.mass = 1.0, .position = {1.0, 0.0}, .velocity = {pivot_speed, 0.0}});
                      const auto pivot = driven([t0](auto t) { return vec(pivot_speed * (t - t0), 0.0); });
                      scene.add(Distance{pivot, bob, 1.0});
                      const Trajectory<2> run = simulate(scene, {.t_end = t0 + late_duration,
                                                                 .t_start = t0,
                                                                 .tolerance = late_tolerance,
                                                                 .stepper = stepper});
                      double error = 0.0;
                      for (std::size_t i = 0; i < run.size(); ++i) {
                        const double t = run.times()[i] - t0;
                        const Vec<2> exact =
                            models::PlanePendulum{}.reference(t).positions[0] + Vec<2>(pivot_speed * t, 0.0);
                        error = larger(error, (run.position(bob, i) - exact).norm());
                      }
                      return Run{.error = error, .statistics = run.statistics()};
                    },
                    t0 >= 1e9, "t_start and t_end closer to 0");
              },
          .limit =
              [](const Run& run) {
                return added_up(run, late_tolerance, late_duration * std::sqrt(9.81)) + of_rounded_times(run);
              }};
}

}  // namespace

std::vector<Case> units() {
  return {units_of("length", [](double u) { return Units{.length = u}; }),
          units_of("time", [](double u) { return Units{.time = u}; }),
          units_of("mass", [](double u) { return Units{.mass = u}; }),
          units_of("all", [](double u) { return Units{.length = u, .time = u, .mass = u}; }),
          late_start(),
          late_drive()};
}

}  // namespace dalembert::extremes
