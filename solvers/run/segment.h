#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/base/options.h>
#include <dalembert/solvers/manifold/start.h>
#include <dalembert/solvers/run/comparisons.h>
#include <dalembert/solvers/run/output_projection.h>
#include <dalembert/solvers/run/sticking.h>
#include <dalembert/solvers/run/time_stepper.h>

#include <memory>
#include <optional>

namespace DALEMBERT_HIDDEN dalembert {

/// A part of a run in which one stepper steps the same equations, with all that its start determines.
struct Segment {
  Problem problem;
  Start start;
  Comparisons comparisons;
  Stepper by;  ///< that of the options, or close to a singular position the explicit one
  OutputProjection output;
  std::unique_ptr<TimeStepper> stepper;
  std::optional<Sticking> sticking;  ///< in a run by the implicit stepper, if there is friction

  /// As long as it lives equations are evaluated on the sides of this segment.
  [[nodiscard]] Branches hold() const { return {nullptr, comparisons.held()}; }
};

}  // namespace dalembert
