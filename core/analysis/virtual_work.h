#pragma once

#include <dalembert/core/results/sample.h>
#include <dalembert/core/scene/scene.h>
#include <dalembert/core/scene/system.h>

#include <string>
#include <vector>

namespace dalembert {

/// d'Alembert's principle checked at one instant (notes, mln7), and the power of each constraint and force.
struct VirtualWork {
  struct Power {
    std::string name;
    double power;  ///< positive: puts energy in [force length / time]
  };
  /// The largest work of the constraint forces in a virtual displacement of unit length, over a basis
  /// of all displacements that the constraints allow at a fixed time [force]. Round-off for ideal
  /// constraints.
  double largest = 0.0;
  double largest_force = 0.0;      ///< largest constraint force on a coordinate, to compare with
  std::vector<Power> constraints;  ///< Z . v of each: round-off unless it depends on time or is compliant
  std::vector<Power> forces;       ///< F . v of each; constant forces (gravity) together come first
};

/// Of a state of a scene, with the forces of constraint found there.
[[nodiscard]] VirtualWork virtual_work(const System& system, const FlatSample& sample);
/// The same at a sample of a run of this scene, or of one with the same particles and rotors. Throws
/// InvalidArgument if it is none.
template <int D>
[[nodiscard]] VirtualWork virtual_work(const Scene<D>& scene, const Sample<D>& sample) {
  scene.require_state(sample);
  return virtual_work(scene.system(), sample.flat());
}

}  // namespace dalembert
