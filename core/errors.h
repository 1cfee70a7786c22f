#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace dalembert {

struct Record;
template <int D>
class Trajectory;

/// Root of everything that dalembert throws. what() says what was wrong (with values), where
/// (particle, constraint or force by name, time), and what to do about it.
class Error : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What a scene states makes no sense by itself: a negative mass, a name already taken, no particle at all.
/// Nothing was computed, and the scene is unchanged.
class InvalidScene : public Error {
  using Error::Error;
};

/// An option, a handle, an index or a time makes no sense where it was given: t_end before t_start, a handle
/// of another scene, a sample that a run does not have, a time beyond its end. Nothing was computed.
class InvalidArgument : public Error {
  using Error::Error;
};

/// The initial positions or velocities contradict the constraints, or the constraints cannot all be
/// satisfied, or one is singular there.
class InconsistentStart : public Error {
  using Error::Error;
};

/// A constraint or force threw, or gave a number that is not finite; names it, and when. Turned into
/// InconsistentStart or IntegrationFailure by a run.
class EquationFault : public Error {
  using Error::Error;
};

/// A force of constraint was asked for at an instant at which the state does not determine it: the
/// constraints are close to linearly dependent, or one is so stiff that positions do not tell its deflection.
/// Motion can be read there; Sample::is_determined tells beforehand.
class UndeterminedForce : public Error {
  using Error::Error;
};

/// The integration could not go on. Nothing computed is lost: `trajectory<D>()` has the samples of a run up
/// to the failure, and a Simulation reads the last instant that steps reached. Whatever would take such a run
/// on throws it again; begin anew from a sample.
class IntegrationFailure : public Error {
 public:
  /// Thrown by runs only.
  IntegrationFailure(const std::string& what, double time, std::shared_ptr<const Record> record)
      : Error(what), time_(time), record_(std::move(record)) {}

  /// The last time reached.
  [[nodiscard]] double time() const { return time_; }
  /// The samples before the failure. D is the dimension of the scene; throws InvalidArgument if not.
  template <int D>
  [[nodiscard]] Trajectory<D> trajectory() const;
  /// The same as flat arrays.
  [[nodiscard]] const std::shared_ptr<const Record>& record() const { return record_; }

 private:
  double time_;
  std::shared_ptr<const Record> record_;
};

}  // namespace dalembert
