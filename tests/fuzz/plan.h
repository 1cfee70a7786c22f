#pragma once

#include "features.h"
#include "functions.h"
#include "random.h"
#include <dalembert/solvers/base/options.h>

#include <array>
#include <string>
#include <vector>

namespace dalembert::fuzz {

/// What scenes are made of, and what their runs are compared with.
///
///   any        everything; a run is checked by itself
///   redundant  hinges, frames and constraints that others imply: against the run without those
///   kinked     forces and constraints with kinks and jumps: one stepper against the other
///   one-sided  floors, walls, strings, spheres, particles that meet: gaps, signs of forces, impulses, energy
///   rough      particles that stick and slide on planes and spheres: bounds of friction, energy
///   products   a few of all features at once: by the library's own audit, the other stepper, and the same
///              motion stated or run otherwise
enum class Family { any, redundant, kinked, one_sided, rough, products };
inline constexpr std::array families{Family::any,       Family::redundant, Family::kinked,
                                     Family::one_sided, Family::rough,     Family::products};
[[nodiscard]] const char* name(Family family);

/// What kind of scene a seed makes, in which units, and how it is run.
///
///   sensible   a scene as a user might write it, in any units: it must be accepted, and should run
///   wild       masses, stiffnesses, speeds that differ by many decades, too many constraints
///   invalid    some numbers, names, handles, options or functions are wrong
struct Plan {
  enum class Kind { sensible, wild, invalid };
  Kind kind = Kind::sensible;
  Family family = Family::any;
  double length = 1.0, time = 1.0, mass = 1.0;  ///< the scene's units
  double spread = 0.5;                          ///< sizes differ by 10^-spread ... 10^spread
  double wrong = 0.0;                           ///< chance of a wrong number, name or handle
  int particles = 1, bodies = 0, rotors = 0, constraints = 0, forces = 0;
  bool moving = true;               ///< initial velocities
  double turns = 1.0;               ///< of bodies, times 1/time
  double repeat = 0.0;              ///< chance that a constraint is stated twice
  double still = 0.6;               ///< chance that a point of the ground stays where it is
  bool lossless = false;            ///< of one-sided scenes: nothing takes energy away
  std::vector<Feature> features{};  ///< of products
  Options options;

  [[nodiscard]] bool has(Feature feature) const;
  [[nodiscard]] double speed() const { return length / time; }
  [[nodiscard]] double acceleration() const { return length / time / time; }
  [[nodiscard]] double force() const { return mass * acceleration(); }
};

[[nodiscard]] const char* name(Plan::Kind kind);
[[nodiscard]] Plan random_plan(Random& random, Family family, Stepper stepper);

/// One of the numbers that no one means.
[[nodiscard]] double wrong_number(Random& random, double meant);

}  // namespace dalembert::fuzz
