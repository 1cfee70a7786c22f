#include "dalembert/solvers/audit/auditor.h"

#include <dalembert/solvers/base/step_failure.h>

#include <algorithm>
#include <sstream>
#include <utility>

namespace dalembert {

Auditor::Auditor(std::shared_ptr<const System> stated, const Options& options, Claims claims)
    : stated_(std::move(stated)),
      audited_(options.audit),
      claims_(std::move(claims)),
      samples_(stated_, claims_(false)),
      impacts_(stated_, claims_(false)),
      balance_(stated_, claims_(false)) {
  if (!options.ledger) return;
  ledger_.emplace(stated_);
  ledger_->begin(options.t_start);
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
  const Findings::Case& worst = all_.violation();
  std::ostringstream what;
  what << "the result breaks a law of mechanics, " << name(all_.violated_law()) << ": "
       << worst.subject.label(*stated_) << " by " << worst.size << " where " << worst.limit
       << " is allowed; try a tighter tolerance or the other stepper, or let the option audit = "
          "Audited::report "
          "show what follows";
  throw StepFailure{what.str(), worst.time};
}

void Auditor::begin(const FlatSample& sample) {
  balance_.begin(sample.time, sample.energy, sample.v);
  kinetic_ = stated_->kinetic_energy(sample.v);
  begun_ = true;
}

void Auditor::instant(const FlatSample& sample) {
  judge([&](const Claim& claim, Findings& found) { samples_.check(sample, claim, found); });
}

void Auditor::sample(const FlatSample& sample) {
  if (!begun_) begin(sample);
  const auto work = ledger_ ? std::optional(ledger_->take()) : std::nullopt;
  judge([&](const Claim& claim, Findings& found) {
    samples_.check(sample, claim, found);
    if (balance_.watches()) balance_.check(sample, claim, found);
    if (work) balance_.check(sample, work->sum, work->error, claim, found);
  });
  balance_.accept(sample);
  shown_ = std::max(shown_, balance_.shown());
  if (ledger_) kinetic_ = stated_->kinetic_energy(sample.v);
}

void Auditor::follow(double time, const LedgerKeeper::Read& read) {
  if (!ledger_) return;
  ledger_->integrate_to(time, [&](double t) {
    const FlatSample sample = read(t);
    instant(sample);
    return sample;
  });
}

void Auditor::jump(const Jump& jump, const FlatSample& after) {
  judge([&](const Claim& claim, Findings& found) { impacts_.check(jump, claim, found); });
  instant(after);
  if (ledger_) {
    const double given = stated_->kinetic_energy(jump.v_before);
    ledger_->jump(jump, impacts_.w(), begun_ ? given - kinetic_ : 0.0);
  }
  begin(after);
}

void Auditor::restate(std::shared_ptr<const System> stated) {
  stated_ = std::move(stated);
  samples_ = SampleLaws(stated_, claims_(false));
  impacts_ = ImpactLaws(stated_, claims_(false));
  balance_ = WorkBalance(stated_, claims_(false));
  if (ledger_) ledger_->restate(stated_);
}

}  // namespace dalembert
