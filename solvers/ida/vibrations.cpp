#include "dalembert/solvers/ida/vibrations.h"

#include <dalembert/solvers/linear/rows.h>

#include <algorithm>
#include <cmath>

namespace dalembert {

Vibrations fastest_vibrations(const System& system, std::span<const double> w,
                              const System::Linearisation& linear, std::span<double> scratch) {
  Vibrations fastest;
  const auto damping = scratch;
  std::ranges::fill(damping, 0.0);
  for (std::size_t k = 0; k < linear.damping.size(); ++k) {
    double& most = damping[system.forces().damping_pattern()[k].row];
    most = std::max(most, std::abs(linear.damping[k]));
  }
  double square = 0.0;
  for (std::size_t k = system.stiffness_of_constraints(); k < linear.stiffness.size(); ++k) {
    const auto row = system.stiffness_pattern()[k].row;
    const double own = std::abs(linear.stiffness[k]) / system.masses()[row];
    const double damped = damping[row] / system.masses()[row];
    if (damped * damped > 4.0 * own) continue;
    if (own > square) fastest.stiffest = k;
    square = std::max(square, own);
  }
  fastest.of_forces = std::sqrt(square);

  square = 0.0;
  for (std::size_t r = 0; r < system.rows(); ++r) {
    if (system.law(r).compliant())
      square = std::max(square, inverse_effective_mass(system, w, r) / system.law(r).compliance);
  }
  fastest.of_compliance = std::sqrt(square);
  return fastest;
}

}  // namespace dalembert
