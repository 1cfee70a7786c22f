#pragma once

#include <dalembert/core/results/sample.h>

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace dalembert {

template <int D>
class Scene;
class System;

/// The direction in which a function crosses 0.
enum class Crossing { either, rising, falling };

/// A number read from an instant of a run, of which an event is a zero. A condition is none: of `x > 1` the
/// values are 0 and 1, which lie on no two sides of 0; say `x - 1`.
template <int D>
class EventFunction : public std::function<double(const Sample<D>&)> {
  using Function = std::function<double(const Sample<D>&)>;

 public:
  EventFunction() = default;
  /// Of anything that gives a number for a sample.
  template <class F>
    requires(std::is_invocable_r_v<double, F&, const Sample<D>&> &&
             !std::is_base_of_v<EventFunction, std::decay_t<F>>)
  EventFunction(F&& function) : Function(std::forward<F>(function)) {
    static_assert(
        !std::is_same_v<std::decay_t<std::invoke_result_t<F&, const Sample<D>&>>, bool>,
        "an event's function returns a number that crosses 0, as `x - 1`, not a condition, as `x > 1`");
  }
};

/// Something that happens where a function of the state is 0: a normal force vanishes, a string is straight,
/// a bead comes to rest.
///
///   Event<2>{"leaves the sphere", [=](const auto& now) { return now.multiplier(wall); }, Crossing::falling}
///
/// The function reads time, positions, velocities, multipliers, forces of the instant; it is called at times
/// of the run's own choice, and must give the same number for the same state. What it gives at the start is
/// no crossing, even if it is 0 there. Where it jumps from one side of 0 to the other, as a velocity does at
/// an impact, it crosses 0.
template <int D>
struct Event {
  std::string name;                      ///< for errors
  EventFunction<D> function;             ///< is 0 where it happens
  Crossing crossing = Crossing::either;  ///< which zeros count
  bool ends = false;                     ///< the run ends there, with a last sample at that time
  /// Changes the scene there; empty if it does not. The scene has the state of that instant as its initial
  /// one: `replace` states parameters anew, and with particles masses and velocities; `release` and `impose`
  /// take constraints out of force and back. The run goes on with that, from velocities projected onto the
  /// constraints by their impulses. A constraint comes into force only where it is satisfied.
  std::function<void(Scene<D>& scene)> change{};
};

/// The same without its dimension.
struct FlatEvent {
  std::string name;                                   ///< as in Event
  std::function<double(const FlatSample&)> function;  ///< as in Event
  Crossing crossing;                                  ///< as in Event
  bool ends;                                          ///< as in Event
  /// The equations from there on and the state they begin with.
  struct Changed {
    std::shared_ptr<const System> system;  ///< the equations
    std::vector<double> q, v;              ///< the state
  };
  std::function<Changed(const FlatSample&)> change{};  ///< as in Event
};

/// What a run lists: an event that was asked for; that a one-sided constraint opened, had an impact, or came
/// to rest after infinitely many; that one of Coulomb's law sticks from there on, or slides.
enum class EventKind { event, opened, struck, rested, sticks, slides };
/// The verb: "happens", "opens", "is struck", "comes to rest", "sticks", "slides".
[[nodiscard]] const char* name(EventKind kind);

/// That something happened in a run, and when.
struct EventRecord {
  std::size_t source;  ///< which of those that were asked for, from 0; of a constraint its index
  double time;         ///< when it happened
  EventKind kind = EventKind::event;  ///< what it is
  /// Of the time of a rest, the limit of impacts that go on without end: how well those that a run has found
  /// tell it, beside the errors of its steps. 0 of others.
  double uncertain = 0.0;
};

}  // namespace dalembert
