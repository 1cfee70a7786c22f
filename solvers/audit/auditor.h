#pragma once

#include <dalembert/solvers/audit/audited_dense.h>
#include <dalembert/solvers/audit/impact_laws.h>
#include <dalembert/solvers/audit/ledger_keeper.h>
#include <dalembert/solvers/audit/sample_laws.h>
#include <dalembert/solvers/audit/work_balance.h>
#include <dalembert/solvers/base/options.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Holds what a run hands out against the laws of the scene that it was made of, by code that shares nothing
/// with what made it: a wrong number becomes an error that names the law and what breaks it.
class Auditor {
 public:
  /// What the run claims: at first by its tolerance, or by the accuracy that it says its steps have reached.
  using Claims = std::function<Claim(bool reached)>;
  Auditor(std::shared_ptr<const System> stated, const Options& options, Claims claims);

  // All of these throw StepFailure for a violation, if the options ask for that; EquationFault.

  /// The laws of an instant.
  void instant(const FlatSample& sample);
  /// Those, and the balance of work since the last one.
  void sample(const FlatSample& sample);
  /// The velocities at the end of a step.
  void step(double time, std::span<const double> v) { balance_.step(time, v); }
  [[nodiscard]] bool follows_steps() const { return balance_.watches() || ledger_; }
  /// Goes over the last step up to a time, for the ledger.
  void follow(double time, const LedgerKeeper::Read& read);
  /// A change of a constraint or of the scene, from the last sample to `after`.
  void jump(const Jump& jump, const FlatSample& after);
  /// The scene states this from a time on.
  void replace_system(double time, std::shared_ptr<const System> stated);

  /// A sample is handed out.
  void keep(const FlatSample& sample) {
    if (ledger_) ledger_->keep(sample);
  }
  /// Dense output that obeys the laws where it is read, if the options ask for that.
  [[nodiscard]] std::shared_ptr<const DenseOutput> watch(std::shared_ptr<const DenseOutput> run) const;
  [[nodiscard]] Audit read() const { return all_.read(*stated_); }
  /// The accuracy that the balance of work shows, where that is not the one claimed; else 0.
  [[nodiscard]] double accuracy() const { return shown_; }
  [[nodiscard]] const Ledger* ledger() const { return ledger_ ? &ledger_->ledger() : nullptr; }

 private:
  template <class Check>
  void judge(const Check& check);
  void start_interval(const FlatSample& sample);

  std::shared_ptr<const System> stated_;
  Audited audited_;
  Claims claims_;
  SampleLaws samples_;
  ImpactLaws impacts_;
  WorkBalance balance_;
  std::optional<LedgerKeeper> ledger_;
  double kinetic_ = 0.0;  // of the last sample
  double shown_ = 0.0;
  bool started_ = false;
  std::vector<Stated> history_;
  Findings all_;
};

}  // namespace dalembert
