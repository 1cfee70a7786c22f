#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>

#include <span>

namespace DALEMBERT_HIDDEN dalembert {

/// The largest violation of the constraints at a state, and which row has it. A row's residual is
/// divided by the length of its gradient: |g|/|G| is the distance to the constraint, |psi|/|W| a
/// speed. `lengths` turns each coordinate into a length: 1, or the scene's length for an angle.
struct Violation {
  double size = 0.0;
  std::size_t row = 0;  // says nothing if there is none
};
[[nodiscard]] Violation position_violation(const System& system, const System::Evaluation& e,
                                           std::span<const double> lengths);
[[nodiscard]] Violation velocity_violation(const System& system, const System::Evaluation& e,
                                           std::span<const double> lengths);

}  // namespace dalembert
