#pragma once

#include <dalembert/core/results/sample.h>

#include <functional>
#include <string>

namespace dalembert {

/// Which way a function goes through 0.
enum class Crossing { either, rising, falling };

/// Something that happens where a function of the state is 0: a normal force vanishes, a string is straight,
/// a bead comes to rest.
///
///   Event<2>{"leaves the sphere", [=](const auto& now) { return now.multiplier(wall); }, Crossing::falling}
///
/// The function reads time, positions, velocities, multipliers, forces of the instant; it is called at times
/// of the run's own choice. What it gives at the start is no crossing, even if it is 0 there.
template <int D>
struct Event {
  std::string name;
  std::function<double(const Sample<D>&)> function;
  Crossing crossing = Crossing::either;
  bool ends = false;  ///< the run ends there, with a last sample at that time
};

/// The same without its dimension.
struct FlatEvent {
  std::string name;
  std::function<double(const FlatSample&)> function;
  Crossing crossing;
  bool ends;
};

/// That an event happened in a run: which, counted from 0, and when.
struct Occurrence {
  std::size_t event;
  double time;
};

}  // namespace dalembert
