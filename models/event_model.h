#pragma once

#include <dalembert/dalembert.h>

#include <functional>
#include <string>
#include <vector>

namespace dalembert::models {

/// When something happened in a run, and when it must.
struct Timed {
  std::string event;  ///< "leaves the wall", "impact 3", ...
  double time;        ///< NaN if the run did not list it
  double reference;   ///< by the hand derivation
  double limit;       ///< of the difference, as a part of the reference
};

/// A system whose events have times in closed form.
struct EventModel {
  std::string name;   ///< as in the benchmark, e.g. "bouncing-ball"
  std::string notes;  ///< its number in the lecture notes, if it has one
  std::function<std::vector<Timed>(Stepper, double tolerance)> events;
};

/// All that run within a moment, in the order of the benchmark's table; chains are in a header of their own.
[[nodiscard]] std::vector<EventModel> models_with_events();

}  // namespace dalembert::models
