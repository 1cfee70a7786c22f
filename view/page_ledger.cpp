#include "dalembert/view/page_ledger.h"

#include <dalembert/core/results/ledger.h>

#include <array>
#include <limits>

namespace dalembert {

/// Its numbers are those of samples: at other instants there are none.
PageLedger::PageLedger(const Record& run, Quantities& all) {
  if (!run.ledger) return;
  const auto add = [&](const std::string& name, const auto& number_at) {
    accounts_.emplace_back(name, all.columns().add([&](std::size_t i) {
      const Shown& shown = all.shown()[i];
      return shown.of_run(run) ? number_at(shown.number) : std::numeric_limits<double>::quiet_NaN();
    }));
  };
  const auto account = [&](const std::string& prefix, const Ledger::Account& its) {
    add(prefix + its.name, [&](std::size_t i) { return its.values[i]; });
  };
  const Ledger& ledger = *run.ledger;
  account("", ledger.kinetic);
  account("", ledger.potential);
  for (const auto& its : ledger.elastic) account("elastic energy of ", its);
  for (const auto& its : ledger.work) account("work of ", its);
  const std::array<std::string, 3> along{"x", "y", "z"};
  for (std::size_t k = 0; k < static_cast<std::size_t>(run.layout->dimension); ++k)
    add("momentum " + along[k], [&](std::size_t i) { return ledger.momentum[i][k]; });
  for (std::size_t k = run.layout->dimension == 2 ? 2 : 0; k < 3; ++k)
    add("angular momentum " + along[k], [&](std::size_t i) { return ledger.angular_momentum[i][k]; });
}

void PageLedger::write(Json& json) const {
  json.list("ledger", accounts_, [&](const auto& account) {
    json.object([&] {
      json.member("name", account.first);
      json.member("column", account.second);
    });
  });
}

}  // namespace dalembert
