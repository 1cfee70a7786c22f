#pragma once

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// On which side of each switching surface of the equations a state is.
struct Side {
  Branches::Outcomes branches;  ///< of the comparisons in each batch; empty if they are not known
  std::vector<double> slope;    ///< dF_f/dlambda: Coulomb's is -mu times the direction of sliding
};

/// The switching surfaces of a scene: comparisons in its equations, and friction that reverses with the
/// sliding.
///
/// Between two states one was crossed if a comparison changed its outcome, or if some friction's slope turned
/// by more than a right angle: at zero sliding velocity a law changes its direction without comparing
/// anything. Coulomb's constraints change where a run finds it, not here. (A direction that turns so far
/// smoothly within a step does no harm; the step is tried shorter.)
class Switches {
 public:
  /// Listens to the equations at a state: most scenes compare nothing and have no switches.
  Switches(const System& system, const Instant& at, std::span<const double> lambda);

  [[nodiscard]] bool any() const { return any_; }
  /// So that `find` allocates nothing.
  void make_room(Side& side) const;
  /// `of_constraints` is what they compared in the evaluation that found lambda, see Manifold::listen.
  void find(const Instant& at, std::span<const double> lambda, const Branches::Outcomes& of_constraints,
            Side& out);
  [[nodiscard]] bool same(const Side& a, const Side& b) const;
  /// Whether what changed from `a` to `b` is at `c` as it was at `a`.
  [[nodiscard]] bool returns(const Side& a, const Side& b, const Side& c) const;
  /// The friction that turned from `a` to `b`, if one did.
  [[nodiscard]] std::optional<std::size_t> turned(const Side& a, const Side& b) const;
  [[nodiscard]] std::string friction(std::size_t i) const { return system_->force_of_friction(first_[i]); }
  /// The length of a friction's slope.
  [[nodiscard]] double steepness(const Side& a, std::size_t i) const { return std::sqrt(turn(a, a, i)); }
  /// Whether some friction has no slope: of Coulomb's, nothing slides.
  [[nodiscard]] bool rests(const Side& a) const;
  /// Labels of the others that differ.
  [[nodiscard]] std::string others(const Side& a, const Side& b) const;

 private:
  [[nodiscard]] double turn(const Side& a, const Side& b, std::size_t friction) const;

  const System* system_;
  System::Linearisation work_;
  std::size_t batches_ = 0;
  std::vector<std::size_t> first_;  // entry of the slope of each friction, and the end
  bool any_ = false, of_forces_ = false;
};

}  // namespace dalembert
