#pragma once

#include <dalembert/bench/report.h>

#include <cstddef>
#include <string>

namespace dalembert::bench {

/// What a sweep costs beside its runs, and that nothing is lost in it.
struct SweepTable {
  std::size_t rows = 100'000;  ///< pendulums
  int rounds = 5;              ///< of the timed cases, one after the other; medians count
  int kills = 10;              ///< of one rank, of all, and of a single process
  std::size_t flips = 1000, kapitza = 150, governors = 20'000;  ///< points, points, rows of the pictures
  std::string directory = ".";                                  ///< where pictures' tables go
  ReportOptions report{};
};

/// Rows that are wrong.
int sweep_table(const SweepTable& options);

/// Prints what rows and chunks cost beside the work.
void sweep_overhead(const std::string& file);

/// One case, in a process of its own: prints run time [s], failed rows and peak memory [MiB].
void sweep_case(const std::string& example, std::size_t rows, int threads, std::size_t bad,
                const std::string& file);

}  // namespace dalembert::bench
