#pragma once

#include "verdict.h"

#include <vector>

namespace dalembert::fuzz {

/// Judges every task and prints a tally, and a line for each fault (or, if `list`, for each task).
/// Tasks run in child processes, some at a time, so that a crash or a hang is a fault of one scene and
/// the rest go on. A scene that takes more than `longest` seconds of processor time hangs (so that a busy
/// machine does not count). What became of every pair of features is written to the file `pairs`, if it has a
/// name. Returns the number of faults.
[[nodiscard]] int run_all(const std::vector<Task>& tasks, int longest, bool list, const std::string& pairs);

}  // namespace dalembert::fuzz
