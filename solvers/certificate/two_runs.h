#pragma once

#include <dalembert/core/results/trajectory.h>

#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace dalembert {

/// Why the difference of two runs does not tell the error of the worse one.
enum class Doubt {
  none,
  at_a_jump,      ///< between the times that the two give for one impact or change: either side may be right;
                  ///< or between the last impact that one of them lists and the rest after infinitely many
  other_events,   ///< something happened in one run that did not in the other, or in another order
  horizon,        ///< the runs have parted: small differences have grown to the size of the motion
  no_better_run,  ///< no run is known to be more accurate: round-off, or the tolerance is the least there is
  no_counterpart,  ///< the more accurate run did not get there
  breaks_a_law     ///< one of the runs breaks a law of mechanics, see Audit
};

/// The larger of two: the standard's takes all of its algorithms along, which every scene would compile.
[[nodiscard]] inline double larger(double a, double b) { return a < b ? b : a; }

/// What the difference of the two at one instant tells.
struct Certainty {
  Doubt doubt = Doubt::none;    ///< why it is not known
  std::size_t counterpart = 0;  ///< the instant of the more accurate run that this one is compared with
  /// What round-off in the states may be, as a part of the scene's length and speed,
  double of_states = 0.0;
  double round_off = 0.0;              ///< and at most what part of their difference that is
  double roundings = 0.0;              ///< of its magnitude that any quantity there may be off by
  bool moved = false, kicked = false;  ///< positions jump there, velocities

  /// Of positions, which seldom jump.
  [[nodiscard]] Certainty of_positions() const { return but_for_forces(moved); }
  /// Of velocities, which jump at impacts.
  [[nodiscard]] Certainty of_velocities() const { return but_for_forces(kicked); }

 private:
  [[nodiscard]] Certainty but_for_forces(bool jump) const {
    Certainty its = *this;
    if (doubt == Doubt::at_a_jump && !jump) its.doubt = Doubt::none;
    return its;
  }
};

/// What each number of a sample may be off by in vibrations that an implicit run passes over: twice their
/// amplitude, at another phase. Where both runs do, their difference does not show it. Empty if nothing
/// vibrates; infinite where it is not known.
struct PassedOver {
  std::vector<double> q{}, v{}, a{};       ///< of each coordinate, as in FlatSample
  std::vector<double> lambda{}, forces{};  ///< of each multiplier and slot
};

/// A run and a more accurate one of the same scene at the same times, as flat arrays: which of their
/// differences are the errors of the worse one.
///
/// Let e and e' be the errors of the two. Their difference is e up to e', so its relative error as an
/// estimate of e is e'/e at most. What is known of that, before the motion makes errors grow or decay, is the
/// ratio of what the two runs claim (Statistics::accuracy): the motion does the same to both. So
///
///   claims in a ratio q below `most_of_better` = 1/5 make an estimate right to that part; up to 4/5, where
///   double precision allows no better run, e <= |difference| + q e is a bound, |difference|/(1 - q),
///   round-off (Statistics::round_off) is told from it by the same part, and
///   the growth is measured by the difference itself until that is of the size of the motion.
///
/// Beyond these nothing is claimed: see Doubt.
class TwoRuns {
 public:
  /// Part of the worse run's claim that the better one's may be.
  static constexpr double most_of_better = 0.2;
  /// Of the scene's length: differences that have grown so far are about to stop growing, so that the errors
  /// of the better run grow on unseen. Growth that is exponential passes the last decade in 2.3 of its times.
  static constexpr double parted = 0.1;

  /// `stopped` says why the more accurate run is not complete, if it is not.
  TwoRuns(std::shared_ptr<const Record> run, std::shared_ptr<const Record> reference,
          std::string stopped = {}, PassedOver passed_over = {});

  /// The one that was asked for.
  [[nodiscard]] const std::shared_ptr<const Record>& run() const { return run_; }
  /// The more accurate one.
  [[nodiscard]] const std::shared_ptr<const Record>& reference() const { return reference_; }

  /// At a sample of the run, and at the k-th thing that happened in it.
  [[nodiscard]] const Certainty& sample(std::size_t i) const { return samples_[i]; }
  /// What is known at the k-th thing that happened.
  [[nodiscard]] const Certainty& event(std::size_t k) const { return events_[k]; }

  /// The estimated error of a quantity of this magnitude that differs so much: no less than round-off of the
  /// quantity and in the states, below which differences mean nothing; infinite where nothing is known.
  [[nodiscard]] double error(double difference, double magnitude, const Certainty& its) const;
  /// The same of a position [length] or velocity, for which `unit` is the scene's length or speed.
  [[nodiscard]] double error_of_state(double difference, double magnitude, double unit,
                                      const Certainty& its) const {
    return larger(error(difference, magnitude, its), its.of_states * unit);
  }
  /// The same of forces.
  [[nodiscard]] double error_of_force(double difference, const Certainty& its) const {
    return error(difference, largest_force_, its);
  }
  /// Of the scene [length].
  [[nodiscard]] double length() const { return length_; }
  /// Length over time of the scene.
  [[nodiscard]] double speed() const { return length_ / time_; }
  /// What is no error because of round-off alone.
  [[nodiscard]] double round_off(double difference, double magnitude, const Certainty& its) const;
  /// Of the time of something that happened.
  [[nodiscard]] double error_of_time(std::size_t k) const;
  /// Of the time of the k-th thing that happened [time].
  [[nodiscard]] double round_off_of_time(std::size_t k) const;

  /// Whether all errors are known, but those beside a jump.
  [[nodiscard]] bool complete() const { return complete_; }

  /// Whether both runs pass over vibrations.
  [[nodiscard]] bool vibrates() const { return !passed_over_.q.empty(); }
  /// What they may be off by.
  [[nodiscard]] const PassedOver& passed_over() const { return passed_over_; }
  /// A sample of which each number is off by that.
  struct Moved {
    PassedOver numbers;  ///< those of the sample
    FlatSample flat;     ///< the sample, a view of them
  };
  /// What that makes of anything read from a sample is its error.
  [[nodiscard]] Moved moved(const FlatSample& at) const;
  /// The largest multiplier of the run: forces are as exact as the largest among them allows [force].
  [[nodiscard]] double largest_force() const { return largest_force_; }

  /// From when on nothing is known, and why, in words; empty if all is.
  [[nodiscard]] double known_until() const { return known_until_; }
  /// Why there is no more accurate run; empty if there is one.
  [[nodiscard]] const std::string& reservation() const { return reservation_; }

 private:
  void match_events();
  void match_samples();
  void find_horizon();
  void set_roundings();
  void find_jumps();
  void doubt_from(double time, Doubt why, const std::string& words);
  [[nodiscard]] double difference(const FlatSample& a, const FlatSample& b) const;
  void set_round_off(Certainty& its, double difference) const;

  std::shared_ptr<const Record> run_, reference_;
  std::vector<Certainty> samples_, events_;
  double known_until_ = std::numeric_limits<double>::infinity();
  std::string reservation_;
  PassedOver passed_over_;
  std::vector<double> unit_;          ///< of each coordinate: the scene's length, 1 of an angle
  double length_ = 1.0, time_ = 1.0;  ///< the scene's
  double largest_force_ = 0.0;
  double bound_ = 1.0;  ///< 1/(1 - q) where that is due
  bool complete_ = true;
};

}  // namespace dalembert
