#include "dalembert/solvers/simulation.h"

#include <utility>

namespace dalembert {

template <int D>
Simulation<D>::Simulation(const Scene<D>& scene, const Options& options)
    : integrator_(scene.system(), scene.initial_positions(), scene.initial_velocities(), options) {}
template <int D>
Simulation<D>::Simulation(const Scene<D>& scene, const Sample<D>& start, const Options& options)
    : integrator_((scene.require_state(start), scene.system()), start.flat().q, start.flat().v,
                  starting_at(start.time(), options)) {}
template <int D>
Simulation<D>::Simulation(const Scene<D>& scene, const Options& options, const std::vector<Event<D>>& events)
    : integrator_(watching(scene, options, events)) {}
template <int D>
Simulation<D>::Simulation(Simulation&&) noexcept = default;
template <int D>
Simulation<D>::~Simulation() = default;

template <int D>
Integrator Simulation<D>::watching(const Scene<D>& scene, const Options& options,
                                   const std::vector<Event<D>>& events) {
  System system = scene.system();
  struct Now {  // shared by the events of one run
    Scene<D> scene;
    std::shared_ptr<const Layout> layout;
  };
  const auto current = std::make_shared<Now>(Now{scene, system.layout()});
  std::vector<FlatEvent> flat;
  for (const Event<D>& event : events) {
    flat.push_back({event.name, {}, event.crossing, event.ends});
    if (event.function) {
      flat.back().function = [current, function = event.function](const FlatSample& now) {
        return function(Sample<D>(*current->layout, now));
      };
    }
    if (!event.change) continue;
    flat.back().change = [current, change = event.change](const FlatSample& now) {
      Scene<D> next = current->scene;
      next.start_from(Sample<D>(*current->layout, now));
      change(next);
      auto system = std::make_shared<const System>(next.system());
      current->layout = system->layout();
      current->scene = std::move(next);
      const auto q = current->scene.initial_positions(), v = current->scene.initial_velocities();
      return FlatEvent::Changed{std::move(system), {q.begin(), q.end()}, {v.begin(), v.end()}};
    };
  }
  return {std::move(system), scene.initial_positions(), scene.initial_velocities(), options, std::move(flat)};
}

template class Simulation<2>;
template class Simulation<3>;

}  // namespace dalembert
