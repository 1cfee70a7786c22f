#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>

#include <cstddef>
#include <span>

namespace DALEMBERT_HIDDEN dalembert {

/// The fastest vibrations of a linearised scene, by the size of their entries [1 / time].
struct Vibrations {
  double of_compliance = 0.0;  ///< of compliant rows; 0 if there are none
  double of_forces = 0.0;      ///< of the forces' stiffness
  std::size_t stiffest = 0;    ///< the entry that gives it, see ForceBatches::owner_of_stiffness
};

/// A force whose own damping is beyond critical does not vibrate; the stiffness of a damper that turns is
/// one. `scratch` has one number per coordinate.
[[nodiscard]] Vibrations fastest_vibrations(const System& system, std::span<const double> w,
                                            const System::Linearisation& linear, std::span<double> scratch);

}  // namespace dalembert
