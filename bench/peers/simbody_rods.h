#pragma once

#include <array>
#include <vector>

/// The seam to Simbody, whose headers are no C++20: C++17, and the standard library alone.
namespace dalembert::bench::simbody {

/// Rods strung one below the other from the origin, each with a bead at its lower end, from rest.
struct Rod {
  double mass;    ///< of the bead
  double length;  ///< of the rod
  double angle;   ///< of the rod from the downward vertical, towards +x [rad]
};

enum class Coordinates {
  minimal,   ///< each bead turns about the one above it: MobilizedBody::Pin
  cartesian  ///< each bead moves freely and is held to the one above it: Constraint::Rod
};

struct Sample {
  std::vector<std::array<double, 2>> positions;
  std::vector<double> tensions;
};

struct Run {
  std::vector<Sample> samples;
  long steps, evaluations;
  double run_time;  ///< processor time of integration and output, without set-up [s]
};

/// The motion from times.front() to times.back(), each time the end of a step; gravity along -y. By the
/// Runge-Kutta-Merson integrator, the fastest of Simbody's on these systems at errors of 1e-6 and 1e-8:
/// Feldberg's takes up to 1.5 times as long, RungeKutta3 and Verlet 3 to 50 times; CPodes runs into an
/// assertion of Debian's build.
[[nodiscard]] Run run(const std::vector<Rod>& rods, double gravity, Coordinates coordinates,
                      const std::vector<double>& times, double tolerance);

}  // namespace dalembert::bench::simbody
