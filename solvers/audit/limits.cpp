#include "dalembert/solvers/audit/limits.h"

namespace dalembert {

Limits::Limits(const System& system, const Claim& claim) : round_off(1e3 * epsilon), angle(system.angles()) {
  set(claim);
}

void Limits::set(const Claim& claim) {
  length = claim.length;
  time = claim.time;
  accuracy = claim.accuracy;
}

}  // namespace dalembert
