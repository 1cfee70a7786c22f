#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/erk/erk.h>
#include <dalembert/solvers/run/singularity.h>
#include <dalembert/solvers/run/switches.h>

#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// An instant between two steps: positions, and velocities and accelerations in one piece, as the
/// first stage of the next step.
struct ErkStepper::Node {
  double t = 0.0;
  std::vector<double> q, va;
  double sine = 1.0;  // see Manifold,
  long rows = 0;      // of those in use after so many exchanges
  Slope side{};       // of friction laws; unset if there are none

  [[nodiscard]] Angle angle() const { return {t, sine}; }
};

}  // namespace dalembert
