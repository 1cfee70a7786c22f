#pragma once

#include <dalembert/core/results/event.h>
#include <dalembert/core/results/trajectory.h>
#include <dalembert/solvers/base/hidden.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Finds the events of a run, step by step: where the functions change their sign on the stepper's own
/// polynomial, with recovered forces.
///
/// Within a step a function is known at the nodes of a Chebyshev interpolant of the polynomial's degree.
/// Where that turns towards 0 between two nodes of one sign, or first crosses the 0 that it began with, the
/// function itself is evaluated: so two roots within a step are found as well, if the interpolant resolves
/// the function.
class EventWatch {
 public:
  /// The polynomial of the last step at a time inside it.
  using Read = std::function<FlatSample(double t)>;

  /// Throws InvalidArgument for an event without function.
  EventWatch(std::vector<FlatEvent> events, const Layout& layout);

  /// What happened in a step that ended at `to`, in the order of time; steps follow each other. Throws
  /// StepFailure if a function throws or gives no number.
  [[nodiscard]] std::vector<Occurrence> look(const Read& read, double to, int degree);
  /// From here on steps are those of a run that begins, or begins anew, at a sample; the values of the
  /// functions there are no crossing, and as long as one is 0 to round-off of its largest value so far it has
  /// no sign. Those from number `positive` on come from above 0 where they are 0.
  void begin_anew(const FlatSample& start, std::size_t positive);
  [[nodiscard]] const FlatEvent& event(std::size_t number) const { return events_[number]; }

 private:
  struct Place {
    double t, value;
  };
  [[nodiscard]] double value(std::size_t event, const FlatSample& at);
  [[nodiscard]] int first_side(std::size_t event, double value) const;
  [[nodiscard]] std::vector<Place> places(std::size_t event, const Read& read,
                                          const std::vector<double>& values);
  void find(std::size_t event, const Read& read, const std::vector<double>& values,
            std::vector<Occurrence>& occurred);

  std::vector<FlatEvent> events_;
  double from_ = 0.0;
  std::vector<double> nodes_;    ///< of the step that is looked at
  std::vector<double> at_from_;  ///< of each event its value where the last step ended,
  std::vector<int> side_;        ///< its sign there or before, if it is 0; 0 if it never had one,
  std::vector<double> largest_;  ///< and the largest value so far
};

}  // namespace dalembert
