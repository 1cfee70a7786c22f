#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace dalembert {

/// How far before and beyond an isolated singular position a crossing begins and ends, of the scene's
/// time: there the constraints are far enough from dependent.
inline constexpr double crossing_distance = 0.05;
/// What the explicit stepper crosses with at best: with a tighter one its steps become so short that
/// some fall on the position itself.
inline constexpr double crossing_tolerance = 1e-9;

/// A state from some time ago.
class Past {
 public:
  struct State {
    double t;
    std::vector<double> q, v;
  };

  Past(double t, std::span<const double> q, std::span<const double> v) {
    for (State& s : states_) s = {t, {q.begin(), q.end()}, {v.begin(), v.end()}};
  }

  /// Keeps the state at t, as `read(t, q, v)` gives it, if the last one kept is older than `age`.
  template <class Read>
  void remember(double t, double age, const Read& read) {
    if (t - states_[1].t < age) return;
    std::swap(states_[0], states_[1]);
    states_[1].t = t;
    read(t, states_[1].q, states_[1].v);
  }
  /// The one before the last: at least `age` before the last.
  [[nodiscard]] const State& earlier() const { return states_[0]; }

 private:
  std::array<State, 2> states_;
};

}  // namespace dalembert
