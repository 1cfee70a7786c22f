#pragma once

#include <dalembert/core/vec.h>

namespace dalembert {

/// A uniform rotation of a whole scene: about a fixed axis in space, about a fixed point in the plane. A rate
/// of zero is rest. Particles are carried round; in the plane rotors turn as much, in space they keep their
/// angles.
template <int D>
struct UniformRotation;

template <>
struct UniformRotation<3> {
  Vec<3> rate = Vec<3>::Zero();    ///< angular velocity, along the axis, right-handed [rad / time]
  Vec<3> centre = Vec<3>::Zero();  ///< any point of the axis [length]
};

template <>
struct UniformRotation<2> {
  double rate = 0.0;               ///< counter-clockwise [rad / time]
  Vec<2> centre = Vec<2>::Zero();  ///< [length]

  /// The same in space, about an axis along z.
  operator UniformRotation<3>() const { return {{0.0, 0.0, rate}, {centre.x(), centre.y(), 0.0}}; }
};

}  // namespace dalembert
