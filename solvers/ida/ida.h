#pragma once

#include <dalembert/core/results/statistics.h>
#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/manifold/springs.h>
#include <dalembert/solvers/manifold/start.h>

#include <memory>
#include <span>

namespace DALEMBERT_HIDDEN dalembert {

/// Steps the stabilised index-2 equations (see NewtonMatrix) by SUNDIALS' IDA: variable-order,
/// variable-step BDF.
///
/// The error test looks at q and v only. Multipliers are index-2 variables whose round-off grows
/// like 1/h; Newton's iteration weighs each by the impulse it delivers in one step,
///
///   h |lambda| |W| ~ m v,    h |mu| |G| ~ m q,
///
/// and is made tight, so that they do not limit the step. Forces of constraint are not read off
/// here but recovered from (q, v) by Manifold. (Those of compliant constraints are part of the state;
/// from them, too, Manifold recovers.)
class IdaStepper {
 public:
  /// The system must outlive the stepper.
  IdaStepper(const System& system, const Start& start, const Options& options);
  IdaStepper(IdaStepper&&) noexcept;
  IdaStepper& operator=(IdaStepper&&) noexcept;
  ~IdaStepper();

  /// One accepted step, not beyond t_end. Throws StepFailure. (Where output is wanted makes no
  /// difference: the BDF polynomial is as accurate between steps as at them.)
  void step(double wanted);
  [[nodiscard]] double time() const;
  /// See Manifold::sine; of the holonomic constraints, where Newton's matrix was factored last.
  [[nodiscard]] double sine() const;
  /// The state at a time inside the last step (or at the start, before the first).
  void interpolate(double t, std::span<double> q, std::span<double> v) const;
  /// The multipliers of compliant rows at such a time. False if the positions say all: before the first
  /// step.
  [[nodiscard]] bool springs(double t, Springs& out) const;
  /// Adds its counts.
  void count(Statistics& statistics) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace dalembert
