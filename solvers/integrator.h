#pragma once

#include <dalembert/core/results/event.h>
#include <dalembert/core/results/trajectory.h>
#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/options.h>

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace dalembert {

/// Runs a System through time: consistent start, steps, output on the constraints with recovered
/// forces. Knows no scene; Simulation reads its results by handle.
class Integrator {
 public:
  /// Checks the options and the start. Throws InvalidArgument, InconsistentStart.
  Integrator(System system, std::span<const double> q, std::span<const double> v, const Options& options,
             std::vector<FlatEvent> events = {});
  /// Moved, not copied. Of one that was moved all functions throw InvalidArgument.
  Integrator(Integrator&&) noexcept;
  ~Integrator();

  /// The current instant: at first the start, later where `step` or `advance_to` went; after a failure the
  /// last one that the steps before it reached.
  [[nodiscard]] FlatSample sample() const;
  /// One step of the integrator's own choice. Throws InvalidArgument where t_end is reached,
  /// IntegrationFailure.
  void step();
  /// To a time not before the current one and not after t_end, or to an event that ends the run. Throws
  /// InvalidArgument outside and after such an event, IntegrationFailure.
  void advance_to(double t);
  /// What has happened so far.
  [[nodiscard]] std::span<const EventRecord> events() const;

  /// All samples that the options ask for, from here on. Throws IntegrationFailure, with all
  /// samples before.
  [[nodiscard]] std::shared_ptr<const Record> run();
  /// The same for runs too long to keep: each sample goes to `observe`, none is stored. Throws
  /// InvalidArgument if the options ask for dense output.
  void run(const std::function<void(const FlatSample&)>& observe);

  /// Of the run so far.
  [[nodiscard]] Statistics statistics() const;
  /// The equations in force.
  [[nodiscard]] const System& system() const;

 private:
  struct Run;
  /// Throws InvalidArgument if it was moved.
  [[nodiscard]] Run& its() const;
  std::unique_ptr<Run> run_;
};

}  // namespace dalembert
