#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// dF_f/dlambda at a state: Coulomb's is -mu times the direction of sliding. Empty if it is not known.
using Slope = std::vector<double>;

/// Friction that reverses with the sliding.
///
/// Between two states one did if its slope turned by more than a right angle: at zero sliding velocity a law
/// changes its direction without comparing anything. (What compares is found by Comparisons. A direction that
/// turns so far smoothly within a step does no harm; the step is tried shorter.) Laws of the scene switch;
/// what slides of Coulomb's constraints, behind them, changes where a run finds it.
class Switches {
 public:
  explicit Switches(const System& system);

  [[nodiscard]] bool any() const { return laws_ > 0; }
  [[nodiscard]] bool any_slides() const { return laws_ + 1 < first_.size(); }
  /// So that `find` allocates nothing.
  void make_room(Slope& slope) const;
  void find(const Instant& at, std::span<const double> lambda, Slope& out) const;
  [[nodiscard]] bool same(const Slope& a, const Slope& b) const { return !turned(a, b); }
  /// Whether all that turned from `a` to `b` is at `c` as it was at `a`.
  [[nodiscard]] bool returns(const Slope& a, const Slope& b, const Slope& c) const;
  /// Whether what slides turned from `a` to `b`.
  [[nodiscard]] bool slide_turned(const Slope& a, const Slope& b) const;
  /// The friction that turned from `a` to `b`, if one did.
  [[nodiscard]] std::optional<std::size_t> turned(const Slope& a, const Slope& b) const;
  [[nodiscard]] std::string friction(std::size_t i) const {
    return system_->forces().owner_of_friction(first_[i]);
  }
  /// The length of a friction's slope.
  [[nodiscard]] double steepness(const Slope& a, std::size_t i) const { return std::sqrt(turn(a, a, i)); }
  /// Whether some friction has no slope: of Coulomb's, nothing slides.
  [[nodiscard]] bool rests(const Slope& a) const;

 private:
  [[nodiscard]] double turn(const Slope& a, const Slope& b, std::size_t friction) const;

  const System* system_;
  std::vector<std::size_t> first_;  // entry of the slope of each friction, and the end
  std::size_t laws_ = 0;            // the first frictions are of these
};

}  // namespace dalembert
