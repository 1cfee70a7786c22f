#include <dalembert/tests/extremes/cases/bounds.h>
#include <dalembert/tests/extremes/cases/stiff_scenes.h>

namespace dalembert::extremes {

namespace {

/// Enough for every run here; a run that is too stiff for its stepper stops within seconds.
constexpr long most_steps = 300'000;

/// Up to here the reference resolves the spring's oscillation; beyond, it is the rigid rod.
constexpr double last_resolved = 1e4;

/// How far a pendulum on a spring is from one on a rod of its length. The bob pulls with at most 3 m g, so
/// the spring is at most 3 m g/k longer; the pendulum is slower by half that part of its length, which
/// displaces it by as much again in every two of its own times.
double from_rigid(double k, double own_times) {
  return k > last_resolved ? 3.0 * 9.81 / k * (1.0 + 0.5 * own_times) : 0.0;
}

/// The spring as a force: from where its vibration lasts no longer than the steps, IDA must name what to do
/// if it gives up; stability may stop the explicit stepper anywhere.
Case spring_pendulum() {
  constexpr double tolerance = 1e-6, t_end = 3.0;
  return {.name = "spring-pendulum",
          .parameter = "stiffness of a spring in place of the rod [N/m]",
          .sweep = {1e2, 1e4, 1e6, 1e8, 1e10, 1e12},
          .brief = {1e2, 1e4},
          .run =
              [](double k, Stepper stepper) {
                const SpringPendulum pendulum{.stiffness = k};
                const Options options{
                    .t_end = t_end, .tolerance = tolerance, .stepper = stepper, .max_steps = most_steps};
                const bool implicit = stepper == Stepper::ida;
                return unless_refused(
                    [&] { return compared_motion<2>(pendulum.as_force(k > last_resolved), options); },
                    !implicit || k > 1e8, implicit ? "compliant(" : "max_steps");
              },
          .limit =
              [](const Run& run) {
                const double own_times = t_end / std::sqrt(1.0 / 9.81);
                return added_up(run, tolerance, own_times) + from_rigid(run.parameter, own_times);
              }};
}

/// The spring as a constraint, up to a rigid one. The tension T = 3 m g cos(phi) of the rod changes by three
/// weights a radian; the spring's follows it as a forced and a free vibration do, each of amplitude
/// T''/(k/m) with T'' <= 9 m g^2/l. Where order 5 of BDF would stick at following the vibration, lower orders
/// damp it: their steps err by as much as others.
Case compliant_pendulum() {
  constexpr double tolerance = 1e-6, t_end = 10.0;
  return {.name = "compliant-pendulum",
          .parameter = "stiffness of a compliant rod [N/m]",
          .sweep = {1e2, 1e3, 1e4, 1e5, 3e5, 1e6, 1e7, 1e8, 1e10, 1e12, infinite},
          .brief = {1e2, 1e4, 1e6, 1e8, 1e12, infinite},
          .run =
              [](double k, Stepper stepper) {
                const Options options{
                    .t_end = t_end, .tolerance = tolerance, .stepper = stepper, .max_steps = most_steps};
                return unless_too_stiff(
                    [&] { return compared<2>(SpringPendulum{k}.as_constraint(k > last_resolved), options); },
                    stepper);
              },
          .limit =
              [](const Run& run) {
                const double k = run.parameter, own_times = t_end / std::sqrt(1.0 / 9.81);
                const double vibration = k > last_resolved ? 2.0 * 9.0 * 9.81 / k : 0.0;
                return 3.0 * (added_up(run, tolerance, own_times) + from_rigid(k, own_times)) + vibration;
              }};
}

/// Drag so strong that inertia plays no part: errors of velocity die out, those of position add up. It runs
/// until it has come down, in the time c l/(m g).
Case strong_drag() {
  constexpr double tolerance = 1e-8;
  return {.name = "strong-drag",
          .parameter = "drag of a pendulum's bob [kg/s]",
          .sweep = {1e1, 1e2, 1e3, 1e4, 1e6, 1e8},
          .brief = {1e1, 1e6},
          .run =
              [](double c, Stepper stepper) {
                const CreepingPendulum pendulum{.drag = c};
                const Options options{.t_end = pendulum.t_end(),
                                      .tolerance = tolerance,
                                      .stepper = stepper,
                                      .max_steps = most_steps};
                return unless_too_stiff([&] { return compared_motion<2>(pendulum.model(), options); },
                                        stepper);
              },
          .limit =
              [](const Run& run) {
                return added_up(run, tolerance, 0.0) +
                       CreepingPendulum{.drag = run.parameter}.error_of_reference();
              }};
}

/// As above: the damper's rate leaves errors of position only.
Case strong_damper() {
  constexpr double tolerance = 1e-8;
  return {
      .name = "strong-damper",
      .parameter = "damper between two beads on a wire, with a spring of 1 N/m [kg/s]",
      .sweep = {2.0, 1e2, 1e4, 1e6, 1e8},
      .brief = {2.0, 1e4, 1e8},
      .run =
          [](double c, Stepper stepper) {
            const DampedPair pair{.damping = c};
            const Options options{
                .t_end = pair.t_end(), .tolerance = tolerance, .stepper = stepper, .max_steps = most_steps};
            return unless_too_stiff([&] { return compared_motion<2>(pair.model(), options); }, stepper);
          },
      .limit = [](const Run& run) { return added_up(run, tolerance, 0.0); }};
}

/// The published solution, which has 17 digits. The stiffness of the springs over the axle's mass is
/// 1/(eps^2 M/2) = 2000 of its units, the wheels' drive 10 rad per unit of time: t = 3 is 30 of its own
/// times.
Case car_axis() {
  return {
      .name = "car-axis",
      .parameter = "tolerance",
      .sweep = {1e-4, 1e-6, 1e-8, 1e-10},
      .brief = {1e-6, 1e-8},
      .run =
          [](double tolerance, Stepper stepper) {
            return car_axis_at_3({.t_end = 3.0, .samples = 2, .tolerance = tolerance, .stepper = stepper});
          },
      .limit = [](const Run& run) { return added_up(run, run.parameter, 30.0); }};
}

/// Near its resting place a damped motion does not amplify errors: those of position add up.
Case stiff_governor() {
  constexpr double tolerance = 1e-6;
  return {.name = "stiff-governor",
          .parameter = "spring that holds the sleeve, critically damped [N/m]",
          .sweep = {1e2, 1e4, 1e6, 1e8},
          .brief = {1e2, 1e8},
          .run =
              [](double k, Stepper stepper) {
                const Options options{
                    .t_end = 2.0, .tolerance = tolerance, .stepper = stepper, .max_steps = most_steps};
                const SprungGovernor governor{.stiffness = k};
                return unless_too_stiff([&] { return compared_motion<3>(governor.model(), options); },
                                        stepper);
              },
          .limit = [](const Run& run) { return added_up(run, tolerance, 2.0 * 7.0); }};
}

Case soft_and_stiff() {
  constexpr double tolerance = 1e-6, t_end = 5.0;
  return {.name = "soft-and-stiff",
          .parameter = "damped spring under a pendulum's pivot [N/m]",
          .sweep = {1e2, 1e4, 1e6, 1e8},
          .brief = {1e2, 1e8},
          .run =
              [](double k, Stepper stepper) {
                const SprungPivot pivot{.stiffness = k};
                const Options options{
                    .t_end = t_end, .tolerance = tolerance, .stepper = stepper, .max_steps = most_steps};
                return unless_too_stiff([&] { return compared_motion<2>(pivot.model(), options); }, stepper);
              },
          .limit = [](const Run& run) { return added_up(run, tolerance, t_end / std::sqrt(1.0 / 9.81)); }};
}

}  // namespace

std::vector<Case> stiffness() {
  return {spring_pendulum(), compliant_pendulum(), strong_drag(),   strong_damper(),
          car_axis(),        stiff_governor(),     soft_and_stiff()};
}

}  // namespace dalembert::extremes
