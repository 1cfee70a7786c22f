#pragma once

#include <dalembert/core/results/event.h>
#include <dalembert/core/results/trajectory.h>
#include <dalembert/solvers/base/accuracy.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/run/interpolant.h>
#include <dalembert/solvers/run/rounded_sample.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Finds the events of a run, step by step: where the functions change their sign on the stepper's own
/// polynomial, with recovered forces.
///
/// Within a step a function is known at the nodes of a Chebyshev interpolant of the polynomial's degree. What
/// may be faster than the motion, which steps follow, is known at those of at least 6, and of as many as
/// resolve it: events that were asked for, all functions where forces or constraints depend on time, and
/// those whose own rates at the nodes differ from the slopes there.
/// Where one turns towards 0 between two nodes of one sign, by more than round-off, or first crosses the 0
/// that it began with, the function itself is evaluated: so two roots within a step are found as well; of
/// contacts their rates tell where, however narrow it is. How one leaves the 0 that it has after a change is
/// seen ahead of the steps: a bounce may be far shorter than they are.
class EventWatch {
 public:
  /// The polynomial of the last step at a time inside it.
  using Read = std::function<FlatSample(double t)>;
  /// Steps follow each other.
  struct Step {
    const Read& read;
    double to;
    int degree;
    bool ends_run;
  };
  /// A crossing, the sign that the function had before, and whether that way was asked for.
  struct Found {
    EventRecord record;
    int before;
    bool wanted;
  };

  /// What is known of the events of contacts; empty if there are none.
  struct OfContacts {
    /// The derivative by time; NaN if it is not known.
    std::function<double(std::size_t event, const FlatSample& at)> rate;
    /// The unit of the values from a time on, which changes with what is closed and sticks; 0 if that is
    /// their own size.
    std::function<double(std::size_t event, double from)> unit;
    /// What the values are larger by, so that round-off changes nothing, than what is 0 at the change.
    std::function<double(std::size_t event)> margin;
  };

  /// Of a run at this tolerance. Throws InvalidArgument for an event without function.
  EventWatch(std::vector<FlatEvent> events, OfContacts of_contacts, const std::string& scene,
             double tolerance);

  /// Every crossing in a step, in the order of time; of contacts those that were asked for. Throws
  /// StepFailure if a function throws, gives no number or cannot be followed.
  [[nodiscard]] std::vector<Found> locate(const Step& step);
  /// Where a segment of a run starts.
  struct Beginning {
    const FlatSample& start;
    const FlatSample* before;  ///< what has changed there; null if nothing has
    std::size_t positive;      ///< functions from this number on come from above 0 where they are 0
    bool timed;                ///< something depends on time
    /// Of the last step, but behind the start: it still has the sign that it had before.
    const std::vector<Found>& left;
    std::optional<std::size_t> changed;  ///< the event whose change this is
    const Read& ahead;                   ///< the start, moved on by its own velocities and accelerations
    double time, length;                 ///< of the scene
    const System& system;                ///< from here on
  };
  /// From here on steps are those of a run that begins there. Returns the crossings of events that were asked
  /// for by what jumps there, as a velocity does at an impact. One that is 0, to round-off of its largest
  /// value so far, has the sign to which it leaves 0; as long as it does not leave it has none. Throws
  /// StepFailure where changes of an event accumulate: what one turned back no longer shows how it leaves.
  [[nodiscard]] std::vector<Found> restart(const Beginning& beginning);
  /// The first of `count` functions from this one on, of contacts, that is negative there: no crossing shows
  /// it.
  [[nodiscard]] std::optional<std::size_t> triggered_at_start(std::size_t first, std::size_t count) const;
  /// Throws StepFailure: the changes of an event accumulate.
  [[noreturn]] void chatters(std::size_t event, double t) const;
  [[nodiscard]] const FlatEvent& event(std::size_t number) const { return events_[number]; }

 private:
  struct Place {
    double t, value;
  };
  [[nodiscard]] double value(std::size_t event, const FlatSample& at);
  /// What its values are measured by.
  [[nodiscard]] double size(std::size_t event) const { return std::max(largest_[event], units_[event]); }
  [[nodiscard]] double size_of_terms(std::size_t event, const FlatSample& at);
  void measure_what_stays(std::size_t event, const FlatSample& at, double value);
  [[nodiscard]] int first_side(std::size_t event, double value) const;
  /// How a function leaves the 0 that it begins with.
  struct Departure {
    int side = 0;        ///< the sign that it gets; 0 if it stays
    double at = 0.0;     ///< when that is clear
    bool clear = false;  ///< by its rate
  };
  [[nodiscard]] Departure departure(std::size_t event, const Beginning& beginning);
  void forget_behind(std::size_t event, double t);
  void depart(std::size_t event, const Beginning& beginning);
  [[nodiscard]] Place first_place(std::size_t event, const Read& read, const Interpolant& part);
  [[nodiscard]] std::vector<Place> places(std::size_t event, const Read& read,
                                          const std::vector<Interpolant>& parts);
  [[nodiscard]] int side_at_end(std::size_t event, const Place& before, const Place& end) const;
  [[nodiscard]] double root_of(std::size_t event, const Step& step, const Place& a, const Place& b,
                               double exact);
  void find(std::size_t event, const Step& step, const std::vector<Interpolant>& parts,
            const std::vector<Place>& dips, std::vector<Found>& found);
  /// Of an event, over a step.
  struct Values {
    Interpolant whole{};
    std::vector<double> at_checks{};  ///< if it is resolved
    std::vector<double> rates{};      ///< at the nodes, if they may be known
  };
  [[nodiscard]] std::vector<Place> dips(std::size_t event, const Read& read, const Values& values);
  [[nodiscard]] bool shows(std::size_t event, const Values& values) const;
  [[nodiscard]] std::vector<Interpolant> resolved(std::size_t event, const Step& step, Values values);

  std::vector<FlatEvent> events_;
  OfContacts of_contacts_;
  Accuracy accuracy_;
  std::optional<RoundedSample> rounded_;  ///< of this segment, if events were asked for
  double from_ = 0.0;
  std::size_t asked_for_ = 0;             ///< the first of them; behind are those of contacts
  std::size_t resolved_ = 0;              ///< the first of them may be faster than the motion
  std::vector<double> at_from_;           ///< of each event its value where the last step ended,
  std::vector<double> rate_at_from_;      ///< its rate there, if it is known,
  std::vector<int> side_;                 ///< its sign there or before, if it is 0; 0 if it never had one,
  std::vector<double> largest_;           ///< and the largest value so far;
  std::vector<double> units_;             ///< of events of contacts, as they are in this step, or of terms;
  std::vector<double> largest_before_;    ///< before the last step,
  std::vector<std::vector<Place>> seen_;  ///< and the sizes of the values since;
  std::vector<double> at_root_;           ///< what it may still be where it was found to be 0,
  std::vector<int> before_;               ///< and its sign before;
  std::vector<double> leaves_;            ///< when it is clear how it left 0 where the run began,
  std::vector<char> returned_;            ///< and whether its own last change turned it back
};

}  // namespace dalembert
