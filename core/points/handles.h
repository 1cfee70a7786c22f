#pragma once

#include <dalembert/core/vec.h>

#include <cstdint>
#include <type_traits>

namespace dalembert {

/// A constraint of a scene, as returned by Scene::add: a handle to read its multipliers and forces
/// with, and to state it anew. Rows is the number of its scalar equations. Valid for its own scene and
/// copies.
template <int Rows>
struct Constraint {
  int index = -1;           ///< its number in the scene, in the order of adding
  std::uint64_t scene = 0;  ///< identity of the scene it belongs to

  friend bool operator==(const Constraint&, const Constraint&) = default;
};

/// An applied force of a scene, as returned by Scene::add: a handle to read its value with, and to state it
/// anew.
struct Force {
  int index = -1;           ///< its number among the forces of the scene, in the order of adding
  std::uint64_t scene = 0;  ///< identity of the scene it belongs to

  friend bool operator==(const Force&, const Force&) = default;
};

/// The multiplier of a constraint: a number, or a vector for several equations.
template <int Rows>
using Multiplier = std::conditional_t<Rows == 1, double, Vec<Rows>>;

}  // namespace dalembert
