#pragma once

#include <dalembert/core/vec.h>

namespace dalembert {

/// A directed axis in space and where angles about it are counted from.
struct Axis {
  Vec<3> point = Vec<3>::Zero();       ///< any point of it [length]
  Vec<3> direction = Vec<3>::UnitZ();  ///< need not have unit length
  Vec<3> zero = Vec<3>::UnitX();       ///< angle 0; its part along the axis does not matter
};

}  // namespace dalembert
