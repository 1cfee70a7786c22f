#pragma once

#include <dalembert/solvers/manifold/start.h>
#include <dalembert/solvers/run/time_stepper.h>

#include <memory>

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
class IdaStepper final : public TimeStepper {
 public:
  IdaStepper(const Problem& problem, const Start& start, const Options& options);
  ~IdaStepper() override;

  /// Where output is wanted makes no difference: the BDF polynomial is as accurate between steps as at them.
  void step(double wanted) override;
  [[nodiscard]] double time() const override;
  [[nodiscard]] StepError error() const override;
  /// Of the holonomic constraints, where Newton's matrix was factored last.
  [[nodiscard]] double sine() const override;
  void interpolate(double t, std::span<double> q, std::span<double> v) override;
  [[nodiscard]] int degree() const override { return 5; }  // BDF of order 5
  /// False before the first step.
  [[nodiscard]] bool compliant_multipliers(double t, CompliantMultipliers& out) const override;
  void count(Statistics& statistics) const override;

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace dalembert
