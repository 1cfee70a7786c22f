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
/// Where that turns towards 0 between two nodes of one sign the function is asked there: so two roots within
/// a step are found as well, if the interpolant resolves the function.
class EventWatch {
 public:
  /// What the last step says at a time inside it.
  using Read = std::function<FlatSample(double t)>;

  /// Throws InvalidArgument for an event without function; StepFailure as `look`.
  EventWatch(std::vector<FlatEvent> events, const Layout& layout, const FlatSample& start);

  /// Looks at a step that ended at `to`; steps follow each other. Events are appended to `found`. Throws
  /// StepFailure if a function throws or gives no number.
  void look(const Read& read, double to, int degree);
  /// Where an event has ended the run.
  [[nodiscard]] std::optional<double> end() const { return end_; }
  [[nodiscard]] const std::vector<Occurrence>& found() const { return found_; }
  /// Puts them, and a sample of each, among the results of a run.
  void write(Record& record) const;

 private:
  struct Place {
    double t, value;
  };
  [[nodiscard]] double value(std::size_t event, const FlatSample& at) const;
  [[nodiscard]] std::vector<Place> places(std::size_t event, const Read& read,
                                          const std::vector<double>& values, double to) const;
  void find(std::size_t event, const Read& read, const std::vector<double>& values, double to,
            std::vector<Occurrence>& occurred);

  std::vector<FlatEvent> events_;
  double from_;
  std::vector<double> at_from_;  ///< of each event its value where the last step ended,
  std::vector<int> side_;        ///< and its sign there or before, if it is 0; 0 if it never had one
  std::vector<Occurrence> found_;
  Record samples_;
  std::optional<double> end_;
};

}  // namespace dalembert
