#include "dalembert/solvers/manifold/violation.h"

#include <dalembert/solvers/linear/rows.h>

#include <cmath>

namespace dalembert {

namespace {

Violation worst_of(const System& system, std::span<const double> residual, std::span<const double> w,
                   std::span<const double> lengths) {
  Violation worst;
  for (std::size_t r = 0; r < residual.size(); ++r) {
    if (residual[r] == 0.0) continue;
    const double size = std::abs(residual[r]) / gradient_length(system, w, lengths, r);
    if (!(size <= worst.size)) worst = {size, r};
  }
  return worst;
}

}  // namespace

Violation position_violation(const System& system, const System::Evaluation& e,
                             std::span<const double> lengths) {
  return worst_of(system, e.g, e.w, lengths);
}

Violation velocity_violation(const System& system, const System::Evaluation& e,
                             std::span<const double> lengths) {
  return worst_of(system, e.psi, e.w, lengths);
}

}  // namespace dalembert
