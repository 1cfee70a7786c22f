#include "dalembert/solvers/audit/audited_dense.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/audit/sample_laws.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

namespace dalembert {

AuditedDense::AuditedDense(std::shared_ptr<const DenseOutput> run, std::vector<Stated> stated,
                           const Claim& claim)
    : run_(std::move(run)), stated_(std::move(stated)), claim_(claim) {}

/// At the time of a change a run is read before it.
void AuditedDense::read(std::span<const double> times, Record& out) const {
  const std::size_t first = out.times.size();
  run_->read(times, out);
  const Stated* last = nullptr;
  std::optional<SampleLaws> laws;
  Findings findings;
  for (std::size_t i = first; i < out.times.size(); ++i) {
    const auto behind =
        std::ranges::lower_bound(stated_.begin() + 1, stated_.end(), out.times[i], {}, &Stated::from);
    const Stated* own = &*std::prev(behind);
    if (std::exchange(last, own) != own) laws.emplace(own->system, claim_);
    run_->as_read(out.times[i], [&] { laws->check(out.sample(i), claim_, findings); });
    if (!findings.violated()) continue;
    std::ostringstream what;
    what.precision(10);
    what << "at(" << out.times[i] << "): " << findings.message(*own->system);
    throw EquationFault(what.str());
  }
}

}  // namespace dalembert
