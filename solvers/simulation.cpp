#include "dalembert/solvers/simulation.h"

#include <utility>

namespace dalembert {

template <int D>
Integrator Simulation<D>::watching(const Scene<D>& scene, const Options& options,
                                   const std::vector<Event<D>>& events) {
  System system = scene.system();
  std::vector<FlatEvent> flat;
  for (const Event<D>& event : events) {
    flat.push_back({event.name, {}, event.crossing, event.ends});
    if (!event.function) continue;
    flat.back().function = [layout = system.layout(), function = event.function](const FlatSample& now) {
      return function(Sample<D>(*layout, now));
    };
  }
  return {std::move(system), scene.initial_positions(), scene.initial_velocities(), options, std::move(flat)};
}

template class Simulation<2>;
template class Simulation<3>;

}  // namespace dalembert
