#pragma once

#include <dalembert/core/results/event.h>
#include <dalembert/solvers/audit/findings.h>
#include <dalembert/solvers/audit/limits.h>

#include <memory>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// An instant at which velocities jump: positions, the velocities before (after what a user's change made of
/// them) and after, the impulses of all rows, and what happened.
struct Jump {
  double time;
  std::span<const double> q, v_before, v_after, impulses;
  std::span<const EventRecord> what;
};

/// The laws of a Jump, see Law. With U the rates of one-sided constraints in their allowed direction and
/// P . (psi- + psi+)/2 the work of the impulses less that of drives,
///
///   M (v+ - v-) = W^T P,   U+ + e U- >= 0,   P (U+ + e U-) = 0,   P . (psi- + psi+)/2 <= 0.
///
/// What comes to rest after infinitely many impacts has made the last of them at once, and a user's change is
/// projected before contacts answer: there nothing is said of U. Friction that takes hold of two slip
/// velocities takes what is left of them without an impulse.
class ImpactLaws {
 public:
  explicit ImpactLaws(std::shared_ptr<const System> stated, const Claim& claim);

  /// Throws EquationFault.
  void check(const Jump& jump, bool at_start, const Claim& claim, Findings& findings);
  /// W at the last jump that was checked, of what has carried impulses.
  [[nodiscard]] std::span<const double> w() const { return after_.w; }

 private:
  void check_momentum(const System& acting, const Jump& jump, Findings& findings) const;
  void check_carriers(const Jump& jump, bool at_start, Findings& findings) const;
  void check_restitution(const Jump& jump, Findings& findings) const;
  void check_energy(const System& acting, const Jump& jump, Findings& findings) const;
  [[nodiscard]] double speed_limit(const System& acting, std::size_t r, const Jump& jump) const;

  std::shared_ptr<const System> stated_;
  Limits limits_;
  System::Evaluation before_, after_;
};

}  // namespace dalembert
