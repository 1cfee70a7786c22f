#include "dalembert/solvers/audit/limits.h"

#include <algorithm>

namespace dalembert {

Limits::Limits(const System& system, const Claim& claim) : round_off(1e3 * epsilon), angle(system.angles()) {
  set(claim);
  std::vector<std::size_t> of_coordinate(system.coordinates());
  for (const std::size_t c : system.conditions().contacts())
    for (const std::size_t k : system.row(system.layout()->constraints[c].own_rows().front()))
      contacts = std::max(contacts, ++of_coordinate[system.w_columns()[k]]);
}

void Limits::set(const Claim& claim) {
  length = claim.length;
  time = claim.time;
  accuracy = claim.accuracy;
}

}  // namespace dalembert
