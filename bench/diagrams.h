#pragma once

#include <string>

namespace dalembert::bench {

struct Diagrams {
  std::string directory = ".";  ///< of the tables
  int points = 60;              ///< of Kapitza's chart along either axis
};

/// Writes what bench/charts/diagrams.gp draws: hoop.csv and governor.csv, the branches of equilibria over the
/// rate of rotation (columns branch, rate, angle_deg, softest); kapitza.csv, the growth of a pendulum upright
/// on a vibrating pivot in a period over amplitude and gravity; kapitza-boundary.csv, where it is exactly 1.
/// Throws Error if a file cannot be written.
void diagrams(const Diagrams& options);

}  // namespace dalembert::bench
