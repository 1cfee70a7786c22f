#pragma once

#include <dalembert/bench/statement.h>

#include <string>
#include <vector>

namespace dalembert::bench {

/// One motion, stated in full and without what it does not need.
struct Pair {
  std::string scene;
  std::string left_out;
  double length;  ///< the scene's own, which tolerances refer to [length]
  double t_end;
  Statement full, lean;
  int samples_full = 11, samples = 11;  ///< the latter are among the former
  bool dense_full = false;              ///< the motion between samples is kept
};

/// All pairs; `size` beads in a chain, and as many islands.
[[nodiscard]] std::vector<Pair> leave_out_pairs(int size);

}  // namespace dalembert::bench
