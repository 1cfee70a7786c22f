#include "dalembert/core/islands.h"

#include <numeric>

namespace dalembert {

namespace {

/// Disjoint sets of coordinates, each known by its smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(int size) : parent_(static_cast<std::size_t>(size)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int root(int i) {
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
  }
  void join(int a, int b) {
    const int first = root(a), second = root(b);
    parent(std::max(first, second)) = std::min(first, second);
  }

 private:
  int& parent(int i) { return parent_[static_cast<std::size_t>(i)]; }
  std::vector<int> parent_;
};

}  // namespace

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
