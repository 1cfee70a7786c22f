#pragma once

#include <dalembert/core/results/layout.h>
#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>

#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The particles of one body.
using BodyParticles = std::vector<const Layout::Particle*>;

/// Particles that internal constraints hold together, body by body: an affine basis of each.
[[nodiscard]] std::vector<BodyParticles> bodies(const System& system);

}  // namespace dalembert
