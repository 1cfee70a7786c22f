#include "dalembert/solvers/equilibrium/bodies.h"

#include <dalembert/core/analysis/disjoint_sets.h>

#include <map>
#include <utility>

namespace dalembert {

std::vector<BodyParticles> bodies(const System& system) {
  const Layout& layout = *system.layout();
  DisjointSets sets(system.coordinates());
  std::vector<char> held(system.coordinates(), 0);
  for (const auto& constraint : layout.constraints) {
    if (!constraint.internal) continue;
    for (const std::size_t r : constraint.own_rows()) {
      for (const std::size_t k : system.row(r)) {
        held[system.w_columns()[k]] = 1;
        sets.join(system.w_columns()[system.row(r).front()], system.w_columns()[k]);
      }
    }
  }
  std::map<std::size_t, BodyParticles> by_root;
  for (const auto& particle : layout.particles) {
    const auto i = static_cast<std::size_t>(particle.coordinate);
    if (held[i]) by_root[sets.root(i)].push_back(&particle);
  }
  std::vector<BodyParticles> all;
  for (auto& [root, body] : by_root) all.push_back(std::move(body));
  return all;
}

}  // namespace dalembert
