#pragma once

#include <dalembert/models/model.h>

namespace dalembert::models {

/// A scene of one particle on one plane curve, fixed or driven.
struct BeadOnCurve {
  Scene<2> scene;
  Particle<2> bead;
  Constraint<1> curve;  ///< g has unit gradient, so the multiplier is the force of the curve on the bead
};

/// The sign of the force of the curve in a derivation: positive the way g grows, or against it.
enum class Counted { along_gradient, against_gradient };

/// Observes the position of the bead and the force of the curve on it.
[[nodiscard]] Observed<2> observed(BeadOnCurve built, Counted force);

}  // namespace dalembert::models
