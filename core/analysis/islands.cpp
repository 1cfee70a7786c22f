#include "dalembert/core/analysis/islands.h"

#include <dalembert/core/analysis/disjoint_sets.h>

namespace dalembert {

Islands islands(const System& system) {
  const int n = system.coordinates();
  DisjointSets sets(n);
  for (std::size_t r = 0; r < static_cast<std::size_t>(system.rows()); ++r) {
    const auto first = static_cast<std::size_t>(system.row_start()[r]);
    for (auto k = first; k < static_cast<std::size_t>(system.row_start()[r + 1]); ++k)
      sets.join(system.w_columns()[first], system.w_columns()[k]);
  }
  for (const auto& entry : system.stiffness_pattern()) sets.join(entry.row, entry.column);
  for (const auto& entry : system.damping_pattern()) sets.join(entry.row, entry.column);
  for (const auto& entry : system.friction_pattern()) {
    const auto first = static_cast<std::size_t>(system.row_start()[static_cast<std::size_t>(entry.column)]);
    sets.join(entry.row, system.w_columns()[first]);
  }

  Islands islands{0, std::vector<int>(static_cast<std::size_t>(n))};
  for (int i = 0; i < n; ++i) {
    const int root = sets.root(i);
    islands.of_coordinate[static_cast<std::size_t>(i)] =
        root == i ? islands.count++ : islands.of_coordinate[static_cast<std::size_t>(root)];
  }
  return islands;
}

}  // namespace dalembert
