#include <dalembert/models/double_pendulum.h>
#include <dalembert/tests/extremes/cases/bounds.h>
#include <dalembert/tests/extremes/cases/chain_of_masses.h>

#include <cmath>

namespace dalembert::extremes {

namespace {

constexpr long long_steps = 1'000'000;

/// One second, or a thousand vibrations of the lightest part.
double duration(double mass_ratio) { return std::min(1.0, 1e3 / std::sqrt(mass_ratio)); }

/// In the scene's own time: that of its rods falling, g over their length.
double own_times(double t_end, double length) { return t_end / std::sqrt(length / 9.81); }

/// Largest error of the positions over the length, and of each tension over the weight that hangs on its rod.
Run compared_by_weight(const models::DoublePendulum& pendulum, const Options& options) {
  const auto reference = pendulum.reference(sample_times(options));
  const models::HangingRods rods = pendulum.scene();
  const Trajectory<2> run = simulate(rods.scene, options);
  const double weights[] = {(pendulum.mass1 + pendulum.mass2) * pendulum.gravity,
                            pendulum.mass2 * pendulum.gravity};
  double error = 0.0;
  for (std::size_t i = 0; i < run.size(); ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      const double apart = (run.position(rods.beads[k], i) - reference[i].positions[k]).norm();
      error = larger(error, apart / (pendulum.length1 + pendulum.length2));
      const double tension = -run.multiplier(rods.rods[k], i);
      error = larger(error, std::abs(tension - reference[i].forces[k]) / weights[k]);
    }
  }
  return {.error = error, .statistics = run.statistics()};
}

/// Tensions hold m v^2/l: an error of the velocity by e length/T is one of 2 e v/(length/T) weights, and from
/// 1 rad no bob is faster than 3 length/T.
constexpr double of_tensions = 6.0;

/// From one radian, where one second amplifies nothing. A knot of small mass on a taut string vibrates at
/// sqrt(2 m2/m1) of the pendulum's own frequency, with an amplitude of m1/m2. Where double precision does not
/// tell the forces on it apart to the tolerance, a run may be refused.
Case mass_ratio() {
  return {.name = "mass-ratio",
          .parameter = "lower over upper mass of a double pendulum",
          .sweep = {1e-8, 1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6, 1e8},
          .brief = {1e-8, 1e-4, 1e4, 1e8},
          .run =
              [](double ratio, Stepper stepper) {
                // The smaller mass is 1 kg.
                const double upper = std::max(1.0, 1.0 / ratio), lower = std::max(1.0, ratio);
                return unless_refused(
                    [&] {
                      return compared_by_weight(
                          {.mass1 = upper, .mass2 = lower, .angle1 = 1.0, .angle2 = 1.0},
                          {.t_end = duration(ratio),
                           .tolerance = tolerance,
                           .stepper = stepper,
                           .max_steps = long_steps});
                    },
                    epsilon * std::max(ratio, 1.0 / ratio) > tolerance, "the multiplier of Distance");
              },
          .limit =
              [](const Run& run) {
                return of_tensions * added_up(run, tolerance, own_times(duration(run.parameter), 2.0));
              }};
}

/// The tolerance is relative to the whole: an error e of position is one of e/r in the angle of a rod of the
/// part r of the other, and so in the tensions and all that they move. With tolerances in proportion, down to
/// the tightest, tensions are compared too; of the implicit stepper, whose steps would have to be right to 20
/// units of round-off, that may be too much. From half a radian the short rod swings, and amplifies nothing.
Case length_ratio() {
  const auto part = [](double ratio) { return std::min(ratio, 1.0 / ratio); };
  const auto tight = [=](double ratio) { return std::clamp(1e-7 * part(ratio), 1e-13, 1e-8); };
  return {
      .name = "length-ratio",
      .parameter = "lower over upper rod of a double pendulum",
      .sweep = {1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6},
      .brief = {1e-6, 1.0, 1e4},
      .run =
          [=](double ratio, Stepper stepper) {
            const models::DoublePendulum pendulum{.length1 = std::min(1.0, 1.0 / ratio),
                                                  .length2 = std::min(1.0, ratio),
                                                  .angle1 = 0.5,
                                                  .angle2 = 0.5};
            return unless_refused(
                [&] {
                  return compared<2>(
                      pendulum.model(),
                      {.t_end = 1.0, .tolerance = tight(ratio), .stepper = stepper, .max_steps = long_steps});
                },
                stepper == Stepper::ida && part(ratio) <= 1e-6, "looser tolerance");
          },
      .limit =
          [=](const Run& run) {
            return of_tensions * added_up(run, tight(run.parameter), own_times(1.0, 1.0)) /
                   part(run.parameter);
          }};
}

/// The light links of mass m, 1/5 of the string each, vibrate at sqrt(5 M/m) of the pendulum's frequency with
/// amplitudes of m/M: they amplify no error of the motion. The tensions on a link are M/m of its weight;
/// where double precision does not tell their difference to the tolerance, a run may be refused.
Case heavy_on_light_chain() {
  return {.name = "heavy-on-light-chain",
          .parameter = "mass at the end of five light links over that of a link",
          .sweep = {1e1, 1e2, 1e4, 1e6, 1e8},
          .brief = {1e1, 1e4},
          .run =
              [](double ratio, Stepper stepper) {
                return unless_refused(
                    [&] {
                      return compared<2>(ChainOfMasses::heavy_at_the_end(5, ratio).model(),
                                         {.t_end = duration(ratio),
                                          .tolerance = tolerance,
                                          .stepper = stepper,
                                          .max_steps = long_steps});
                    },
                    epsilon * ratio > tolerance, "the multiplier of Distance");
              },
          .limit =
              [](const Run& run) {
                return of_tensions * added_up(run, tolerance, own_times(duration(run.parameter), 1.0));
              }};
}

}  // namespace

std::vector<Case> ratios() { return {mass_ratio(), length_ratio(), heavy_on_light_chain()}; }

}  // namespace dalembert::extremes
