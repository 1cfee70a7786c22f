#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/manifold/scales.h>

#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Per coordinate, the force that the applied forces make of a displacement of round-off, ten roundings of
/// the positions or of the lengths between them: of springs it is all that is left at their natural lengths.
/// Throws EquationFault.
[[nodiscard]] std::vector<double> spring_noise(const System& system, const Scales& scales, const Instant& at);

}  // namespace dalembert
