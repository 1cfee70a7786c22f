#pragma once

#include <dalembert/solvers/manifold/start.h>
#include <dalembert/solvers/run/time_stepper.h>

#include <memory>

namespace DALEMBERT_HIDDEN dalembert {

/// Integrates the equations of motion by an explicit Runge-Kutta pair of orders 8 and 7 (verner87), with
/// accelerations from the constraints differentiated twice, and projects each accepted step onto the
/// constraint manifold:
///
///   (1)  q' = v,  v' = a,  [ M  -W^T ] [ a      ]   [    F   ]
///                          [ W   0   ] [ lambda ] = [ -gamma ]
///   (2)  projection: one mass-weighted Newton step of q, one of v.
///
/// The projection moves a step by no more than its local error, so the order stays 8 and nothing
/// drifts. No Jacobian, no nonlinear solve: for scenes that are not stiff a small part of the cost
/// of IdaStepper.
///
/// Steps are chosen to end at output times. Where several of these fall into one step, half a step more gives
/// its middle, and the polynomial of degree 8 through q, q', q'' at both ends and the middle serves for all
/// of them; its error is of order 9 like the step's own.
///
/// Isolated singular positions are passed by extrapolation: see SingularPassage.
///
/// Why not ARKODE: on scenes of a few coordinates its own work per stage, 0.2 us, is more than
/// twice that of the equations of motion here, and its Hermite interpolation (order 5) is less
/// accurate than the steps.
class ErkStepper final : public TimeStepper {
 public:
  ErkStepper(const Problem& problem, const Start& start, const Options& options);
  ~ErkStepper() override;

  /// The step may replace the last one and end before it.
  void step(double wanted) override;
  void starts_at_switch() override;
  void hold_sides(const Branches::Sides& held) override;
  [[nodiscard]] std::span<const Compared> compared() const override;
  [[nodiscard]] double time() const override;
  [[nodiscard]] const Scales& scales() const;
  [[nodiscard]] StepError error() const override;
  [[nodiscard]] double sine() const override;
  void interpolate(double t, std::span<double> q, std::span<double> v) override;
  void sketch(double t, std::span<double> q, std::span<double> v) override;
  [[nodiscard]] int degree() const override { return 8; }  // Hermite<3>
  [[nodiscard]] bool compliant_multipliers(double /*t*/, CompliantMultipliers& /*out*/) const override {
    return false;
  }
  void count(Statistics& statistics) const override;

 private:
  struct Node;
  class Stages;
  class RoundOff;
  class StepErrors;
  struct RungeKutta;
  class SingularPassage;
  class FrictionSwitches;
  std::unique_ptr<RungeKutta> method_;
};

}  // namespace dalembert
