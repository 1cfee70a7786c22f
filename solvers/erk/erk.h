#pragma once

#include <dalembert/core/results/statistics.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/manifold/start.h>

#include <memory>
#include <span>

namespace DALEMBERT_HIDDEN dalembert {

/// Steps the equations of motion by an explicit Runge-Kutta pair of orders 8 and 7 (verner87), with
/// accelerations from the constraints differentiated twice, and puts each accepted step back onto
/// the constraints:
///
///   (1)  q' = v,  v' = a,  [ M  -W^T ] [ a      ]   [    F   ]
///                          [ W   0   ] [ lambda ] = [ -gamma ]
///   (2)  land: one mass-weighted Newton step of q, one of v.
///
/// The projection moves a step by no more than its local error, so the order stays 8 and nothing
/// drifts. No Jacobian, no nonlinear solve: for scenes that are not stiff a small part of the cost
/// of IdaStepper.
///
/// Steps are cut so that they end where output is wanted. Where several outputs fall into one step,
/// half a step more gives its middle, and the polynomial of degree 8 through q, q', q'' at both
/// ends and the middle serves for all of them; its error has the order 9 of the step's own.
///
/// Isolated singular positions are passed by extrapolation: see State::cross.
///
/// Why not ARKODE: on scenes of a few coordinates its own work per stage, 0.2 us, is more than
/// twice that of the equations of motion here, and its Hermite interpolation (order 5) is less
/// accurate than the steps.
class ErkStepper {
 public:
  /// The system must outlive the stepper.
  ErkStepper(const System& system, const Start& start, const Options& options);
  ErkStepper(ErkStepper&&) noexcept;
  ErkStepper& operator=(ErkStepper&&) noexcept;
  ~ErkStepper();

  /// One accepted step, not beyond t_end; `wanted` is the next time of output. It may take the place of the
  /// last one and end earlier than that. Throws StepFailure.
  void step(double wanted);
  [[nodiscard]] double time() const;
  [[nodiscard]] const Scales& scales() const;
  /// See Manifold::sine; where the last step ended.
  [[nodiscard]] double sine() const;
  /// The state at a time inside the last step (or at the start, before the first). Throws
  /// EquationFault.
  void interpolate(double t, std::span<double> q, std::span<double> v);
  /// Adds its counts.
  void count(Statistics& statistics) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace dalembert
