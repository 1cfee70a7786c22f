#pragma once

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/results/trajectory.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/manifold/compliant_multipliers.h>
#include <dalembert/solvers/manifold/recovery.h>
#include <dalembert/solvers/manifold/start.h>
#include <dalembert/solvers/run/time_stepper.h>

#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

struct Segment;

/// The motion at every time of a run: of each step the stepper's own polynomial, kept as its values at the
/// extrema of the Chebyshev polynomial of its degree.
class KeptSteps final : public DenseOutput {
 public:
  explicit KeptSteps(double tolerance) : tolerance_(tolerance) {}

  /// From here on the steps are those of this segment, which starts at time t, maybe with another system. If
  /// it throws nothing has changed.
  void add_segment(const Segment& segment, double t);
  /// The last step ends at a switch, from whose time those from here on are not told.
  void ends_at_switch(double from) { segments_.back().ends_from = from; }
  /// What the last step's polynomial has beyond a time is no part of the run.
  void end(double t);
  [[nodiscard]] double end() const { return steps_.back().end; }
  /// The last step, its number in the run, and where it began; before the first, the start. Throws
  /// EquationFault, and then it is not among them.
  void add(TimeStepper& stepper, double from, long number);

  void read(std::span<const double> times, Record& out) const override;
  void as_read(double t, const std::function<void()>& f) const override;

 private:
  struct KeptSegment {
    std::shared_ptr<const System> system;
    Start start;
    double from;
    std::size_t first_step;
    Branches::Sides sides;  // of the comparisons in its equations, held up to and from these times
    double begins_to, ends_from = std::numeric_limits<double>::infinity();

    [[nodiscard]] const Branches::Sides* held(double t) const {
      return !sides.empty() && (t <= begins_to || t >= ends_from) ? &sides : nullptr;
    }
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
  [[nodiscard]] const KeptSegment& segment_of(const Step& step) const;
  void interpolate(const Step& step, double t, OutputState& m, CompliantMultipliers& compliant) const;

  std::shared_ptr<const System> system_;
  double tolerance_;
  std::vector<KeptSegment> segments_;
  std::vector<Step> steps_;
  std::vector<double> values_;  // per step and node: q, v, and of springs lambda and its derivatives
};

}  // namespace dalembert
