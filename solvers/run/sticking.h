#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/manifold/manifold.h>
#include <dalembert/solvers/manifold/start.h>
#include <dalembert/solvers/run/switches.h>

#include <optional>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A state, and the accelerations there.
struct Motion {
  double t = 0.0;
  std::vector<double> q, v, a;

  [[nodiscard]] Instant instant() const { return {t, q, v}; }
};

/// to = `from` extrapolated for a short time with its accelerations.
void move(const Motion& from, double duration, Motion& to);

/// How a motion leaves a state.
struct Departure {
  std::optional<std::size_t> held_by{};  ///< the friction that prevents sliding, if one does
  bool from_rest = false;                ///< some friction has no direction yet
  std::vector<double> a{};               ///< the accelerations once it has
};

/// Finds whether sliding friction sticks.
///
/// Where the sliding velocity vanishes Coulomb's force reverses by a jump. With e the direction of sliding
/// before: if the acceleration points against e before the jump and along e behind it, both vector fields
/// lead to the discontinuity (Filippov) and neither sliding on nor back is a solution. At rest the same is
/// asked of the direction in which the other forces drive. If it points against e on both sides sliding
/// reverses.
class Sticking {
 public:
  Sticking(const Problem& problem, const Start& start, double tolerance);

  /// Of a state with the accelerations a; `side` is the one that the motion begins on.
  [[nodiscard]] Departure leave(const Instant& at, std::span<const double> a, Slope& side);
  /// Whether the friction that reverses between two states does so by a jump, and not steeply: whether it is
  /// as large next to the reversal as away from it.
  [[nodiscard]] bool jumps(const Motion& before, const Motion& behind, std::size_t friction);
  /// The message about a friction that would stick.
  [[nodiscard]] std::string would_stick(std::size_t friction) const { return message(switches_, friction); }
  [[nodiscard]] static std::string message(const Switches& switches, std::size_t friction);

  /// For a motion known only at its steps: called before the first of the run and after each.
  /// Throws StepFailure.
  void watch(double t, std::span<const double> q, std::span<const double> v);

 private:
  void require_leaving();
  void require_no_stop();
  void find_slope(const Motion& at, Slope& side);
  bool accelerate(Motion& at, Slope& side);
  void require_sliding(const Motion& before, Motion& behind);
  void look_ahead(Motion from, double duration);

  const System* system_;
  Manifold manifold_;
  Switches switches_;
  double time_, soon_;
  std::vector<double> lambda_;
  Motion last_, now_, trial_;
  Slope side_, near_, far_;  // work
  bool started_ = false;
};

}  // namespace dalembert
