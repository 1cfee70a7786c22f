#pragma once

#include "verdict.h"

#include <vector>

namespace dalembert::fuzz {

/// Judges every task and prints a tally, and a line for each fault (or, if `list`, for each task).
/// Tasks run in child processes, some at a time, so that a crash or a hang is a fault of one scene and
/// the rest go on. Returns the number of faults.
[[nodiscard]] int run_all(const std::vector<Task>& tasks, bool list);

}  // namespace dalembert::fuzz
