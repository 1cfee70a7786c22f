#pragma once

#include <dalembert/core/results/trajectory.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/manifold/compliant_multipliers.h>
#include <dalembert/solvers/manifold/recovery.h>
#include <dalembert/solvers/manifold/start.h>
#include <dalembert/solvers/run/time_stepper.h>

#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The motion at every time of a run: of each step the stepper's own polynomial, kept as its values at the
/// extrema of the Chebyshev polynomial of its degree.
class KeptSteps final : public DenseOutput {
 public:
  explicit KeptSteps(double tolerance) : tolerance_(tolerance) {}

  /// From here on the steps are those of a segment that starts with `start` at time t, maybe
  /// with another system. If it throws nothing has changed.
  void add_segment(std::shared_ptr<const System> system, const Start& start, double t);
  /// What the last step's polynomial has beyond a time is no part of the run.
  void end(double t);
  [[nodiscard]] double end() const { return steps_.back().end; }
  /// The last step, its number in the run, and where it began; before the first, the start. Throws
  /// EquationFault, and then it is not among them.
  void add(TimeStepper& stepper, double from, long number);

  void read(std::span<const double> times, Record& out) const override;

 private:
  struct KeptSegment {
    std::shared_ptr<const System> system;
    Start start;
    double from;
    std::size_t first_step;
  };
  struct Step {
    double from, to;
    double end;  // of the part that belongs to the run
    long number;
    int degree;
    std::size_t first;  // of its values
    double c;           // see CompliantMultipliers; 0 if the state has none
  };
  [[nodiscard]] const Step& step_at(double t) const;
  void interpolate(const Step& step, double t, OutputState& m, CompliantMultipliers& compliant) const;

  std::shared_ptr<const System> system_;
  double tolerance_;
  std::vector<KeptSegment> segments_;
  std::vector<Step> steps_;
  std::vector<double> values_;  // per step and node: q, v, and of springs lambda and its derivatives
};

}  // namespace dalembert
