#include "dalembert/solvers/audit/auditor.h"

#include <dalembert/solvers/base/step_failure.h>

#include <algorithm>
#include <utility>

namespace dalembert {

Auditor::Auditor(std::shared_ptr<const System> stated, const Options& options, Claims claims)
    : stated_(std::move(stated)),
      audited_(options.audit),
      claims_(std::move(claims)),
      samples_(stated_, claims_(false)),
      impacts_(stated_, claims_(false)),
      balance_(stated_, claims_(false)),
      history_{{options.t_start, stated_}} {
  if (!options.ledger) return;
  ledger_.emplace(stated_);
  ledger_->start(options.t_start);
}

/// What is beyond the tolerance may be within the accuracy that the run has reached, and says so.
template <class Check>
void Auditor::judge(const Check& check) {
  all_.look();
  check(claims_(false), all_);
  if (!all_.violated()) return;
  all_.count();
  check(claims_(true), all_);
  if (!all_.violated() || audited_ != Audited::error) return;
  throw StepFailure{all_.message(*stated_), all_.violation().time};
}

void Auditor::start_interval(const FlatSample& sample) {
  balance_.start_interval(sample.time, sample.energy, sample.v);
  kinetic_ = stated_->kinetic_energy(sample.v);
  started_ = true;
}

void Auditor::instant(const FlatSample& sample) {
  judge([&](const Claim& claim, Findings& found) { samples_.check(sample, claim, found); });
}

void Auditor::sample(const FlatSample& sample) {
  if (!started_) start_interval(sample);
  const auto work = ledger_ ? ledger_->take() : LedgerKeeper::Work{};
  judge([&](const Claim& claim, Findings& found) {
    samples_.check(sample, claim, found);
    if (balance_.watches()) balance_.check(sample, claim, found);
    if (ledger_) balance_.check(sample, work.sum, work.error, claim, found);
  });
  balance_.accept(sample);
  shown_ = std::max(shown_, balance_.shown());
  if (ledger_) kinetic_ = stated_->kinetic_energy(sample.v);
}

void Auditor::follow(double time, const LedgerKeeper::Read& read) {
  if (!ledger_) return;
  ledger_->integrate_to(time, [&](double t, const LedgerKeeper::Use& use) {
    read(t, [&](const FlatSample& sample) {
      instant(sample);
      use(sample);
    });
  });
}

void Auditor::jump(const Jump& jump, const FlatSample& after) {
  judge([&](const Claim& claim, Findings& found) { impacts_.check(jump, !started_, claim, found); });
  instant(after);
  if (ledger_) {
    const double given = stated_->kinetic_energy(jump.v_before);
    ledger_->jump(jump, impacts_.w(), started_ ? given - kinetic_ : 0.0);
  }
  start_interval(after);
}

void Auditor::replace_system(double time, std::shared_ptr<const System> stated) {
  stated_ = std::move(stated);
  history_.push_back({time, stated_});
  samples_ = SampleLaws(stated_, claims_(false));
  impacts_ = ImpactLaws(stated_, claims_(false));
  balance_ = WorkBalance(stated_, claims_(false));
  if (ledger_) ledger_->replace_system(stated_);
}

std::shared_ptr<const DenseOutput> Auditor::watch(std::shared_ptr<const DenseOutput> run) const {
  if (run == nullptr || audited_ != Audited::error) return run;
  return std::make_shared<AuditedDense>(std::move(run), history_, claims_(true));
}

}  // namespace dalembert
