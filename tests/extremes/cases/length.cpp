#include <dalembert/models/chain.h>
#include <dalembert/models/plane_pendulum.h>
#include <dalembert/tests/extremes/cases/bounds.h>

#include <malloc.h>

#include <cmath>

namespace dalembert::extremes {

namespace {

/// What a run of 10,000 periods loses of energy and of phase.
struct Drift {
  double energy = 0.0;  ///< over m g l
  double position = 0.0;
  Statistics statistics{};
};

constexpr double periods = 10'000.0;

Drift drift(double tolerance, Stepper stepper) {
  const models::PlanePendulum pendulum{};
  models::HangingRods built = pendulum.scene();
  Drift d;
  d.statistics = simulate(built.scene,
                          {.t_end = periods * pendulum.period(),
                           .samples = 101,
                           .tolerance = tolerance,
                           .stepper = stepper,
                           .max_steps = 100'000'000},
                          [&](const Sample<2>& sample) {
                            const Vec<2> exact = pendulum.reference(sample.time()).positions[0];
                            d.position = larger(d.position, (sample.position(built.beads[0]) - exact).norm());
                            d.energy = larger(d.energy, std::abs(sample.energy()) / 9.81);  // 0 at the start
                          });
  return d;
}

/// In a step energy errs by force times error of position plus momentum times error of velocity: with T =
/// sqrt(l/g) and v <= 1.5 l/T by at most 2.5 of those in m g l.
Case energy_drift() {
  return {.name = "energy-drift",
          .parameter = "tolerance, over 10,000 periods of a pendulum",
          .sweep = {1e-4, 1e-6, 1e-8, 1e-10},
          .brief = {},
          .run =
              [](double tolerance, Stepper stepper) {
                const Drift d = drift(tolerance, stepper);
                return Run{.error = d.energy, .statistics = d.statistics};
              },
          .limit = [](const Run& run) { return 2.5 * added_up(run, run.parameter, 0.0); }};
}

/// An error of velocity displaces a pendulum by as much in every own time that is left, as it would any free
/// mass.
Case phase_drift() {
  return {.name = "phase-drift",
          .parameter = "tolerance, over 10,000 periods of a pendulum",
          .sweep = {1e-8, 1e-10, 1e-12},
          .brief = {},
          .run =
              [](double tolerance, Stepper stepper) {
                const Drift d = drift(tolerance, stepper);
                return Run{.error = d.position, .statistics = d.statistics};
              },
          .limit =
              [](const Run& run) {
                return added_up(run, run.parameter,
                                periods * models::PlanePendulum{}.period() * std::sqrt(9.81));
              }};
}

/// Ten radians of the chain's fastest vibration, 2 N sqrt(g/length); its own time is sqrt(l/g). Of a chain
/// let go from horizontal little has moved by then, and what has is compared.
Case long_chain() {
  constexpr double tolerance = 1e-6;
  const auto t_end = [](double beads) { return 10.0 / (2.0 * beads * std::sqrt(9.81)); };
  return {
      .name = "long-chain",
      .parameter = "beads of a chain",
      .sweep = {1e3, 1e4, 1e5},
      .brief = {1e3},
      .run =
          [=](double beads, Stepper stepper) {
            const models::Chain chain{.beads = static_cast<int>(beads)};
            const Options options{
                .t_end = t_end(beads), .samples = 3, .tolerance = tolerance, .stepper = stepper};
            const auto reference = chain.reference(sample_times(options), 1e-10L);
            const models::Measurement m = models::measure<2>(chain.model(), options, reference);
            return Run{.error = m.error_position, .statistics = m.statistics};
          },
      .limit =
          [=](const Run& run) { return added_up(run, tolerance, t_end(run.parameter) * std::sqrt(9.81)); }};
}

/// A step moves the beads by more of a link the more of them there are in 1 m: Newton's iteration is not to
/// fail for that, in more than one step of twenty.
Case short_links() {
  return {.name = "short-links",
          .parameter = "tolerance, a chain of 3,000 beads: steps that Newton's iteration fails, of all",
          .sweep = {1e-4, 1e-5, 1e-6},
          .brief = {1e-4},
          .run =
              [](double tolerance, Stepper stepper) {
                const auto run = simulate(models::Chain{.beads = 3000}.model().scene().scene,
                                          {.t_end = 0.02, .tolerance = tolerance, .stepper = stepper});
                const auto& s = run.statistics();
                return Run{
                    .error = static_cast<double>(s.convergence_failures) / static_cast<double>(s.steps),
                    .statistics = s};
              },
          .limit = [](const Run&) { return 0.05; },
          .steppers = {Stepper::ida}};
}

/// Bytes that this process has allocated.
double allocated() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

/// q, v, a, lambda, two constraint forces, energy and time of a pendulum.
constexpr double numbers_per_sample = 2 + 2 + 2 + 1 + 2 + 1 + 1;
constexpr double bytes_per_sample = numbers_per_sample * sizeof(double);

/// Short steps of time, so that output is what takes the memory.
Options many(double samples, Stepper stepper) {
  return {.t_end = 10.0, .samples = static_cast<int>(samples), .tolerance = 1e-6, .stepper = stepper};
}

struct Memory {
  Statistics statistics;
  double bytes;  ///< infinite if samples are missing
};

/// A case of memory: `held(scene, options, before)` gives the statistics of a run that takes its samples and
/// the memory [bytes] that it held besides what there was before. Limits are over the memory of the output;
/// besides, the run itself holds less than 300 kB.
template <class Held>
Case memory(std::string name, std::string parameter, double limit, const Held& held) {
  return {.name = std::move(name),
          .parameter = std::move(parameter),
          .sweep = {1e4, 1e5, 1e6},
          .brief = {1e5},
          .run =
              [held](double samples, Stepper stepper) {
                const models::HangingRods built = models::PlanePendulum{}.scene();
                const auto [statistics, bytes] = held(built.scene, many(samples, stepper), allocated());
                return Run{.error = bytes / (samples * bytes_per_sample), .statistics = statistics};
              },
          .limit = [limit](const Run& run) { return limit + 3e5 / (run.parameter * bytes_per_sample); }};
}

/// Memory in use at its most during a run that hands its samples on, over what all samples would take: their
/// times alone are kept, one number of each sample, twice while they are handed over.
Case streamed_samples() {
  return memory("streamed-samples", "samples handed on: memory over that of the output",
                2.0 / numbers_per_sample, [](const Scene<2>& scene, const Options& options, double before) {
                  double most = 0.0;
                  int seen = 0;
                  const Statistics statistics = simulate(scene, options, [&](const Sample<2>& sample) {
                    if (seen++ % 1000 == 0) most = larger(most, allocated() - before + 0.0 * sample.energy());
                  });
                  return Memory{statistics, seen == options.samples ? most : infinite};
                });
}

/// What a kept run leaves behind and what it holds besides: the times that were asked for.
Case kept_samples() {
  return memory("kept-samples", "samples kept: memory at the end over that of the output",
                1.0 + 2.0 / numbers_per_sample,
                [](const Scene<2>& scene, const Options& options, double before) {
                  Simulation<2> simulation(scene, options);
                  const Trajectory<2> run = simulation.run();
                  const bool all = run.size() == static_cast<std::size_t>(options.samples);
                  return Memory{run.statistics(), all ? allocated() - before : infinite};
                });
}

}  // namespace

std::vector<Case> length() {
  return {energy_drift(), phase_drift(), long_chain(), short_links(), streamed_samples(), kept_samples()};
}

}  // namespace dalembert::extremes
