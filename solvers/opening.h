#pragma once

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/base/options.h>
#include <dalembert/solvers/contact/change.h>
#include <dalembert/solvers/contact/conditional_constraints.h>
#include <dalembert/solvers/linear/problem.h>
#include <dalembert/solvers/manifold/start.h>

#include <memory>
#include <span>

namespace DALEMBERT_HIDDEN dalembert {

/// How a run opens: a consistent state, with the constraints that are in force after the impacts of its
/// start.
struct Opening {
  std::unique_ptr<ConditionalConstraints> conditional;  ///< null if all constraints always hold
  Change change;                                        ///< their impacts at the start
  Problem problem;                                      ///< of the constraints in force
  Start start;
  Scales given;  ///< in which it was told what touches, sticks and separates
  /// Those behind, of batches in which a comparison with the time switches at the start.
  Branches::Sides sides;
};

/// Gives the start of a scene without a length of its own that of the path of a first step, up to where it
/// leaves the sides of comparisons, or those given. Where nothing but round-off moves on it the start
/// waits for another; returns how long such a path is.
double measure_path(const Problem& problem, Start& start, const Options& options,
                    const Branches::Sides& sides);

/// Of what a scene states, from a guess of its state. A scene without a characteristic length gets that of a
/// first explicit step, whose error is within the tolerance of its own length. Throws InconsistentStart;
/// StepFailure and EquationFault where contacts cannot be resolved.
[[nodiscard]] Opening open_run(const std::shared_ptr<const System>& stated, std::span<const double> q,
                               std::span<const double> v, const Options& options);

}  // namespace dalembert
