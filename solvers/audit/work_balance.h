#pragma once

#include <dalembert/core/results/sample.h>
#include <dalembert/solvers/audit/findings.h>
#include <dalembert/solvers/audit/limits.h>

#include <memory>
#include <optional>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Whether a system's energy stays as it is while no constraint changes, but for Coulomb's friction: every
/// force has a potential, no constraint depends on time.
[[nodiscard]] bool conservative(const System& system);

/// Balance of work between samples: the energy changes by the work of what has no potential. Where nothing
/// has such work it stays as it is, and where Coulomb's friction alone has it falls.
///
/// A step errs by `accuracy` in its state, and so by
///
///   accuracy sum_i m_i ( |dv_i/dt| unit_i + |v_i| (unit_i/T + |v_i|) ) (1)
///
/// in its energy: what a position errs by across the constraints, which output is put onto, does no work, so
/// that m dv/dt stands for the force. Steps' errors add up, and a sample within a step errs by as much as
/// one. Springs that vibrate faster than the steps keep what `accuracy` leaves of that, once.
///
/// Errors of the state grow with the motion, which is not in `accuracy`. Up to `Constants::growth` times (1)
/// the balance is kept, by the accuracy that it shows, see `shown`.
class WorkBalance {
 public:
  WorkBalance(std::shared_ptr<const System> stated, const Claim& claim);

  /// Begins at a state of this energy.
  void start_interval(double time, double energy, std::span<const double> v);
  /// A step that ended with these velocities.
  void step(double time, std::span<const double> v);
  void check(const FlatSample& sample, const Claim& claim, Findings& findings);
  /// The same of any system, where the work on its kinetic energy since the last sample is known, and how
  /// exactly.
  void check(const FlatSample& sample, double work, double error, const Claim& claim, Findings& findings);
  /// Goes on from a sample that was checked.
  void accept(const FlatSample& sample);

  [[nodiscard]] bool watches() const { return watches_; }
  /// The accuracy by which (1) explains what was found.
  [[nodiscard]] double shown() const { return shown_; }

 private:
  void weigh(double time, double size, double changes, double other, Findings& findings);
  [[nodiscard]] double second_order() const;
  [[nodiscard]] double work_of_errors(const FlatSample& sample);
  [[nodiscard]] bool constraints_drive(const FlatSample& sample);
  [[nodiscard]] bool potentials_depend_on_time(const FlatSample& sample) const;

  std::shared_ptr<const System> stated_;
  Limits limits_;
  bool watches_, falls_;
  double time_ = 0.0, energy_ = 0.0;             // where it began, or fell to
  double before_ = 0.0, checked_ = 0.0;          // the last two times,
  double kinetic_ = 0.0, changes_before_ = 0.0;  // and what was then
  std::vector<double> v_;                        // at the last step
  std::vector<double> at_rest_, g_, u_;          // work
  System::Evaluation e_;
  double changes_ = 0.0, last_ = 0.0;  // (1) without `accuracy`, summed over steps, and of the last
  double shown_ = 0.0;
  double elastic_ = 0.0;  // of a deflection by a unit
  double size_ = 0.0;     // the largest energy of a sample
};

}  // namespace dalembert
