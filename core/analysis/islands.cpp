#include "dalembert/core/analysis/islands.h"

#include <dalembert/core/analysis/disjoint_sets.h>

namespace dalembert {

Islands islands(const System& system) {
  const std::size_t n = system.coordinates();
  DisjointSets sets(n);
  const auto first_column = [&system](std::size_t r) { return system.w_columns()[system.row(r).front()]; };
  for (std::size_t r = 0; r < system.rows(); ++r) {
    for (const std::size_t k : system.row(r)) sets.join(first_column(r), system.w_columns()[k]);
  }
  for (const auto& entry : system.stiffness_pattern()) sets.join(entry.row, entry.column);
  for (const auto& entry : system.forces().damping_pattern()) sets.join(entry.row, entry.column);
  for (const auto& entry : system.forces().friction_pattern())
    sets.join(entry.row, first_column(entry.column));

  Islands islands{0, std::vector<std::size_t>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t root = sets.root(i);
    islands.of_coordinate[i] = root == i ? islands.count++ : islands.of_coordinate[root];
  }
  return islands;
}

}  // namespace dalembert
