#pragma once

#include <dalembert/core/results/trajectory.h>
#include <dalembert/core/scene/scene.h>
#include <dalembert/solvers/base/options.h>
#include <dalembert/solvers/integrator.h>

namespace dalembert {

/// A scene in motion, for step-wise control; the scene may be changed or destroyed meanwhile.
/// After a failure the last instant that steps reached can still be read.
///
/// Every function of Sample is one of a Simulation, of its current instant; see Readings.
template <int D>
class Simulation : public Readings<D, Simulation<D>> {
 public:
  /// Throws InvalidScene, InvalidArgument, InconsistentStart.
  Simulation(const Scene<D>& scene, const Options& options);
  /// From a sample of a run of this scene, or of a copy of it with other parameters, at the time of the
  /// sample: leave the option t_start out, or set it to that. Throws InvalidArgument also if the sample
  /// belongs to something else.
  Simulation(const Scene<D>& scene, const Sample<D>& start, const Options& options);
  /// With events; one that ends the run ends `step`, `advance_to` and `run`.
  Simulation(const Scene<D>& scene, const Options& options, const std::vector<Event<D>>& events);
  /// Moved, not copied. Of one that was moved all functions throw InvalidArgument.
  Simulation(Simulation&& other) noexcept;
  ~Simulation();

  /// See Integrator.
  void step() { integrator_.step(); }
  /// Steps until a time, which it reaches exactly; throws as `step`.
  void advance_to(double t) { integrator_.advance_to(t); }

  /// The current instant; see Sample for what can be read. A view, valid until the next step.
  [[nodiscard]] Sample<D> sample() const { return {*integrator_.system().layout(), integrator_.sample()}; }
  /// Reached so far [time].
  [[nodiscard]] double time() const { return sample().time(); }
  /// What the run has cost so far, and how exact it is.
  [[nodiscard]] Statistics statistics() const { return integrator_.statistics(); }
  /// What has happened so far, in the order of time.
  [[nodiscard]] std::span<const EventRecord> events() const { return integrator_.events(); }
  /// How well the run has obeyed the laws of mechanics so far.
  [[nodiscard]] Audit audit() const { return integrator_.statistics().audit; }

  /// All samples that the options ask for, from the current time on.
  [[nodiscard]] Trajectory<D> run() { return Trajectory<D>(integrator_.run()); }
  /// Hands each sample to `observe(const Sample<D>&)` instead of keeping it.
  template <class Observe>
  void run(const Observe& observe) {
    integrator_.run(
        [&](const FlatSample& flat) { observe(Sample<D>(*integrator_.system().layout(), flat)); });
  }

 private:
  [[nodiscard]] static Integrator watching(const Scene<D>& scene, const Options& options,
                                           const std::vector<Event<D>>& events);

  Integrator integrator_;
};

/// Runs a scene and returns its motion and forces of constraint. Throws InvalidScene, InvalidArgument,
/// InconsistentStart, IntegrationFailure; see there.
template <int D>
[[nodiscard]] Trajectory<D>
simulate(  // is an option misspelled, or not in the order of solvers/base/options.h?
    const Scene<D>& scene, const Options& options) {
  return Simulation<D>(scene, options).run();
}

/// The same with events:
///
///   const auto run = simulate(scene, {.t_end = 10.0},
///                             {{"leaves", [=](const auto& now) { return now.multiplier(wall); },
///                               Crossing::falling, true}});
///   run.events()[0].time;
template <int D>
[[nodiscard]] Trajectory<D> simulate(const Scene<D>& scene, const Options& options,
                                     const std::vector<Event<D>>& events) {
  return Simulation<D>(scene, options, events).run();
}

/// The same from a sample of another run on, see Simulation:
///
///   const auto rest = simulate(scene, run.sample(50), {.t_end = 20.0});
template <int D>
[[nodiscard]] Trajectory<D> simulate(const Scene<D>& scene, const Sample<D>& start, const Options& options) {
  return Simulation<D>(scene, start, options).run();
}

/// The same for runs too long to keep: hands each sample to `observe(const Sample<D>&)` and returns
/// the statistics.
template <int D, class Observe>
Statistics simulate(const Scene<D>& scene, const Options& options, const Observe& observe) {
  Simulation<D> simulation(scene, options);
  simulation.run(observe);
  return simulation.statistics();
}

/// And from a sample of another run on.
template <int D, class Observe>
Statistics simulate(const Scene<D>& scene, const Sample<D>& start, const Options& options,
                    const Observe& observe) {
  Simulation<D> simulation(scene, start, options);
  simulation.run(observe);
  return simulation.statistics();
}

extern template class Simulation<2>;
extern template class Simulation<3>;

}  // namespace dalembert
