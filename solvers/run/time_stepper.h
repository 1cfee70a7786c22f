#pragma once

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/results/statistics.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/manifold/compliant_multipliers.h>
#include <dalembert/solvers/run/accumulated_error.h>

#include <span>

namespace DALEMBERT_HIDDEN dalembert {

/// What the equations compare at a time.
struct Compared {
  double t = 0.0;
  Branches::Sides sides{};
};

/// Advances a system in time, by whatever method.
class TimeStepper {
 public:
  virtual ~TimeStepper() = default;

  /// One accepted step, not beyond t_end; `wanted` is the next time of output. Throws StepFailure.
  virtual void step(double wanted) = 0;
  /// Before the first step: that begins at a switch, where the equations may have no higher derivatives.
  virtual void starts_at_switch() {}
  /// Steps are taken on these sides: what they compare on their way may be noted.
  virtual void hold_sides(const Branches::Sides& /*held*/) {}
  /// Inside the last step, to what a look at the motion needs. Empty if nothing was noted.
  [[nodiscard]] virtual std::span<const Compared> compared() const { return {}; }
  /// Where the last step ended.
  [[nodiscard]] virtual double time() const = 0;
  /// What the last step may have erred by.
  [[nodiscard]] virtual StepError error() const = 0;
  /// See Manifold::sine; at or close to that time.
  [[nodiscard]] virtual double sine() const = 0;
  /// The state at a time inside the last step (or at the start, before the first). Throws EquationFault.
  virtual void interpolate(double t, std::span<double> q, std::span<double> v) = 0;
  /// The same to what a look at the motion needs, without further evaluations of the equations.
  virtual void sketch(double t, std::span<double> q, std::span<double> v) { interpolate(t, q, v); }
  /// Its degree as a polynomial in t, at most.
  [[nodiscard]] virtual int degree() const = 0;
  /// The multipliers of compliant rows at such a time. False if the positions determine them.
  [[nodiscard]] virtual bool compliant_multipliers(double t, CompliantMultipliers& out) const = 0;
  /// Adds its counts.
  virtual void count(Statistics& statistics) const = 0;
};

}  // namespace dalembert
