#pragma once

#include <dalembert/dalembert.h>

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace dalembert::models {

/// When something happened in a run, and its number there.
struct HappenedAt {
  double time = std::numeric_limits<double>::quiet_NaN();  ///< NaN if the run did not list it
  std::size_t number = 0;
};

/// The same, and when it must.
struct Timed {
  std::string event;  ///< "leaves the wall", "impact 3", ...
  HappenedAt time;
  double reference;  ///< by the hand derivation
  double limit;      ///< of the difference, as a part of the reference
};

/// How a model with events is run.
struct EventRun {
  Stepper stepper = Stepper::ida;
  double tolerance = 1e-6;
  /// If it is to be certified: receives how the run compares with a more accurate one.
  std::optional<TwoRuns>* certified = nullptr;
  int samples = 0;  ///< if not 0, in place of the model's own: for a page that plays the run

  template <int D>
  [[nodiscard]] Trajectory<D> run(const Scene<D>& scene, Options options,
                                  const std::vector<Event<D>>& events = {}) const {
    options.stepper = stepper;
    options.tolerance = tolerance;
    if (samples > 0) options.samples = samples;
    if (certified == nullptr) return simulate(scene, options, events);
    const auto certificate = certify(scene, options, events);
    certified->emplace(certificate.runs());
    return certificate.run();
  }
};

/// A system whose events have times in closed form.
struct EventModel {
  std::string name;   ///< as in the benchmark, e.g. "bouncing-ball"
  std::string notes;  ///< its number in the lecture notes, if it has one
  std::function<std::vector<Timed>(const EventRun&)> events;
};

/// All that run within a moment, in the order of the benchmark's table; chains are in a header of their own.
[[nodiscard]] std::vector<EventModel> models_with_events();

}  // namespace dalembert::models
