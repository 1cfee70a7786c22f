#pragma once

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/manifold/start.h>
#include <dalembert/solvers/run/compared_equations.h>
#include <dalembert/solvers/run/time_stepper.h>

#include <map>
#include <optional>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The comparisons in a scene's equations (see Branches): the sides that steps are taken on, and where the
/// motion leaves them.
///
/// While sides are held the equations are smooth, so a step and its polynomial know nothing of a switch
/// within it, and are right up to there. The difference a - b of each comparison is a function over the step:
/// it is looked at like an event's, and what lies behind its first root is not part of the motion. There the
/// run restarts, on the sides behind. Where the accelerations of both sides differ by less than the step
/// can tell, as at a jump of a higher derivative, the step goes on.
class Comparisons {
 public:
  /// For steps that begin with `start` at time t, on the sides where it is, but for batches that have known
  /// ones.
  Comparisons(const Problem& problem, const Start& start, double t, double tolerance,
              const Branches::Sides& known = {});
  /// Behind a switch: on the sides there, which are known to hold up to `checked`. Batches of which none is
  /// known are on the sides where the start is.
  struct Behind {
    double t, checked;
    Branches::Sides sides;
  };
  Comparisons(const Problem& problem, const Start& start, double tolerance, const Behind& behind);

  /// The sides that steps are taken on; null if nothing is compared.
  [[nodiscard]] const Branches::Sides* held() const { return any_ ? &held_ : nullptr; }
  /// Up to where they are known to hold.
  [[nodiscard]] double held_to() const { return from_; }

  /// A switch that a step must not go beyond.
  struct Switch {
    Motion at;               ///< with the accelerations before it
    std::size_t margin;      ///< that was left
    double distance;         ///< of it from 0, or what round-off makes of it
    bool clear;              ///< whether more than that is behind
    double ahead;            ///< the time after which it is clearly behind
    double step;             ///< that it was found in
    Branches::Sides behind;  ///< the sides there
  };
  /// That of a start between two sides, which goes on behind it.
  [[nodiscard]] const std::optional<Switch>& at_start() const { return at_start_; }
  /// Steps are taken behind it.
  void go_behind_start();
  /// The first one in the step that has just been taken.
  [[nodiscard]] std::optional<Switch> leave(TimeStepper& stepper);

  /// See ComparedEquations.
  [[nodiscard]] std::optional<std::size_t> corner(const Switch& one) {
    return equations_.corner(one.at.instant(), held_, one.behind);
  }
  [[nodiscard]] bool holds_at_times(std::size_t row) const { return equations_.holds_at_times(row); }
  /// Throws StepFailure for such a row.
  [[noreturn]] void refuse_corner(const Switch& one, std::size_t row) const;
  /// Throws StepFailure where a Lagrangian makes an impulse of the switch.
  void require_no_impulse(const Switch& one);
  /// Throws StepFailure where the motion on the other side, with the accelerations a, leads back at once
  /// (Filippov): then neither side goes on.
  void require_leaving(const Switch& one, std::span<const double> a);
  [[noreturn]] void chatters(const Switch& one);

 private:
  /// A comparison, whose difference may leave its side.
  struct Margin {
    std::size_t batch, comparison;
    int side;

    bool operator==(const Margin& other) const {
      return batch == other.batch && comparison == other.comparison;
    }
  };
  struct Root {
    double t;
    std::size_t margin;
  };
  struct Bracket {
    double a, f_a, b, f_b;
    std::size_t margin;
  };
  void find_switch_at_start(const Start& start);
  void list_margins();
  [[nodiscard]] static double margin(const Margin& of, const Branches::Sides& recorded);
  [[nodiscard]] static int side_of(const Margin& of, const Branches::Sides& recorded);
  [[nodiscard]] bool hear_behind(Switch& one);
  [[nodiscard]] bool hear_step(double t, bool sketched);
  void find_margins(double t, bool sketched, std::vector<double>& all);
  [[nodiscard]] double margin_at(std::size_t k, double t);
  void note_bend(double t, double to, const Branches::Sides& recorded);
  [[nodiscard]] double margin_ahead(std::size_t k, const Motion& from, double ahead);
  [[nodiscard]] double rounding(std::size_t k, const Motion& at);

  [[nodiscard]] const std::vector<std::size_t>& suspects(double to);
  [[nodiscard]] std::optional<Bracket> first_root(std::size_t k, double until, double to);
  [[nodiscard]] std::optional<Root> first_switch(double to);
  [[nodiscard]] Switch behind(const Root& root, double step);
  [[nodiscard]] std::optional<std::size_t> impulse(const Switch& one);
  [[nodiscard]] bool goes_wrong(const Branches::Sides& taken, double until);
  [[nodiscard]] bool turns_back(const Switch& one, double from);

  ComparedEquations equations_;
  double time_;  // the scene's
  std::size_t coordinates_;
  bool any_ = false;
  Branches::Sides held_, recorded_;
  std::optional<Switch> at_start_;
  std::vector<Margin> margins_;
  std::vector<Margin> passed_;      // in the step that is looked at, by no more than round-off
  TimeStepper* stepper_ = nullptr;  // of the step that is looked at
  double from_;                     // up to where the sides are known to hold
  double start_of_step_ = 0.0;      // that is looked at
  std::vector<double> at_from_;     // the margins at `from_`, if they are known,
  std::vector<double> at_end_;      // and where the step ends
  std::vector<double> least_;       // the least values of margins that are known in between,
  std::vector<double> bend_;        // and how far they are off the line between the ends, twice
  std::map<double, std::vector<double>> in_step_;  // the margins at times in between
  std::vector<std::size_t> suspects_;
  Motion motion_, other_;  // work
};

}  // namespace dalembert
