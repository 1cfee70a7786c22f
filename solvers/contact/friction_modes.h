#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/friction_equations.h>

#include <span>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The search for modes that satisfy Coulomb's law at an instant: which of all that is at rest sticks, and in
/// which direction the rest slides. From the onset of what can not all stick one violation after another is
/// amended, until none is left.
class FrictionModes {
 public:
  /// Of these, whose modes it sets; all must outlive it.
  FrictionModes(const FrictionEquations& equations, std::span<RoughState> all,
                const std::vector<std::size_t>& open, const Instant& at)
      : equations_(&equations), all_(all), open_(&open), at_(at) {}
  /// Throws StepFailure, naming the constraints, where nothing satisfies the law; EquationFault.
  void find();
  /// Throws StepFailure where what begins to slide may as well have a normal force of the other sign. What
  /// slides on keeps the motion that it has.
  void require_one_motion() const;
  /// Throws StepFailure, naming it, if one of these `loses_share`. Of redundant ones that would decide which
  /// slides; but among the others may be contacts that then pull, and open.
  static void require_own_shares(const System& stated, std::span<const RoughState> all, double t);

 private:
  using Motion = FrictionEquations::Motion;

  /// Places among constraints at rest, and among their rows.
  struct Part {
    std::vector<Eigen::Index> places, rows;
  };

  void decide();
  [[nodiscard]] std::vector<Part> parts_of(const std::vector<std::size_t>& which) const;
  void start_sliding(const std::vector<RoughState*>& at_rest, const SlipCoupling& coupling,
                     const Motion& held);
  [[nodiscard]] bool sticks(const Motion& motion) const;
  void mark_shared(const Motion& motion);
  [[nodiscard]] double excess(const RoughState& rough, const Motion& motion) const;
  void search();
  [[nodiscard]] std::vector<RoughState*> going_with(RoughState& most, const Motion& motion) const;
  [[nodiscard]] bool amend(const Motion& motion);
  [[nodiscard]] bool release_most_exceeded(const Motion& motion);
  [[nodiscard]] bool turn(RoughState& rough, const Motion& motion) const;
  [[nodiscard]] std::vector<double> modes() const;
  [[noreturn]] void refuse() const;
  [[nodiscard]] Motion solve() const { return equations_->solve(all_, *open_, at_); }
  [[nodiscard]] std::string label(const RoughState& rough) const {
    return equations_->stated()->row_label(rough.row);
  }

  const FrictionEquations* equations_;
  std::span<RoughState> all_;
  const std::vector<std::size_t>* open_;
  Instant at_;
};

}  // namespace dalembert
