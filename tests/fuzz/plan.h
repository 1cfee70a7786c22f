#pragma once

#include "functions.h"
#include "random.h"
#include <dalembert/solvers/options.h>

#include <string>

namespace dalembert::fuzz {

/// What kind of scene a seed makes, in which units, and how it is run.
///
///   sensible   a scene as a user might write it, in any units: it must be accepted, and should run
///   wild       masses, stiffnesses, speeds that differ by many decades, too many constraints
///   invalid    some numbers, names, handles, options or functions are wrong
struct Plan {
  enum class Kind { sensible, wild, invalid };
  Kind kind = Kind::sensible;
  double length = 1.0, time = 1.0, mass = 1.0;  ///< the scene's units
  double spread = 0.5;                          ///< sizes differ by 10^-spread ... 10^spread
  double wrong = 0.0;                           ///< chance of a wrong number, name or handle
  int particles = 1, bodies = 0, rotors = 0, constraints = 0, forces = 0;
  bool moving = true;  ///< initial velocities
  Options options;

  [[nodiscard]] double speed() const { return length / time; }
  [[nodiscard]] double acceleration() const { return length / time / time; }
  [[nodiscard]] double force() const { return mass * acceleration(); }
};

[[nodiscard]] const char* name(Plan::Kind kind);
[[nodiscard]] Plan random_plan(Random& random);

/// One of the numbers that no one means.
[[nodiscard]] double wrong_number(Random& random, double meant);

}  // namespace dalembert::fuzz
