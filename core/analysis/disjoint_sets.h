#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace dalembert {

/// Disjoint sets of numbers from 0, each known by its smallest member.
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

}  // namespace dalembert
